"""What expressions in time ask of a face at their peaks."""

from __future__ import annotations

import numpy as np
import pytest
from risorius.face.products.efforts import wanted_at_apexes
from risorius.mpeg4 import Cue, expression

#: FAPs of Table 5's first joy that widen the eyes, which a joy that squints does not do.
UPPER_LIDS = [19 - 1, 20 - 1]


@pytest.mark.parametrize("seed", [1, None])
def test_an_emotion_that_goes_against_its_profile_is_not_asked_for_it(seed: int | None) -> None:
    joy = expression("joy", activation=6.0)
    cue = Cue(joy, onset=0.2, apex=0.2, offset=0.2, seed=seed)
    drawn, natural, exact = joy.frame(seed), wanted_at_apexes([cue])[0], wanted_at_apexes([cue], "exact")[0]
    assert (drawn[UPPER_LIDS] < 0.0).all()  # wide
    assert np.isnan(natural[UPPER_LIDS]).all()
    np.testing.assert_array_equal(exact, drawn)
    kept = ~np.isnan(natural)
    assert kept.sum() > 5
    np.testing.assert_array_equal(natural[kept], drawn[kept])


def test_a_weaker_peak_asks_for_less() -> None:
    cues = [Cue(expression("joy"), onset=0.2, apex=0.2, offset=0.2, peak=peak) for peak in (1.0, 0.5)]
    whole, half = wanted_at_apexes(cues)
    np.testing.assert_allclose(half, 0.5 * whole)
