"""What belongs to a face besides the head, and how it follows: told by names, places and shapes.

kinds        the ways to follow a face
habits       how objects of characters are named (presets/companions.toml)
places       where an object lies about a face, and what its shape tells
found        the objects of a character
rows         what a list of them says: who follows, who stays behind
saved        that list as a file keeps it
"""
