"""One particular face: parts, feature points, muscles placed on it, FAPs to contractions and back.

frame, points, parts, segmentation     where the face is and what its vertices are
openings, outer_skin, regions, tissue  the skin as an elastic sheet
muscle_table, muscle_fields, jaw, eyes, organs   what moves it
rows, inverse, natural, synergies, wishes        from FAPs to contractions
pose, simulate, measure, face          the public `Face`
default_head                           the head that comes with Risorius
"""
