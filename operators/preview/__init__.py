"""The live preview: the face shows what is chosen while it is being chosen.

live      shows on the active face what is chosen for it
events    what Blender does to a file while faces show previews
props     whether the preview is on
"""
