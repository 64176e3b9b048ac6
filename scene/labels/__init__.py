"""What stands before a scene's camera, read from Blender for labels.

lens      the camera
stage     all meshes as they show
rendered  what is set otherwise for renders than for the viewport
clear     materials that are looked through
"""
