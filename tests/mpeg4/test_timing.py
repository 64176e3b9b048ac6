"""Expressions in time: smooth ramps, blending without doubling, silence kept."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from risorius.errors import FormatError, ParameterError
from risorius.mpeg4 import (
    ARCHETYPES,
    Archetype,
    Cue,
    Profile,
    emotion_weights,
    envelope,
    expression,
    load_timings,
    sequence,
)

FPS = 1000.0
JOY, FEAR, GUILTY = expression("joy"), expression("fear"), expression("guilty")
seconds = st.floats(0.0, 1.5)


def _made(number: int, value: float, name: Archetype = Archetype.JOY) -> Profile:
    """A profile that asks one FAP for one value."""
    return Profile(ranges={number: (value, value)}, activation=4.0, angle=0.0, weights={name: 1.0}, category=name)


@given(seconds, seconds, seconds, st.sampled_from([10.0, 24.0, 25.0, 29.97, 60.0]))
def test_an_envelope_begins_and_ends_at_rest_and_reaches_its_apex(
    onset: float, apex: float, offset: float, fps: float
) -> None:
    apex, onset, offset = apex + 2.0 / fps, onset + 0.01, offset + 0.01
    frames = envelope(JOY, onset=onset, apex=apex, offset=offset, fps=fps)
    total = onset + apex + offset
    assert (len(frames) - 1) / fps == pytest.approx(total, abs=1.0 / fps)
    assert (len(frames) - 1) / fps >= total - 1e-6
    goal = JOY.frame()
    asked = ~np.isnan(goal)
    np.testing.assert_array_equal(np.isnan(frames), np.broadcast_to(~asked, frames.shape))
    np.testing.assert_allclose(frames[[0, -1]][:, asked], 0.0, atol=1e-9)
    holds = [k for k in range(len(frames)) if onset <= k / fps <= onset + apex]
    assert holds
    np.testing.assert_allclose(frames[holds][:, asked], np.broadcast_to(goal[asked], (len(holds), asked.sum())))
    assert np.abs(frames[:, asked]).max() <= np.abs(goal[asked]).max() + 1e-9


def test_the_ramps_are_smooth() -> None:
    frames = envelope(_made(31, 1.0), onset=0.4, apex=0.3, offset=0.6, fps=FPS)[:, 30]
    speed = np.diff(frames) * FPS
    assert np.abs(speed).max() == pytest.approx(1.875 / 0.4, rel=1e-3)  # minimum jerk: peak speed 15/8 of the mean
    assert np.abs(np.diff(speed)).max() * FPS < 6.0 / 0.4**2  # bounded acceleration (5.77 in units of 1/T^2): no jump
    assert np.all(np.diff(frames[:401]) >= 0.0)
    assert np.all(np.diff(frames[700:]) <= 0.0)
    assert frames[200] == pytest.approx(0.5)


def test_steps_are_allowed() -> None:
    frames = envelope(_made(31, 1.0), onset=0.0, apex=0.2, offset=0.0, fps=10.0)[:, 30]
    np.testing.assert_array_equal(frames, [1.0, 1.0, 0.0])


def test_peak_and_seed() -> None:
    half = envelope(JOY, onset=0.2, apex=0.2, offset=0.2, fps=10.0, peak=0.5)
    np.testing.assert_allclose(half[3], JOY.frame() * 0.5)
    drawn = envelope(JOY, onset=0.2, apex=0.2, offset=0.2, fps=10.0, seed=3)
    np.testing.assert_allclose(drawn[3], JOY.frame(3))
    assert not np.allclose(drawn[3], JOY.frame(), equal_nan=True)


def test_a_sequence_waits_rests_and_keeps_silence() -> None:
    cues = [
        Cue(JOY, start=0.2, onset=0.2, apex=0.2, offset=0.2),
        Cue(FEAR, start=1.2, onset=0.2, apex=0.2, offset=0.2),
    ]
    frames = sequence(cues, fps=10.0)
    assert frames.shape == (19, 68)
    asked = ~np.isnan(JOY.frame()) | ~np.isnan(FEAR.frame())
    np.testing.assert_array_equal(np.isnan(frames), np.broadcast_to(~asked, frames.shape))
    np.testing.assert_allclose(frames[[0, 1, 9, 10, 11, 18]][:, asked], 0.0, atol=1e-9)
    goal = JOY.frame()
    np.testing.assert_allclose(frames[5][~np.isnan(goal)], goal[~np.isnan(goal)])
    only_fear = ~np.isnan(FEAR.frame()) & np.isnan(goal)
    assert only_fear.any()
    np.testing.assert_array_equal(frames[5][only_fear], 0.0)


def test_overlapping_cues_share_a_fap_instead_of_doubling_it() -> None:
    timing = {"onset": 0.2, "apex": 1.0, "offset": 0.2}
    twice = sequence([Cue(JOY, **timing), Cue(JOY, **timing)], fps=10.0)
    np.testing.assert_allclose(twice[6], JOY.frame())
    mixed = sequence([Cue(_made(31, 100.0), **timing), Cue(_made(31, -40.0), **timing)], fps=10.0)
    assert mixed[6, 30] == pytest.approx(30.0)
    apart = sequence([Cue(_made(31, 100.0), **timing), Cue(_made(3, 50.0), **timing)], fps=10.0)
    assert (apart[6, 30], apart[6, 2]) == pytest.approx((100.0, 50.0))


def test_a_cross_fade_keeps_what_both_hold() -> None:
    cues = [
        Cue(_made(31, 100.0), onset=0.3, apex=0.3, offset=0.4),
        Cue(_made(31, 100.0), start=0.6, onset=0.4, apex=0.3, offset=0.3),
    ]
    frames = sequence(cues, fps=FPS)[:, 30]
    np.testing.assert_allclose(frames[300:1300], 100.0, atol=1e-9)


@given(
    st.lists(
        st.tuples(st.sampled_from([JOY, FEAR, GUILTY]), seconds, seconds, st.floats(0.0, 1.0)), min_size=1, max_size=4
    )
)
def test_a_blend_never_exceeds_what_was_asked(parts: list[tuple[Profile, float, float, float]]) -> None:
    cues = [Cue(p, start=start, onset=0.1, apex=apex, offset=0.2, peak=peak) for p, start, apex, peak in parts]
    frames = sequence(cues, fps=20.0)
    goals = np.array([cue.profile.frame() for cue in cues])
    asked = ~np.isnan(goals).all(axis=0)
    assert np.array_equal(~np.isnan(frames[0]), asked)
    assert np.all(frames[:, asked] <= np.nanmax(goals[:, asked], axis=0, initial=0.0) + 1e-9)
    assert np.all(frames[:, asked] >= np.nanmin(goals[:, asked], axis=0, initial=0.0) - 1e-9)
    weights = emotion_weights(cues, fps=20.0)
    assert weights.shape == (len(frames), 6)
    assert weights.min() >= 0.0
    assert weights.sum(axis=1).max() <= 1.0 + 1e-9
    np.testing.assert_allclose(sequence(cues[::-1], fps=20.0), frames, atol=1e-9)


def test_emotion_weights_of_a_category_of_a_mixture_and_of_nothing() -> None:
    timing = {"onset": 0.2, "apex": 0.2, "offset": 0.2}
    joy = emotion_weights([Cue(expression("delighted"), **timing)], fps=10.0)
    np.testing.assert_allclose(joy[3], [1.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    np.testing.assert_allclose(joy[0], 0.0, atol=1e-12)
    assert joy[1, 0] == pytest.approx(0.5)
    guilty = emotion_weights([Cue(GUILTY, peak=0.5, **timing)], fps=10.0)
    expected = [0.5 * GUILTY.weights.get(name, 0.0) for name in ARCHETYPES]
    np.testing.assert_allclose(guilty[3], expected)
    assert expected[1] == pytest.approx(0.5 * 32.0 / 38.2)
    np.testing.assert_array_equal(emotion_weights([Cue(expression("neutral"), **timing)], fps=10.0), 0.0)


@pytest.mark.parametrize(
    ("change", "name"),
    [({"onset": -0.1}, "onset"), ({"apex": float("nan")}, "apex"), ({"offset": "long"}, "offset"),
     ({"start": -1.0}, "start"), ({"peak": 1.2}, "peak"),
     ({"onset": 0.0, "apex": 0.0, "offset": 0.0}, r"onset \+ apex \+ offset")],
)  # fmt: skip
def test_wrong_times_are_refused_by_name(change: dict[str, object], name: str) -> None:
    timing: dict[str, object] = {"onset": 0.2, "apex": 0.2, "offset": 0.2, **change}
    with pytest.raises(ParameterError, match=name):
        Cue(JOY, **timing)  # type: ignore[arg-type]


@pytest.mark.parametrize("fps", [0.0, -25.0, float("nan"), "fast"])
def test_a_wrong_rate_is_refused(fps: object) -> None:
    with pytest.raises(ParameterError, match="fps"):
        envelope(JOY, onset=0.1, apex=0.1, offset=0.1, fps=fps)  # type: ignore[arg-type]


def test_no_cue_is_refused() -> None:
    with pytest.raises(ParameterError, match="at least one cue"):
        sequence([])
    with pytest.raises(ParameterError, match="at least one cue"):
        emotion_weights([])


def test_the_timing_presets() -> None:
    timings = load_timings()
    assert list(timings) == ["flash", "natural", "posed", "spontaneous", "slow"]
    totals = [timings[name].onset + timings[name].apex + timings[name].offset for name in ("flash", "natural", "slow")]
    assert totals == sorted(totals)
    assert all(timing.reason and timing.offset >= timing.onset for timing in timings.values())


def _fastest(strength: NDArray[np.float64]) -> float:
    """Greatest speed of a strength sampled at FPS, per second."""
    return float(np.abs(np.diff(strength)).max() * FPS)


def test_posed_expressions_differ_from_spontaneous_ones_as_measured() -> None:
    """Schmidt et al. 2006: faster onset and offset, greater amplitude, longer offset."""
    posed, felt = load_timings()["posed"], load_timings()["spontaneous"]
    assert posed.source
    assert felt.source
    assert posed.peak > felt.peak
    assert posed.offset > felt.offset
    paths = []
    for timing in (posed, felt):
        frames = sequence([timing.cue(_made(31, 1.0))], fps=FPS)[:, 30]
        assert frames.max() == pytest.approx(timing.peak)
        apex = int((timing.onset + 0.5 * timing.apex) * FPS)
        paths.append((_fastest(frames[:apex]), _fastest(frames[apex:])))
    assert paths[0][0] > 1.3 * paths[1][0]
    assert paths[0][1] > 1.1 * paths[1][1]


@pytest.mark.parametrize(("ramp", "fastest"), [("minimum_jerk", 15.0 / 8.0), ("cosine", np.pi / 2.0)])
def test_ramps_have_their_closed_forms(ramp: str, fastest: float) -> None:
    """The greatest speed is in proportion to the amplitude and against the duration, as measured of smiles."""
    for peak, onset in ((1.0, 0.4), (0.5, 0.8)):
        frames = envelope(_made(31, 1.0), onset=onset, apex=0.2, offset=0.4, peak=peak, ramp=ramp, fps=FPS)[:, 30]
        rise = frames[: int(onset * FPS) + 1]
        assert _fastest(rise) == pytest.approx(fastest * peak / onset, rel=1e-3)
        assert rise[len(rise) // 2] == pytest.approx(0.5 * peak)
        np.testing.assert_allclose(rise + rise[::-1], peak, atol=1e-9)


def test_an_unknown_ramp_is_refused() -> None:
    with pytest.raises(ParameterError, match="ramp"):
        envelope(JOY, onset=0.1, apex=0.1, offset=0.1, ramp="bounce")


@pytest.mark.parametrize(
    ("text", "key"),
    [("[a]\nonset = -1\napex = 1\noffset = 1\nreason = 'x'", "a.onset"),
     ("[a]\nonset = 1\napex = inf\noffset = 1\nreason = 'x'", "a.apex"),
     ("[a]\nonset = 1\napex = 1\nreason = 'x'", "a.offset"),
     ("[a]\nonset = 1\napex = 1\noffset = 1\nreason = ''", "a.reason"),
     ("[a]\nonset = 1\napex = 1\noffset = 1\nreason = 'x'\nramp = 'bounce'", "a.ramp"),
     ("[a]\nonset = 1\napex = 1\noffset = 1\nreason = 'x'\npeak = 2.0", "a.peak"),
     ("a = 1", "a"), ("[a", None)],
)  # fmt: skip
def test_a_wrong_timing_preset_names_file_and_key(tmp_path: Path, text: str, key: str | None) -> None:
    path = tmp_path / "timing.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(FormatError, match=r"timing\.toml") as caught:
        load_timings(path)
    assert caught.value.key == key
