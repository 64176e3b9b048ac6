"""What detectors made by strangers see in rendered faces of which the truth is known.

stills      what is pictured: an action unit or an emotion on a head, its strength, side and light; its FAPs
pictures    the pictures and their truth (Blender)
reading     what MediaPipe's face landmarker says of them: blend shapes, and FAPs by way of its landmarks
points68    what 68 landmarks of other finders tell; dlib_points: those of dlib, in an environment of its own
figures     which detector sees what: rises over rest, correlations, verdicts
page        docs/detectors.md; sheet: its picture (Blender)
"""
