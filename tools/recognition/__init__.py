"""How well emotions are recognised: gathered and written by `evidence.py`.

faces       the faces that it is gathered on
poses       words and profiles posed on them; samples: FAP streams; scans: scanned action units combined
verdicts    what each way of recognition says; shapes: other shapes of membership; words: the rank of words
halves      the robust rule on the half that its constants were chosen on, and on the other
others      pictures of heads by others in their own expressions (Blender); photographs: those that packages ship
seen        what pictures and films are taken for (MediaPipe); seen_page: the part of the page about it
page        docs/evidence.md; plots: its pictures
"""
