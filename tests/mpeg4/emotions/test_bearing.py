"""Words that turn eyes and head."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from risorius.errors import FormatError
from risorius.mpeg4 import Cue, Drawn, Liveliness, expression, load_emotions
from risorius.mpeg4.emotions.bearing import Bearing, read_bearing
from risorius.tables import read_toml

SILENT = np.full(68, np.nan)


def cue(word: str, variants: int | None = None) -> Cue:
    return Cue(expression(word, variants=variants), onset=0.4, apex=1.0, offset=0.6)


def degrees(units: float) -> float:
    return float(np.degrees(units * 1e-5))


def test_bashful_looks_down_and_turns_away_as_far_as_head_and_eyes_move_at_all() -> None:
    full = Liveliness(head=Drawn(1.0), eyes=Drawn(3.0)).borne(SILENT, [(cue("bashful"), 1.0)])
    bearing = expression("bashful").bearing
    assert bearing is not None
    assert degrees(full[25 - 1]) == degrees(full[26 - 1]) == pytest.approx(bearing.eyes[1])
    assert degrees(full[48 - 1]) == pytest.approx(bearing.head[1])
    assert degrees(full[49 - 1]) == pytest.approx(bearing.head[0])
    still = Liveliness(eyes=Drawn(0.5)).borne(SILENT, [(cue("bashful"), 0.5)])
    assert np.isnan(still[48 - 1])
    assert degrees(still[25 - 1]) == pytest.approx(bearing.eyes[1] / 4.0)
    assert np.isnan(full[:22]).all()


def test_it_adds_to_what_is_asked_and_archetypes_have_none() -> None:
    lively = Liveliness(head=Drawn(1.0), eyes=Drawn(1.0))
    np.testing.assert_array_equal(lively.borne(SILENT, [(cue("joy"), 1.0)]), SILENT)
    asked = SILENT.copy()
    asked[48 - 1] = 1000.0
    alone = lively.borne(SILENT, [(cue("bored"), 1.0)])
    assert lively.borne(asked, [(cue("bored"), 1.0)])[48 - 1] == pytest.approx(1000.0 + alone[48 - 1])


def test_a_variant_of_the_paper_has_none() -> None:
    assert expression("contemptuous").bearing is not None
    assert expression("contemptuous", variants=0).bearing is None


@pytest.mark.parametrize(
    ("row", "said"),
    [("eyes = [0, 60]", "bearing.eyes: must be degrees"), ("eyes = [0]", "bearing.eyes"), ("neck = 1", "neck")],
)
def test_a_wrong_row_is_refused(tmp_path: Path, row: str, said: str) -> None:
    text = '[shy]\nactivation = 2\nangle = 74\nreason = "r"\nsource = "s"\n[shy.bearing]\nsource = "s"\n'
    (tmp_path / "shy.toml").write_text(text + row + "\n", encoding="utf-8")
    with pytest.raises(FormatError, match=said):
        load_emotions([tmp_path])
    (tmp_path / "shy.toml").write_text(text + "head = [0, 9, 0]\n", encoding="utf-8")
    assert load_emotions([tmp_path])["shy"].bearing == Bearing(head=(0.0, 9.0, 0.0))
    assert read_bearing(read_toml(tmp_path / "shy.toml").table("shy").table("bearing")).eyes == (0.0, 0.0)
