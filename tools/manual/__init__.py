"""The manual's pictures, taken by `docs_pictures.py` in a real Blender window.

session     one window in which pictures are taken, with the built extension installed
panels      the panels on the default head: emotion, wheel, timeline, muscles, bake, reading
heads       heads, a body and a character of the user's: points, parts, what follows
rig         a head with shape keys of its own, baked to them
"""
