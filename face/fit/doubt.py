"""From where on what was found wants to be looked at."""

#: Faces of a higher score are unlike most: every point of theirs is doubtful.
DOUBTFUL_SCORE = 1.0

#: A point that is less sure than this wants to be looked at: its error is expected to be more than 5 mm (docs/fit.md).
DOUBTFUL = 0.5
