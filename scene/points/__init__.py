"""Feature points on Blender's objects.

found, presets        found from the shape alone; topologies that a user saved
painted               how bright a mesh is painted
beside                what lies beside it, as brows of their own do
refused               meshes in which none was found, this session
kept, bound           kept with the mesh; bound to its vertices
stored                given to an object, and read where they are now
carried, seen         where they are under modifiers; which show
joined, mirrored      after a join; on the other side
"""
