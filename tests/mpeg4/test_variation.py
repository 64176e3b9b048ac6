"""Natural variation: drawn by seed, inside the ranges, with the rates and sizes that its table says."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from risorius.errors import FormatError, ParameterError
from risorius.mpeg4 import expression, load_prototypes
from risorius.mpeg4.variation import (
    HABITS,
    Drawn,
    Liveliness,
    blink_closure,
    drawn_within,
    eye_motion,
    head_motion,
    load_habits,
    way_drawn,
)

ALL = Liveliness(blinks=Drawn(20.0, 3), head=Drawn(1.0, 4), eyes=Drawn(1.0, 5))
HABIT = load_habits()


def degrees(values: np.ndarray) -> np.ndarray:
    return np.degrees(values * 1e-5)


def onsets(closure: np.ndarray) -> np.ndarray:
    """Frames at which a closing begins."""
    return np.flatnonzero((closure[1:] > 0.0) & (closure[:-1] == 0.0))


def test_draws_stay_inside_the_ranges_and_go_from_the_middle_to_the_draw() -> None:
    profile = expression("fear")
    frames = [drawn_within(profile, Drawn(amount, 7)).frame() for amount in (0.0, 0.5, 1.0)]
    np.testing.assert_allclose(frames[0], profile.frame())
    np.testing.assert_allclose(frames[2], profile.frame(7))
    np.testing.assert_allclose(frames[1], (frames[0] + frames[2]) / 2.0)
    for number, (low, high) in profile.ranges.items():
        assert low - 1e-9 <= frames[2][number - 1] <= high + 1e-9
    assert np.nanmax(np.abs(frames[2] - frames[0])) > 10.0
    with pytest.raises(ParameterError, match=r"0\.\.1"):
        drawn_within(profile, Drawn(1.1, 1))


def test_the_way_of_showing_an_emotion_is_drawn_unless_one_was_chosen() -> None:
    anger = expression("anger")
    drawn = [drawn_within(anger, Drawn(1.0, seed)).prototypes["anger"] for seed in range(200)]
    assert 60 < drawn.count("pressed") < 140
    assert drawn == [way_drawn(anger, Drawn(1.0, seed)).prototypes["anger"] for seed in range(200)]
    seldom = [drawn_within(anger, Drawn(0.2, seed)).prototypes["anger"] for seed in range(200)]
    assert 5 < seldom.count("pressed") < 40
    assert drawn_within(anger, Drawn(0.0, 1)).prototypes["anger"] == "bared"
    for variant in ("pressed", 2):
        chosen = expression("anger", variants=variant)
        assert all(way_drawn(chosen, Drawn(1.0, seed)) == chosen for seed in range(9))
    assert way_drawn(expression("bored"), Drawn(1.0, 1)).shows is not None  # has its own units
    for emotion, ways in load_prototypes().items():
        assert (len(ways) > 1) == (emotion in way_drawn(expression(emotion), Drawn(1.0, 1)).prototypes)
    between = expression(angle=250.0, activation=5.0)
    assert set(way_drawn(between, Drawn(1.0, 1)).prototypes) <= set(between.weights)


def test_blinks_come_at_the_rate_asked_for_at_log_normal_intervals() -> None:
    fps, minutes = 100.0, 60.0
    closure = blink_closure(int(fps * 60.0 * minutes), fps, Drawn(17.0, 1), HABIT.blink)
    between = np.diff(onsets(closure)) / fps
    assert len(between) / minutes == pytest.approx(17.0, rel=0.06)
    assert np.log(between).std() == pytest.approx(HABIT.blink.interval_spread, rel=0.08)
    skew = float((((between - between.mean()) / between.std()) ** 3).mean())
    assert skew > 1.0


def test_a_blink_shuts_fast_and_opens_slower() -> None:
    """Half shut after half the closing, half open half the opening before the end, all of it stretched alike."""
    fps, habit = 1000.0, HABIT.blink
    closure = blink_closure(600_000, fps, Drawn(17.0, 2), habit)
    begun = onsets(closure)
    half = np.flatnonzero((closure[1:] >= 0.5) != (closure[:-1] >= 0.5)) + 1
    closing, open_for = half[::2] - begun, half[1::2] - half[::2]
    assert closure.max() == 1.0
    assert 2.0 * np.median(closing) / fps == pytest.approx(habit.closing, rel=0.05)
    assert np.log(closing).std() == pytest.approx(habit.duration_spread, rel=0.1)
    shape = (habit.closing + 2.0 * habit.closed + habit.opening) / habit.closing
    np.testing.assert_allclose(open_for / closing, shape, rtol=0.06)
    assert 1.4 < habit.opening / habit.closing < 1.47


def test_lids_shut_from_wherever_they_are_and_come_back_there() -> None:
    overlay = Liveliness(blinks=Drawn(30.0, 1)).over(500, 50.0)
    wide = np.full(68, np.nan)
    wide[18:20] = -300.0
    frames = overlay.upon_all(np.tile(wide, (500, 1)))
    shut, open_now = int(np.argmax(overlay.closure)), int(np.argmin(overlay.closure))
    assert frames[shut, 18] + frames[shut, 20] == pytest.approx(1024.0)
    np.testing.assert_array_equal(frames[open_now], wide)


def test_head_and_eyes_move_as_little_as_the_table_says_and_rest_at_both_ends() -> None:
    count, fps = 60 * 600, 60.0
    head = degrees(head_motion(count, fps, Drawn(1.0, 1), HABIT.head)[:, 47:50])
    np.testing.assert_allclose(head.std(axis=0), [HABIT.head.pitch, HABIT.head.yaw, HABIT.head.roll], rtol=0.1)
    assert np.abs(np.diff(head, axis=0)).max() * fps < 20.0
    eyes = degrees(eye_motion(count, fps, Drawn(1.0, 1), HABIT.eyes)[:, 22:26])
    np.testing.assert_array_equal(eyes[:, 0], eyes[:, 1])
    assert eyes[:, 0].std() == pytest.approx(HABIT.eyes.aside, rel=0.15)
    assert eyes[:, 2].std() == pytest.approx(HABIT.eyes.aside * HABIT.eyes.vertical, rel=0.15)
    for motion in (head, eyes):
        np.testing.assert_allclose(motion[[0, -1]], 0.0, atol=1e-9)


def test_eyes_stand_still_between_saccades() -> None:
    yaw = degrees(eye_motion(6000, 100.0, Drawn(1.0, 9), HABIT.eyes)[:, 22])
    still = np.abs(np.diff(yaw)) < 1e-9
    assert still.mean() > 0.9
    speed = np.abs(np.diff(yaw)).max() * 100.0
    assert speed > 50.0


def test_nothing_else_is_said_and_nothing_asked_for_is_nothing() -> None:
    overlay = ALL.over(200, 25.0)
    said = ~np.isnan(overlay.upon_all(np.full((200, 68), np.nan))).all(axis=0)
    moved = {int(number) + 1 for number in np.flatnonzero((~np.isnan(overlay.added)).any(axis=0))}
    assert moved == {23, 24, 25, 26, 48, 49, 50}
    assert set((np.flatnonzero(said) + 1).tolist()) == moved | {19, 20, 21, 22}
    calm = Liveliness()
    assert not calm.any
    frames = np.random.default_rng(0).normal(size=(9, 68))
    np.testing.assert_array_equal(calm.over(9, 25.0).upon_all(frames), frames)


def test_one_seed_is_one_motion_at_any_rate_and_length() -> None:
    slow, fast = ALL.over(250, 25.0), ALL.over(500, 50.0)
    np.testing.assert_allclose(slow.closure, fast.closure[::2], atol=1e-12)
    longer = ALL.over(500, 25.0)
    np.testing.assert_array_equal(slow.closure, longer.closure[:250])
    np.testing.assert_allclose(slow.added[20:200], longer.added[20:200])
    other = Liveliness(blinks=Drawn(20.0, 30), head=Drawn(1.0, 40), eyes=Drawn(1.0, 50)).over(250, 25.0)
    assert not np.allclose(slow.closure, other.closure)
    assert not np.allclose(np.nan_to_num(slow.added), np.nan_to_num(other.added))


@pytest.mark.parametrize(
    ("amount", "seed", "refused"),
    [
        (-1.0, 0, "amount must be 0 or more"),
        (math.nan, 0, "amount must be 0 or more"),
        (1.0, -1, "seed must be a whole number, 0 or more"),
    ],
)
def test_bad_amounts_are_refused(amount: float, seed: int, refused: str) -> None:
    with pytest.raises(ParameterError, match=f"^{refused}"):
        Drawn(amount, seed)


def test_a_bad_table_is_refused_with_its_key(tmp_path: Path) -> None:
    text = HABITS.read_text(encoding="utf-8")
    for number, (old, new, key) in enumerate(
        [("rate = 17.0", "rate = -1", "blink.rate"), ("roll = 0.7", "rol = 0.7", "key head")]
    ):
        path = tmp_path / f"{number}.toml"
        path.write_text(text.replace(old, new), encoding="utf-8")
        with pytest.raises(FormatError, match=key):
            load_habits(path)
