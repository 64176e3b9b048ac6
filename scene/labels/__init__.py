"""What stands before a scene's camera, read from Blender for labels.

lens     the camera
stage    all meshes as they show
"""
