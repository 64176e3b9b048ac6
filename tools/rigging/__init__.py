"""How far a character's own shape keys follow the muscles: measured and written by `rigs.py`.

heads       heads with keys that others drew or scanned, and with those that Risorius makes
measuring   six emotions on the keys of a head, beside plain least squares
take        a minute at 60 frames per second: speed, smoothness, fights
page        the figures of docs/rigs.md
sheet       contact sheets: the muscles' own poses, and the same on the keys
"""
