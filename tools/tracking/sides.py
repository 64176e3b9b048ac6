"""From where neutral heads are pictured."""

#: Where the camera stands: degrees to the subject's left; and how far the head nods, degrees. From the front first.
SIDES = ((0, 0), (20, 0), (-20, 0), (0, 12), (0, -12))
