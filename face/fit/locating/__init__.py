"""Where the face of a mesh is, which way it looks, how large it is, and whether it is one.

locate            all of it in order
search, regions   the coarse search over directions and sizes; over the ends of a mesh
boxes             what of a mesh lies round a head
align             the template turned, moved and scaled until it fits
crooked, flow     faces unlike the template: parts sought by comparing two pictures
head_pose         the result: a placement
score             how much what is seen looks like a face
"""
