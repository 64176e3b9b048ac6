"""Damaged and foreign FBA bitstreams: refused by name, or decoded from the next start code on."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from risorius.errors import FormatError
from risorius.mpeg4 import FapStream, VisemeField
from risorius.mpeg4.streams.fba import Decoded, decode_fba, encode_fba
from risorius.mpeg4.streams.fba.bits import BitWriter

PLANE_START, END = b"\0\0\1\xbb", b"\0\0\1\xb1"


@cache
def example() -> tuple[FapStream, bytes]:
    """Eight seconds at 10 frames per second, an I frame every two seconds."""
    frames = np.full((80, 68), np.nan)
    times = np.arange(80)
    for number in (3, 12, 13, 31, 32, 53):
        frames[:, number - 1] = np.rint(50.0 * np.sin(times / number)) * 4.0
    stream = FapStream(frames, fps=10.0, visemes={index: VisemeField(index % 15, 0, 50) for index in range(80)})
    return stream, encode_fba(stream, refresh=2.0)


def decoded_or_refused(data: bytes) -> Decoded | FormatError:
    """What the decoder makes of bytes; any other exception is a failure."""
    try:
        return decode_fba(data)
    except FormatError as error:
        return error


def planes(data: bytes) -> list[int]:
    """Offsets of the start codes of I frames."""
    return [place for place in range(len(data)) if data[place : place + 4] == PLANE_START]


def test_the_example_is_sound() -> None:
    stream, data = example()
    assert len(planes(data)) == 4
    np.testing.assert_array_equal(decode_fba(data, strict=True).stream.frames, stream.frames)


def test_damage_costs_frames_up_to_the_next_start_code_and_time_goes_on() -> None:
    stream, data = example()
    second = planes(data)[1] + 4
    broken = bytearray(data)
    broken[second : second + 3] = b"\0\0\0"
    decoded = decode_fba(bytes(broken))
    assert len(decoded.damage) == 1
    assert decoded.damage[0].offset is not None
    assert decoded.stream.frames.shape == (80, 68)
    assert not decoded.stream.mask[20:40].any()  # lost: nothing is stated
    for part in (slice(0, 20), slice(40, 80)):
        np.testing.assert_array_equal(decoded.stream.frames[part], stream.frames[part])
    with pytest.raises(FormatError, match="byte"):
        decode_fba(bytes(broken), strict=True)


@pytest.mark.parametrize("flip", [0xFF, 0x10, 0x01])
def test_damage_anywhere_in_a_run_leaves_the_other_runs_alone(flip: int) -> None:
    """Even where misread symbols run beyond the next start code: it is looked for from the last one on."""
    stream, data = example()
    _, second, third, _ = planes(data)
    for place in range(second + 4, third, 4):
        broken = bytearray(data)
        broken[place] ^= flip
        frames = decode_fba(bytes(broken)).stream.frames
        assert frames.shape == (80, 68), place
        np.testing.assert_array_equal(frames[:20], stream.frames[:20])
        np.testing.assert_array_equal(frames[40:], stream.frames[40:])


def test_time_codes_need_not_begin_at_zero() -> None:
    """A recording cut out of a longer one: it begins at 2 s; the run behind damage keeps its place."""
    stream, data = example()
    cut = bytearray(data[:5] + data[planes(data)[1] :])
    second = planes(bytes(cut))[1] + 4
    cut[second : second + 3] = b"\0\0\0"
    decoded = decode_fba(bytes(cut)).stream
    np.testing.assert_array_equal(decoded.frames[:20], stream.frames[20:40])
    assert not decoded.mask[20:40].any()
    np.testing.assert_array_equal(decoded.frames[40:], stream.frames[60:])


def test_a_stream_is_joined_in_the_middle() -> None:
    stream, data = example()
    decoded = decode_fba(data[planes(data)[2] - 1 :])
    assert "start code" in decoded.damage[0].problem
    np.testing.assert_array_equal(decoded.stream.frames[40:], stream.frames[40:])


@pytest.mark.parametrize("share", [0.3, 0.6, 0.9])
def test_what_comes_before_the_end_of_a_cut_stream_is_kept(share: float) -> None:
    stream, data = example()
    decoded = decode_fba(data[: int(share * len(data))])
    count = len(decoded.stream.frames)
    assert 0.5 * share * 80 < count < 80
    np.testing.assert_array_equal(decoded.stream.frames[: count - 1], stream.frames[: count - 1])
    assert "cut off" in decoded.damage[-1].problem


def _foreign(*fields: tuple[int, int]) -> bytes:
    """A stream of one frame with these (value, bits)."""
    bits = BitWriter()
    bits.put(0x1BA, 32)
    for value, count in fields:
        bits.put(value, count)
    bits.start_code(0x1B1)
    return bits.data()


HEADER = ((1, 1), (1, 2), (0, 1), (0, 1), (0, 1))  # I frame, face, no rate, no time, no skip
MASKS = ((4, 5), *[(0b100, 3)] * 10)  # quantiser 4; ten groups, none sent


@pytest.mark.parametrize(
    ("fields", "says"),
    [
        ((*HEADER, *MASKS, (0, 1), (1, 1)), "uses DCT coding"),
        (((1, 1), (2, 2)), "body animation"),
        (((1, 1), (3, 2)), "body animation"),
        (((1, 1), (0, 2)), "neither face nor body"),
        (((0, 1), (1, 2), (0, 1)), "P frame without an I frame"),
        ((*HEADER, (4, 5), (0, 1)), "marker bit"),
        (((1, 1), (1, 2), (1, 1), (0, 12)), "frame rate 0"),
        (((1, 1), (1, 2), (0, 1), (1, 1), (0, 18)), "time code without its marker"),
        (((1, 1), (1, 2), (0, 1), (0, 1), (1, 1), (2**2800 - 1, 2800)), "skips more than"),
        ((), "contains no frame"),
    ],
)
def test_foreign_streams_are_refused_by_name(fields: tuple[tuple[int, int], ...], says: str) -> None:
    with pytest.raises(FormatError, match=says) as caught:
        decode_fba(_foreign(*fields), path="some.fba")
    assert caught.value.offset is not None
    assert str(caught.value).startswith("some.fba, byte ")


def test_the_old_start_codes_and_the_default_limits() -> None:
    """Written by hand: an I frame that sends open_jaw in group 2 alone, without limits: 2161 levels of 4 units."""
    group_two = ((0b1, 1), (0b10, 2), (1 << 15, 16))
    masks = ((1, 5), (0b100, 3), *group_two, *[(0b100, 3)] * 8)
    # The arithmetic coder's interval ends with the lowest level (all ones) and begins with the highest.
    for level, value in (((0xFFF, 12), -1080 * 4), ((0b01, 2), 0), ((0x001, 12), 1080 * 4)):
        tail = (0xFFFF, 16) if value <= 0 else (0x5555, 16)
        data = _foreign(*HEADER, *masks, (0, 2), (0, 4), level, tail)
        stream = decode_fba(b"\0\0\1\1" + data[4:]).stream
        assert stream.mask.sum() == 1
        assert stream.frames[0, 2] == value


@settings(max_examples=150)
@given(st.data())
def test_any_damage_ends_in_frames_or_a_format_error(data: st.DataObject) -> None:
    sound = example()[1]
    damaged = bytearray(sound)
    for _ in range(data.draw(st.integers(1, 5))):
        place = data.draw(st.integers(0, len(sound) - 1))
        junk = data.draw(st.binary(min_size=1, max_size=6))
        damaged[place : place + len(junk)] = junk
    del damaged[data.draw(st.integers(1, len(damaged))) :]
    outcome = decoded_or_refused(bytes(damaged))
    if isinstance(outcome, Decoded):
        assert outcome.stream.frames.shape[1] == 68
        assert len(outcome.stream.frames) < 100_000
    else:
        assert outcome.offset is not None


@given(st.binary(max_size=200))
def test_any_bytes_end_in_frames_or_a_format_error(junk: bytes) -> None:
    for start in (b"", b"\0\0\1\xba", b"\0\0\1\xba\x7f\0\0\1\xbb"):
        outcome = decoded_or_refused(start + junk)
        assert isinstance(outcome, Decoded) or outcome.offset is not None
