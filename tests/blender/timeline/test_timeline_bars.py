"""Bars of clips in a timeline editor: lanes, corners, what is grabbed, and what a drag makes of it."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from risorius.operators.timeline import colours
from risorius.operators.timeline.bars import GAP, LANE, LEAST_LANE, RULER, Bar, Grip, dragged, lay_out
from risorius.operators.timeline.colours import colour_of, icon_of
from risorius.operators.wheel.picture import COLOURS

FPS = 25.0


def clip(start: int, onset: float = 0.4, apex: float = 0.8, offset: float = 0.4) -> SimpleNamespace:
    return SimpleNamespace(start=start, onset=onset, apex=apex, offset=offset)


def laid(*clips: SimpleNamespace, height: float = 200.0) -> list[Bar]:
    return lay_out(clips, FPS, lambda frame: 2.0 * frame + 10.0, height, 1.0)


def test_a_bar_has_its_corners_where_its_times_are() -> None:
    (bar,) = laid(clip(10))
    assert bar.corners == pytest.approx((30.0, 50.0, 90.0, 110.0))
    assert bar.high == 200.0 - RULER
    assert bar.high - bar.low == LANE - GAP


def test_bars_that_overlap_lie_in_lanes_and_others_in_the_first() -> None:
    bars = laid(clip(100), clip(0), clip(20), clip(40), clip(141))
    tops = [round((200.0 - RULER - bar.high) / LANE) for bar in bars]
    assert tops == [0, 0, 1, 0, 0]
    assert [bar.number for bar in bars] == [0, 1, 2, 3, 4]


def test_lanes_shrink_where_there_is_little_room() -> None:
    bars = laid(clip(0), clip(5), clip(10), height=RULER + 30.0)
    assert [bar.high - bar.low for bar in bars] == pytest.approx([10.0 - GAP] * 3)
    crowded = laid(*(clip(k) for k in range(30)), height=RULER + 30.0)
    assert crowded[0].high - crowded[0].low == pytest.approx(LEAST_LANE - GAP)


def test_what_is_grabbed() -> None:
    (bar,) = laid(clip(10))
    y = (bar.low + bar.high) / 2.0
    there = {33.0: Grip.START, 50.0: Grip.ONSET, 70.0: Grip.START, 91.0: Grip.APEX, 108.0: Grip.OFFSET}
    assert {x: bar.grip(x, y, 4.0) for x in there} == there
    assert bar.grip(20.0, y, 4.0) is None
    assert bar.grip(70.0, bar.low - 1.0, 4.0) is None
    (peaked,) = laid(clip(10, apex=0.0))
    assert peaked.grip(50.0, y, 4.0) is Grip.APEX


def test_a_drag_goes_by_whole_frames_and_times_stay_above_nothing() -> None:
    assert dragged(Grip.START, 10, 2.6, FPS) == 13.0
    assert dragged(Grip.START, 1, -5.0, FPS) == -4.0
    assert dragged(Grip.APEX, 0.8, 5.2, FPS) == pytest.approx(1.0)
    assert dragged(Grip.ONSET, 0.1, -50.0, FPS) == 0.0


def test_an_emotion_has_its_archetypes_colour(head: Any) -> None:
    emotion = head.risorius.emotion
    emotion.word = "anger"
    assert colour_of(emotion) == pytest.approx(COLOURS["anger"])  # type: ignore[index]
    emotion.word = "guilty"
    sad, afraid = COLOURS["sadness"], COLOURS["fear"]  # type: ignore[index]
    for mixed, one, other in zip(colour_of(emotion), sad, afraid, strict=True):
        assert min(one, other) <= mixed <= max(one, other)
    emotion.word = "neutral"
    assert len({*colour_of(emotion)}) == 1


def test_each_archetype_has_an_icon_of_its_colour_drawn_once(head: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    class Icons(dict[str, SimpleNamespace]):
        """Blender's collection of icons, which have no numbers in background."""

        def new(self, name: str) -> SimpleNamespace:
            return self.setdefault(name, SimpleNamespace(icon_id=len(self) + 1))

    drawn: list[tuple[float, float, float]] = []
    monkeypatch.setattr(colours, "_icons", Icons())
    monkeypatch.setattr(colours, "_draw_icon", lambda _icon, colour: drawn.append(colour))
    emotion, numbers = head.risorius.emotion, []
    for word in ("anger", "furious", "guilty", "sadness", "neutral"):
        emotion.word = word
        numbers.append(icon_of(emotion))
    assert numbers == [1, 1, 2, 2, 3]
    assert drawn == [COLOURS["anger"], COLOURS["sadness"], colours.GREY]  # type: ignore[index]
