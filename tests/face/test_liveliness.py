"""Blinks and small motions laid over a performance: the lids shut, the head turns, the mouth goes on as it was."""

from __future__ import annotations

import numpy as np
import pytest
import risorius.api as api
from risorius.face.drive.over_time import cue_plans
from risorius.face.drive.request import Drive
from risorius.face.face import Face


@pytest.mark.slow
def test_a_blink_over_a_smile_shuts_the_lids_and_leaves_the_mouth(face: Face) -> None:
    cue = api.Cue(api.expression("joy"), onset=0.12, apex=0.24, offset=0.12)
    lively = api.Liveliness(blinks=api.Drawn(60.0, 2), head=api.Drawn(2.0, 1))
    overlay = lively.over(13, 25.0)
    shut = int(np.argmax(overlay.closure))
    assert overlay.closure[shut] > 0.95
    frames = [
        [face.measure(positions) for positions in face.performance([cue], 25.0, liveliness=wanted)]
        for wanted in (lively, None)
    ]
    alive, still = frames[0][shut], frames[1][shut]
    for upper, lower in ((19, 21), (20, 22)):
        assert alive[upper - 1] + alive[lower - 1] > 0.93 * 1024.0
        assert still[upper - 1] + still[lower - 1] < 0.5 * 1024.0
    mouth = [number - 1 for number in (6, 7, 12, 13)]
    np.testing.assert_allclose(alive[mouth], still[mouth], atol=2.0)
    np.testing.assert_allclose(alive[47:50], overlay.added[shut, 47:50], rtol=0.1, atol=30.0)
    assert np.abs(alive[47:50]).max() > 200.0
    np.testing.assert_allclose(np.nan_to_num(frames[0][0]), 0.0, atol=1.0)


def test_a_bored_head_leans_in_a_performance_that_moves_it() -> None:
    cue = api.Cue(api.expression("bored"), onset=0.2, apex=0.2, offset=0.2)
    lively = api.Liveliness(head=api.Drawn(1e-9), eyes=api.Drawn(1.0, 1))
    still, alive, exact = (
        [plan.request.faps for plan in cue_plans([cue], 10.0, drive, liveliness=wanted)]
        for drive, wanted in ((Drive.NATURAL, None), (Drive.NATURAL, lively), (Drive.EXACT, lively))
    )
    assert np.isnan(still[3][[22, 47]]).all()
    looks = lively.over(len(alive), 10.0).added[3, 22]
    assert alive[3][23 - 1] - looks == pytest.approx(np.radians(14.0) / 1e-5)
    assert exact[3][23 - 1] == pytest.approx(looks)
    assert alive[0][23 - 1] == pytest.approx(0.0)
