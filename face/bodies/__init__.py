"""The bodies in and about the skin, and where skin meets them or itself.

direct_faps             FAPs that turn or push a body as a whole
eyeball, tongue,        what those FAPs move, and how they are read back
  head_turn
surroundings            where mandible and eyeballs are in one pose
eyeball_surface,        the bodies that lids and lips lie on
  dental_arch
margins                 two margins that may meet: lips, lids
contact                 all contacts of one face
"""
