"""One particular face: parts, feature points, muscles placed on it, FAPs to contractions and back.

checks, frame, points, parts, segmentation       what is given, where the face is, what its vertices are
openings, outer_skin, regions, tissue, followers the skin as an elastic sheet, and what follows it
template, tables, muscle_table, placement        the muscles, written on the template, placed on the face,
muscle_fields, pulls                             as fields of force and of what they move
mechanisms                                       what moves a face, one file each, and the switch
organs, actuators, anatomy                       what else moves, and all of it together
rows, inverse, nonnegative                       from FAPs to contractions
natural, synergies, wishes                       what a face does when asked for a few FAPs
measure, pose, simulate, face                    the public `Face`
default_head, mesh_file                          the head that comes with Risorius; heads in files
"""
