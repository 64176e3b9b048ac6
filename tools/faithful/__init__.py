"""How well the faces do what they are asked, and how they look at it: measured and pictured by `bench_faithful.py`.

heads                        faces by name
scans, baselines             expressions to hold them against; ways that know points only
requests                     how well FAPs are met
figures, report              what is measured of one face, and the tables
apexes, comparison, sheet    the pictures; sitter: a head before the camera (Blender)
"""
