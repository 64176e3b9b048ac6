"""Between Blender and arrays: meshes, shape keys, actions, cameras and films. Registers nothing.

Every function here is plain Python over bpy and can be called from scripts. Long work is a generator that yields
`Progress` and returns its result; `run` drives one to its end. Reading and computing come first and writing last,
so that an error or a cancelled bake leaves the scene as it was.
"""
