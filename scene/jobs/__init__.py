"""Whole jobs for the command line: from an empty file to a .blend, a film or pictures.

words, playing, shapes    from words; from a FAP stream; the shape keys that engines know
saying                    speech, with its sound
clip, shown               one clip with all that is asked of it; what it shows
skin_colour               another colour for the skin
subjects                  whose face it is: the default head, or the mesh of a file that looks most like a face
destination               where its bakes go: new shape keys, or the controls that the character has
inputs                    that file: opened or read, and the meshes in it
stage                     the scene around the face, if it is not the user's
painting                  materials for meshes that bring none
writing                   what was baked, as a .blend or a film
files                     the file that a job works in, what is written, and how it is saved
kept                      prepared faces, for the next time
labelling                 the truth beside what is rendered; labelled_motion: what was asked for, as it tells it
sheet                     the contact sheet of a job
"""
