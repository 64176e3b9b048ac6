"""Mouths that cannot open, or have no inside: sewn lips cut open, a mouth bag added, on the user's own mesh.

lips    the whole of it: what is refused, the seam found, cut and filled, feature points put on the new lips
seam    an edited mesh cut along a line through its faces
lining  a mouth bag on the open border of a mouth that has none
bag     the mouth bag
"""
