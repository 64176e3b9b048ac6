"""A mesh of any tessellation as what the fit works with.

cloud       points spread evenly over it
depth_map   its front as a picture of depths
paint       how bright it is painted
pieces      its skin among its connected pieces
shelves     a dense mesh gathered by place, for points spread over parts of it
rims        closed lines along which the skin ends
margins     those of eyes and mouth among the rims
skeleton    how far its places lie from each other along it
symmetry    planes about which it is nearly its own mirror image
"""
