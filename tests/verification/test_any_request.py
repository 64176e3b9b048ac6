"""Any request by a script: finite figures come out, or an error in words. No NaN ever leaves."""

from __future__ import annotations

import warnings
from collections.abc import Callable

import numpy as np
import pytest
import risorius.api as api
from hypothesis import event, given, settings
from hypothesis import strategies as st
from risorius.errors import RisoriusError
from risorius.mpeg4 import FAP_LIMIT
from risorius.mpeg4.preset_file import Choice, Clip, Preset, PresetKind, read_preset, write_preset
from risorius.mpeg4.variation import Overlay
from risorius.speech.phonemes import phonemes

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


def mostly(usual: st.SearchStrategy[float], odd: st.SearchStrategy[float]) -> st.SearchStrategy[float]:
    """Nine in ten of what is usual, so that of many values together not all are refused."""
    return st.integers(0, 9).flatmap(lambda chance: usual if chance else odd)


#: How much blinks, head and eyes may do, by which seed, and over how long a time.
amount = mostly(st.floats(0.0, 20.0), st.sampled_from([301.0, 1e9, 1e30, 1e308, np.inf, np.nan, -1.0, -0.0, 5e-324]))
seed = mostly(st.integers(0, 2**70), st.one_of(st.integers(-3, 3), number))
frames_per_second = mostly(st.floats(2.0, 300.0), st.one_of(st.sampled_from([0.001, 1e5]), number))
frame_count = mostly(st.sampled_from([0, 1, 2, 50, 3000]), st.sampled_from([-1, 10**9]))


@settings(bounded, max_examples=120)
@given(
    drawn=st.tuples(*[st.tuples(amount, seed)] * 3),
    fps=frames_per_second,
    count=frame_count,
    open_lids=st.booleans(),
)
def test_liveliness(drawn: tuple[tuple[float, float], ...], fps: float, count: int, open_lids: bool) -> None:
    """Blinks close the lids at most once over, head and eyes stay where necks and lids let them, and rest at both ends;
    a longer one begins as a shorter one. Frames of it alone are those of it all."""

    def laid() -> tuple[Overlay, np.ndarray]:
        overlay = api.Liveliness(*(api.Drawn(*each) for each in drawn)).over(count, fps)
        frames = np.full((count, 68), np.nan)
        frames[:, 18:20] = -100.0 if open_lids else np.nan
        return overlay, overlay.upon_all(frames)

    found = or_refused(laid)
    event("refused" if found is None else "laid")
    if found is None:
        return
    overlay, frames = found
    assert len(frames) == count
    assert not np.isinf(frames).any()
    finite(overlay.closure, np.nan_to_num(frames))
    assert ((overlay.closure >= 0.0) & (overlay.closure <= 1.0 + 1e-12)).all()
    assert np.nanmax(np.abs(frames), initial=0.0) < FAP_LIMIT
    if count > 1:
        np.testing.assert_allclose(np.nan_to_num(overlay.added[0]), 0.0, atol=1e-6)
        np.testing.assert_array_equal(
            overlay.upon(frames[0] * 0.0, 0)[18:22], overlay.upon_all(frames[:1] * 0.0)[0, 18:22]
        )


def test_liveliness_is_drawn_for_most_of_what_is_tried() -> None:
    """The property above is none if all is refused: ordinary amounts move lids, head and eyes."""
    overlay = api.Liveliness(api.Drawn(30.0, 1), api.Drawn(1.0, 2), api.Drawn(1.0, 3)).over(1500, 25.0)
    assert overlay.closure.max() > 0.9
    assert set(np.flatnonzero(np.nan_to_num(overlay.added).std(axis=0) > 1.0) + 1) == {23, 24, 25, 26, 48, 49, 50}


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


#: Shares of lips, jaw and feeling; beyond 0 to 2 they are refused.
share = mostly(st.floats(0.0, 2.0), number)
symbol = st.sampled_from(["p", "a", "m", "i", "f", "u", "t", "s", "tʃ", "x", ""])


@settings(bounded, max_examples=100)
@given(
    spoken=st.lists(st.tuples(symbol, mostly(st.floats(0.01, 0.6), number)), max_size=6),
    duration=mostly(st.floats(0.0, 3.0), number),
    shares=st.tuples(share, share, share),
    felt=st.one_of(st.none(), word),
    fps=mostly(st.floats(5.0, 120.0), number),
    drawn=mostly(st.integers(0, 2**40), st.one_of(st.none(), number)),
)
def test_speech(
    spoken: list[tuple[str, float]],
    duration: float,
    shares: tuple[float, float, float],
    felt: str | None,
    fps: float,
    drawn: float | None,
) -> None:
    """Whatever is said, how, at whichever rate: frames within what a face can be asked for, or an error in words."""

    def said() -> api.FapStream:
        sounds, at = [], 0.0
        for name, lasts in spoken:
            sounds.append(api.Sound(at, at + lasts, phonemes().get(name, phonemes()["a"]), name))
            at += lasts
        articulation, jaw, lean = shares
        emotion = None if felt is None else api.expression(felt)
        lively = None if drawn is None else api.Liveliness.usual(drawn)
        options = {"articulation": articulation, "jaw": jaw, "lean": lean, "fps": fps, "seed": drawn}
        utterance = api.Utterance(tuple(sounds), max(duration, at))
        return api.say(utterance, emotion=emotion, liveliness=lively, **options).stream

    stream = or_refused(said)
    event("refused" if stream is None else "said")
    if stream is not None:
        assert len(stream.frames) <= 1_000_000
        finite(np.nan_to_num(stream.frames))
        assert np.nanmax(np.abs(stream.frames), initial=0.0) <= FAP_LIMIT


@settings(bounded, max_examples=100)
@given(
    shown=st.tuples(
        st.one_of(word, st.none()),
        mostly(st.floats(1.0, 7.0), number),
        st.one_of(st.none(), number),
        st.text(max_size=9),
    ),
    times=st.tuples(*[mostly(st.floats(0.0, 20.0), number)] * 4),
    peak=mostly(st.floats(0.0, 1.0), number),
    named=st.text(max_size=20),
)
def test_presets_come_back_from_their_file(
    shown: tuple[str | None, float, float | None, str],
    times: tuple[float, float, float, float],
    peak: float,
    named: str,
    tmp_path_factory: pytest.TempPathFactory,
) -> None:
    """What can be made can be written, and what is written is read as it was: to a millionth."""
    name, activation, angle, variant = shown
    start, onset, apex, offset = times

    def made() -> Preset:
        choice = Choice(activation, word=name, angle=angle, variant=variant or None)
        clip = Clip(choice, start, onset, apex, offset, peak=peak, name=named)
        return Preset(PresetKind.TIMELINE, clips=(clip,))

    preset = or_refused(made)
    event("refused" if preset is None else "made")
    if preset is None:
        return
    path = tmp_path_factory.mktemp("presets") / "a.toml"
    if or_refused(lambda: write_preset(path, preset) or True) is None:
        return
    back = or_refused(lambda: read_preset(path))
    assert back is not None, path.read_text(encoding="utf-8")
    (old,), (new,) = preset.clips, back.clips
    assert (new.name, new.emotion.word, new.emotion.variant) == (old.name, old.emotion.word, old.emotion.variant)
    for which in ("start", "onset", "apex", "offset", "peak"):
        assert getattr(new, which) == pytest.approx(getattr(old, which), abs=1e-6)
