"""The measuring of `make rigs`: what it calls explained, met and a fight; its page."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import risorius.api as api
from rigging import measuring, page, take
from rigging.heads import KeyedHead
from risorius.api import Controls


@pytest.fixture(scope="module")
def head() -> KeyedHead:
    """The default head with three keys: half of joy, its opposite, and an open jaw."""
    face, joy, jaw = api.default_face(), api.expression("joy"), np.full(68, np.nan)
    jaw[2] = 400.0
    smile = face.pose(joy.frame(), emotion=joy.weights).positions - face.vertices
    opened = face.pose(jaw, drive="exact").positions - face.vertices
    zeros = np.zeros(3)
    return KeyedHead(
        "three", face, Controls(("smile", "frown", "jaw"), np.array([smile, -smile, opened]), zeros, zeros + 1.0)
    )


def test_what_a_key_makes_of_joy_is_all_of_it(head: KeyedHead) -> None:
    measured = {row.word: row for row in measuring.followed(head)}
    joy = measured["joy"]
    assert joy.plain.explained == pytest.approx(1.0, abs=1e-6)
    assert joy.ours.explained > 0.98
    assert joy.plain.every < 1e-3
    assert joy.plain.units == pytest.approx(joy.muscles, abs=0.1)
    assert joy.ours.on == 1
    for row in measured.values():
        assert row.ours.explained >= row.plain.explained - 0.02
        assert row.ours.fights == 0


def test_the_page_keeps_what_is_not_between_its_marks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    written = tmp_path / "rigs.md"
    monkeypatch.setattr(page, "PAGE", written)
    written.write_text("# Keep your rig\n\nMine.\n", encoding="utf-8")
    shown = measuring.Shown(0.9, 1.0, 0.5, 30.0, float("nan"), 4, 0)
    row = measuring.Followed("three", "joy", 20.0, shown, shown)
    page.write_page([row], [])
    first = written.read_text(encoding="utf-8")
    assert "Mine." in first
    assert "| three | joy | 0.900 0.900 |" in first
    written.write_text(first + "\nMore of mine.\n", encoding="utf-8")
    page.write_page([row], [take.Take("three", 60, *([1.0] * 13))])
    second = written.read_text(encoding="utf-8")
    assert second.count(page.START) == 1
    assert "More of mine." in second
    assert "| three | 60 |" in second
