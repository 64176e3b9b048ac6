"""The mirror of FAPs."""

from __future__ import annotations

import numpy as np
from risorius.face.drive.natural.symmetry import SIDEWAYS, mirrored


def test_faps_that_point_to_one_side_change_sign_in_the_mirror() -> None:
    """The jaw's and the tongue's shift, the eyes' and the head's turn, the head's tilt, the nose's bend."""
    assert SIDEWAYS == (15, 23, 24, 43, 49, 50, 64)
    faps = np.arange(1.0, 69.0)
    seen = mirrored(faps)
    assert seen[[14, 48]].tolist() == [-15.0, -49.0]
    assert seen[[22, 23]].tolist() == [-24.0, -23.0]
    assert seen[[11, 12]].tolist() == [13.0, 12.0]
    np.testing.assert_array_equal(mirrored(seen), faps)
