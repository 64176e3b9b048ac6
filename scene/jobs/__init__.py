"""Whole jobs for the command line: from an empty file to a .blend, a film or pictures.

words, playing, shapes    from words; from a FAP stream; the shape keys that engines know
subjects                  whose face it is: the default head, or a mesh from a file
files                     the empty file, what is written, and how it is saved
sheet                     the contact sheet of a job
"""
