"""Feature points found on any head: the template is laid onto the mesh and its points are carried over.

find              the public way in; known topology first, then the fit
topologies        meshes whose connectivity is known
clicks            a face placed by a few points that somebody clicked
doubt             from where on a point should be looked at
surface           the mesh as points, depths, rims and planes of symmetry
template          the template that is laid onto it
locating          where the face is, which way it looks, how large it is, and whether it is one
bending           the template bent onto the head, its points carried over
"""
