"""What follows the face: the other objects of a character, listed with how each follows.

props      the list, kept with the face's object
rows       what the list says: filled, corrected, read
ops        fill it again, add to it, take from it
panel      the list in the sidebar
loaded     files from before there was a list
"""
