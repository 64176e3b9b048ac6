"""Buccinator: dimples (AU 14) and lips drawn to one side.

Anatomy. It comes from both jaws behind the cheek to the mouth's corner. Fibres that end there draw the corner in and
back against the teeth: the dimple. Fibres that cross into the lips draw both lips to the side, and lips lie on teeth:
they go round the dental arch, so that the side that leads goes back and the side that follows comes forward.

Rows (presets/anatomy/muscles/buccinator.toml): buccinator (linear, equations 6-13), buccinator_lips (arch). As one
row, any wider corner dragged the lips' middle along.

What the second paper's model lacks and is added here: a pull along the arch (`muscles/arch.py`), which no straight line
gives.

Source: FACS muscle list (docs/sources.md) for the lines of action; own calibration on a scanned mouth drawn aside. No
scan at hand shows a dimple: anatomy alone.
"""
