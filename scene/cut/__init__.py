"""Cutting sewn lips open, on the user's own mesh.

lips    the whole of it: what is refused, the seam found, cut and filled, feature points put on the new lips
seam    an edited mesh cut along a line through its faces
bag     the mouth bag behind the cut
"""
