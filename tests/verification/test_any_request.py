"""Any request by a script: finite figures come out, or an error in words. No NaN ever leaves."""

from __future__ import annotations

import warnings
from collections.abc import Callable

import numpy as np
import pytest
import risorius.api as api
from hypothesis import given, settings
from hypothesis import strategies as st
from risorius.errors import RisoriusError

bounded = settings(max_examples=60, derandomize=True, deadline=None, database=None)

#: Numbers of every size, and those that are none.
number = st.one_of(
    st.floats(width=64),
    st.sampled_from([0.0, -0.0, 1.0, -1.0, 7.0, 25.0, 1e-320, 1e-12, 1e12, 1e30, 1e308, np.inf, -np.inf, np.nan]),
    st.floats(-10.0, 10.0),
)
fap_value = st.one_of(st.just(np.nan), st.floats(-3000.0, 3000.0), number)
word = st.sampled_from([*api.WORDS, "hunger", "", "joy\0"])


def finite(*arrays: object) -> None:
    """Fail where a number is not finite."""
    for array in arrays:
        assert np.isfinite(np.asarray(array, dtype=np.float64)).all(), array


def or_refused(call: Callable[[], object]) -> object:
    """What a call gives; None where it is refused in words. Warnings of NumPy count as failures."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            return call()
    except RisoriusError:
        return None


@bounded
@given(name=word, activation=number, angle=number)
def test_expressions(name: str, activation: float, angle: float) -> None:
    for profile in (
        or_refused(lambda: api.expression(name)),
        or_refused(lambda: api.expression(name, activation=activation)),
        or_refused(lambda: api.expression(angle=angle, activation=activation)),
        or_refused(lambda: api.archetype("fear", 8).scaled(activation)),
    ):
        if profile is not None:
            finite(list(profile.ranges.values()), profile.activation, np.nan_to_num(profile.frame()))


@bounded
@given(times=st.tuples(number, number, number, number), peak=number, fps=number)
def test_expressions_in_time(times: tuple[float, float, float, float], peak: float, fps: float) -> None:
    start, onset, apex, offset = times
    profile = api.expression("joy")
    frames = or_refused(
        lambda: api.sequence(
            [api.Cue(profile, start=start, onset=onset, apex=apex, offset=offset, peak=peak)], fps=min(fps, 1e4)
        )
    )
    if frames is not None:
        assert len(frames) <= 1_000_001
        finite(np.nan_to_num(frames, nan=0.0))
        assert not np.isinf(frames).any()


@bounded
@given(amounts=st.tuples(number, number, number), fps=number, count=st.sampled_from([0, 1, 2, 50]))
def test_liveliness(amounts: tuple[float, float, float], fps: float, count: int) -> None:
    def frames() -> object:
        lively = api.Liveliness(*(api.Drawn(amount, 3) for amount in amounts))
        return lively.frames(count, fps=fps) if hasattr(lively, "frames") else None

    found = or_refused(frames)
    if found is not None:
        finite(np.nan_to_num(np.asarray(found), nan=0.0))


@bounded
@given(values=st.lists(st.tuples(st.integers(0, 67), fap_value), max_size=12))
def test_recognition(values: list[tuple[int, float]]) -> None:
    frame = np.full(68, np.nan)
    for index, value in values:
        frame[index] = value
    for rule in ("paper", "robust"):
        beliefs = or_refused(lambda rule=rule: api.recognise(frame, rule=rule))
        if beliefs is not None:
            finite(list(beliefs.values()))
            assert all(0.0 <= belief <= 1.0 for belief in beliefs.values())


@bounded
@given(values=st.lists(number, min_size=15, max_size=15))
def test_features(values: list[float]) -> None:
    beliefs = or_refused(lambda: api.recognise_features(np.array(values)))
    if beliefs is not None:
        finite(list(beliefs.values()))


@pytest.mark.slow
@settings(max_examples=8, derandomize=True, deadline=None, database=None)
@given(
    values=st.lists(st.tuples(st.integers(0, 67), fap_value), max_size=12),
    drive=st.sampled_from(["natural", "exact", "muscles", "points", "other"]),
    strength=number,
)
def test_poses(values: list[tuple[int, float]], drive: str, strength: float) -> None:
    """Whatever is requested, up to the largest FAPs that are let in: finite, or refused."""
    frame = np.full(68, np.nan)
    for index, value in values:
        frame[index] = value
    face = api.default_face()
    for extra in ({}, {"contractions": {"risorius_l": strength}}, {"emotion": {"joy": strength}}):
        pose = or_refused(lambda extra=extra: face.pose(frame, drive=drive, **extra))
        if pose is not None:
            finite(pose.positions, list(pose.contractions.values()))
            assert not np.isinf(pose.achieved).any()


@bounded
@given(
    kept=st.lists(st.tuples(st.integers(0, 4), st.integers(2, 67), st.floats(-1e7, 1e7)), max_size=20),
    fps=st.floats(0.01, 1000.0),
    name=st.text(max_size=20),
)
def test_streams_come_back_from_every_file(
    kept: list[tuple[int, int, float]], fps: float, name: str, tmp_path_factory: pytest.TempPathFactory
) -> None:
    frames = np.full((5, 68), np.nan)
    for row, column, value in kept:
        frames[row, column] = round(value)
    stream = or_refused(lambda: api.FapStream(frames, fps=fps, name=name))
    if stream is None:
        return
    folder = tmp_path_factory.mktemp("streams")
    for ending in ("fap", "json", "csv"):
        path = folder / f"a.{ending}"
        if or_refused(lambda path=path: api.write_stream(path, stream) or True) is None:
            continue
        back = or_refused(lambda path=path: api.read_stream(path))
        assert back is not None, path.read_text(encoding="utf-8")
        assert np.array_equal(back.frames, stream.frames, equal_nan=True) or ending == "csv"


@bounded
@given(number=number, index=st.integers(0, 67))
def test_bitstreams_never_lie_silently(number: float, index: int) -> None:
    frames = np.full((4, 68), np.nan)
    frames[:, index] = number
    data = or_refused(lambda: api.encode_fba(api.FapStream(frames, fps=25.0)))
    if data is not None and index >= 2:
        step = api.FAPS[index + 1].quant_step
        np.testing.assert_allclose(api.decode_fba(data).stream.frames, np.rint(frames), atol=step)
