"""How well the faces do what they are asked, and how they look at it: measured and pictured by `bench_faithful.py`.

`heads` loads faces; `scans` are expressions to hold them against; `baselines` the ways that know points only;
`requests` how well FAPs are met; `report` the tables; `apexes`, `comparison`, `sheet` the pictures (Blender).
"""
