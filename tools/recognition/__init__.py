"""How well emotions are recognised: gathered and written by `evidence.py`.

faces       the faces that it is gathered on
poses       words and profiles posed on them; samples: FAP streams; scans: scanned action units combined
verdicts    what each way of recognition says; shapes: other shapes of membership; words: the rank of words
page        docs/evidence.md; plots: its pictures
"""
