"""Feature points on Blender's objects.

found, presets        found from the shape alone; topologies that a user saved
kept, bound, file     kept with the mesh; bound to its vertices; from a file
carried, seen         where they are under modifiers; which show
joined, mirrored      after a join; on the other side
"""
