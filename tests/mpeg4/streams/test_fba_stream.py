"""The FBA encoder and decoder: every stream survives within its quantiser, at a few kilobits per second."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from risorius.errors import FormatError, ParameterError
from risorius.mpeg4 import FAPS, ExpressionField, FapStream, VisemeField, read_fap
from risorius.mpeg4.streams.fba import decode_fba, encode_fba, read_fba, write_fba
from risorius.mpeg4.streams.fba.syntax import NTSC
from risorius.progress import Progress

PLANE_START = b"\0\0\1\xbb"
SAMPLES = (
    "greta_au_interpolation_1131",
    "vreng_anger",
    "vreng_eyes",
    "vreng_jag",
    "vreng_sad",
    "xface_anger",
    "xface_fear",
    "xface_joy",
)


def steps(quantiser: int) -> np.ndarray:
    """FAP units per level of each FAP (68,)."""
    return np.array([(FAPS[number].quant_step or 1) * quantiser if quantiser else 1 for number in FAPS], dtype=float)


def assert_within_quantiser(decoded: FapStream, stream: FapStream, quantiser: int) -> None:
    """Same masks; values within half a step of the stream's rounded ones; fields exact but for rounding.

    Beyond the largest level, which is rounded down to a whole one, values end on it.
    """
    np.testing.assert_array_equal(decoded.mask, stream.mask)
    wanted = np.rint(stream.frames)
    error = np.abs(decoded.frames - wanted)
    end = 1860 // max(quantiser, 1) * steps(quantiser)
    allowed = np.maximum(0.5 * steps(quantiser), np.abs(wanted) - end)
    assert not (error > allowed).any()
    assert np.nanmax(error / steps(quantiser), initial=0.0) < 1.0
    assert set(decoded.visemes) == set(stream.visemes)
    for index, field in stream.visemes.items():
        got = decoded.visemes[index]
        assert (got.select1, got.select2, got.define) == (field.select1, field.select2, field.define)
        assert abs(got.blend - field.blend) <= quantiser / 2
    for index, face in stream.expressions.items():
        seen = decoded.expressions[index]
        assert (seen.select1, seen.select2, seen.values[4:]) == (face.select1, face.select2, face.values[4:])
        assert abs(seen.intensity1 - face.intensity1) <= quantiser / 2
        assert abs(seen.intensity2 - face.intensity2) <= quantiser / 2


@pytest.mark.parametrize("quantiser", [1, 4, 31])
@pytest.mark.parametrize("name", SAMPLES)
def test_real_streams_survive_within_the_quantiser(shared: Path, name: str, quantiser: int) -> None:
    stream = read_fap(shared / "samples" / "fap" / f"{name}.fap")
    decoded = decode_fba(encode_fba(stream, quantiser=quantiser), strict=True)
    assert decoded.damage == ()
    assert decoded.stream.fps == stream.fps
    assert_within_quantiser(decoded.stream, stream, quantiser)


def test_lossless_streams_are_the_same(shared: Path) -> None:
    stream = read_fap(shared / "samples" / "fap" / "xface_joy.fap")
    np.testing.assert_array_equal(decode_fba(encode_fba(stream, quantiser=0)).stream.frames, stream.frames)


@pytest.mark.parametrize(("name", "most"), [("xface_joy", 5.0), ("xface_fear", 6.0), ("vreng_jag", 1.6)])
def test_a_face_takes_a_few_kilobits_per_second(shared: Path, name: str, most: float) -> None:
    stream = read_fap(shared / "samples" / "fap" / f"{name}.fap")
    seconds = len(stream.frames) / stream.fps
    assert len(encode_fba(stream)) * 8 / 1000.0 / seconds < most


limits = [(FAPS[number].intra_limits or (0, 0), FAPS[number].quant_step or 1) for number in range(3, 69)]


def row_of(seed: int) -> np.ndarray:
    """The low-level FAPs (66,) of a frame, anywhere inside the coding limits."""
    rng = np.random.default_rng(seed)
    return np.array([rng.integers(low * step, high * step + 1) for (low, high), step in limits], dtype=float)


rows = st.integers(0, 2**32 - 1).map(row_of)


@st.composite
def in_range_streams(draw: st.DrawFn) -> FapStream:
    """Frames inside the coding limits, masks that change now and then, fields of FAP 1 and 2, gaps."""
    count = draw(st.integers(1, 7))
    frames = np.full((count, 68), np.nan)
    mask = np.zeros(68, dtype=bool)
    for index in range(count):
        if index == 0 or draw(st.integers(0, 2)) == 0:
            mask = np.array(draw(st.lists(st.booleans(), min_size=68, max_size=68)))
        if draw(st.integers(0, 4)):
            frames[index, 2:] = np.where(mask[2:], draw(rows), np.nan)
    within = st.integers(0, count - 1)
    visemes = st.builds(VisemeField, *(st.integers(0, top) for top in (14, 14, 63, 1)))
    expressions = st.builds(ExpressionField, *(st.integers(0, top) for top in (6, 63, 6, 63, 1, 1)))
    return FapStream(
        frames,
        fps=draw(st.sampled_from([0.5, 2.0, 25.0, 29.97, 60.0])),
        visemes=draw(st.dictionaries(within, visemes)),
        expressions=draw(st.dictionaries(within, expressions)),
    )


@settings(max_examples=60)
@given(in_range_streams(), st.integers(1, 31), st.sampled_from([0.01, 0.5, 10.0]))
def test_any_stream_inside_the_coding_limits_survives(stream: FapStream, quantiser: int, refresh: float) -> None:
    decoded = decode_fba(encode_fba(stream, quantiser=quantiser, refresh=refresh), strict=True).stream
    assert decoded.fps == pytest.approx(stream.fps, rel=1e-5)
    assert_within_quantiser(decoded, stream, quantiser)


def test_frames_that_state_nothing_are_skipped_and_stay_unknown() -> None:
    frames = np.full((40, 68), np.nan)
    frames[[0, 1, 36, 37], 2] = 100.0, 104.0, 108.0, 112.0
    stream = FapStream(frames)
    decoded = decode_fba(encode_fba(stream), strict=True).stream
    np.testing.assert_array_equal(decoded.frames, frames)  # the last two state nothing, and are there


@pytest.mark.parametrize("quantiser", [0, 2, 4, 5, 6, 31])
def test_full_strength_is_not_rounded_beyond_itself(quantiser: int) -> None:
    expressions = {index: ExpressionField(1, 63 if index % 2 else 0, 2, 62) for index in range(4)}
    stream = FapStream(np.full((4, 68), np.nan), visemes={0: VisemeField(1, 2, 63)}, expressions=expressions)
    decoded = decode_fba(encode_fba(stream, quantiser=quantiser), strict=True).stream
    assert_within_quantiser(decoded, stream, quantiser)


def test_rates_are_coded_in_sixteenths_and_for_television() -> None:
    frames = np.zeros((2, 68))
    for fps, coded in ((12.5, 12.5), (30.0 * NTSC, 30.0 * NTSC), (24.98, 25.0 * NTSC), (12.51, 12.5)):
        assert decode_fba(encode_fba(FapStream(frames, fps=fps))).stream.fps == pytest.approx(coded, abs=0.011)
    with pytest.raises(ParameterError, match="fps"):
        encode_fba(FapStream(frames, fps=300.0))


def test_an_i_frame_comes_as_often_as_asked_and_where_the_mask_changes() -> None:
    frames = np.zeros((100, 68))
    assert encode_fba(FapStream(frames, fps=10.0), refresh=2.0).count(PLANE_START) == 5
    frames[55:, 30] = np.nan
    assert encode_fba(FapStream(frames, fps=10.0), refresh=2.0).count(PLANE_START) == 6


def test_a_jump_beyond_the_limits_of_p_frames_becomes_an_i_frame() -> None:
    frames = np.full((2, 68), np.nan)
    frames[:, 2] = -1860.0 * 4, 1860.0 * 4
    data = encode_fba(FapStream(frames))
    assert data.count(PLANE_START) == 2
    np.testing.assert_array_equal(decode_fba(data).stream.frames, frames)


@pytest.mark.parametrize("quantiser", [1, 8, 31])
def test_the_ends_of_the_range_are_coded(quantiser: int) -> None:
    frames = np.full((3, 68), np.nan)
    frames[:, 3] = 1860.0 * 2, -1860.0 * 2, 0.0
    stream = FapStream(frames)
    decoded = decode_fba(encode_fba(stream, quantiser=quantiser), strict=True).stream
    assert_within_quantiser(decoded, stream, quantiser)


def test_what_cannot_be_coded_is_refused_with_the_remedy() -> None:
    frames = np.zeros((3, 68))
    frames[2, 2] = 1861.0 * 4 + 4
    with pytest.raises(ParameterError, match=r"open_jaw .* frame 2 \(no quantiser"):
        encode_fba(FapStream(frames))
    frames[2, 2] = 1861.0
    with pytest.raises(ParameterError, match="choose quantiser 1"):
        encode_fba(FapStream(frames), quantiser=0)
    with pytest.raises(ParameterError, match="quantiser"):
        encode_fba(FapStream(frames), quantiser=32)
    with pytest.raises(ParameterError, match="refresh"):
        encode_fba(FapStream(frames), refresh=0.0)
    with pytest.raises(ParameterError, match="at least one frame"):
        encode_fba(FapStream(np.empty((0, 68))))


def test_files(tmp_path: Path) -> None:
    stream = FapStream(np.zeros((2, 68)), fps=10.0)
    write_fba(tmp_path / "face.fba", stream)
    read = read_fba(tmp_path / "face.fba", strict=True)
    np.testing.assert_array_equal(read.frames, stream.frames)
    assert (read.name, read.fps) == ("face", 10.0)
    with pytest.raises(FormatError, match="cannot be written"):
        write_fba(tmp_path / "none" / "face.fba", stream)
    with pytest.raises(FormatError, match="cannot be read"):
        read_fba(tmp_path / "gone.fba")


def test_progress_runs_to_the_end() -> None:
    stream = FapStream(np.zeros((45, 68)), fps=10.0)
    seen: list[Progress] = []
    data = encode_fba(stream, refresh=2.0, progress=seen.append)
    assert seen == [(20 / 45, "20 of 45 frames"), (40 / 45, "40 of 45 frames"), (1.0, "45 of 45 frames")]
    seen.clear()
    decode_fba(data, progress=seen.append)
    assert [step.text.endswith(f" of {len(data)} bytes") for step in seen] == [True] * 3
    assert [step.fraction for step in seen] == sorted({step.fraction for step in seen})
