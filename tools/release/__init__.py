"""What users install, built from the checkout by `build.py`.

sources           the files that belong to the project
zips              the Blender extension: one zip per system and Blender range, checked by Blender itself
contents          what a built zip holds, against the system and the Pythons that it is for
wheels            which wheels go into which zip, and their download
python_package    the source distribution and the wheel for plain Python
"""
