"""An FBA bitstream becomes a stream of FAPs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ....arrays import Floats
from ....errors import FormatError, ParameterError
from ....files import read_bytes
from ....progress import Progress, Report
from ...high_level import FULL, ExpressionField, VisemeField
from ...standard import FAP_COUNT, FRAMES_LIMIT
from ..fap_file import LONGEST_GAP
from ..fap_stream import FapStream
from .bits import BitReader, EndOfBits
from .channels import DEFAULT_LIMITS
from .planes import Clock, Coding, Damage, read_clock, read_coding, read_levels, read_skip
from .syntax import OLD_SEQUENCE_START, PLANE_STARTS, SEQUENCE_END, SEQUENCE_START, first_frame_of

FACE, BODY = 1, 2  # of the object mask
DEFAULT_RATE = 25.0  # frames per second, where no I frame says


@dataclass(frozen=True)
class Decoded:
    """What a bitstream holds.

    Attributes
    ----------
    stream : the frames; those that are skipped or lost state nothing.
    damage : what was wrong, in order, each with its byte; empty for a sound bitstream.
    """

    stream: FapStream
    damage: tuple[FormatError, ...]


@dataclass(eq=False)
class _Reading:
    """What has been decoded so far."""

    bits: BitReader
    rate: float | None = None
    coding: Coding | None = None
    start: int = 0  # bit behind the last start code
    last: int = -1  # frame
    begun: int = -1  # frame of the last I frame
    offset: int | None = None  # frames from the stream's begin to that of its time codes
    lost: bool = False  # whether frames are missing before the next one
    frames: dict[int, Floats] = field(default_factory=dict)
    visemes: dict[int, VisemeField] = field(default_factory=dict)
    expressions: dict[int, ExpressionField] = field(default_factory=dict)
    ends: dict[int, int] = field(default_factory=dict)  # bit behind each frame


def read_fba(path: str | Path, *, strict: bool = False) -> FapStream:
    """The stream of an FBA file, named after the file; keyword and errors as `decode_fba`.

    Examples
    --------
    >>> api.write_fba("still.fba", api.FapStream(np.zeros((3, 68)), fps=25.0))
    >>> api.read_fba("still.fba").name
    'still'
    """
    file = Path(path)
    return decode_fba(read_bytes(file), path=file, strict=strict).stream


def begins_as_fba(data: bytes) -> bool:
    """Whether bytes begin with an FBA start code."""
    return int.from_bytes(data[:4]) in (SEQUENCE_START, OLD_SEQUENCE_START)


def decode_fba(
    data: bytes,
    *,
    path: str | Path = "FBA stream",
    strict: bool = False,
    progress: Report | None = None,
) -> Decoded:
    """Decode an FBA bitstream, predictive coding.

    Damage costs the frames up to the next start code. Where that I frame has a time code, the frames after it keep
    their time; else they close up.

    Parameters
    ----------
    data : the bytes.
    path : what errors name; its stem is the stream's name.
    strict : refuse any damage.
    progress : called at each start code.

    Raises
    ------
    FormatError : no frame can be decoded (DCT coding and body animation are refused by name), or anything is damaged
        and `strict`; with the byte.

    Examples
    --------
    >>> data = api.encode_fba(api.FapStream(np.zeros((3, 68)), fps=25.0))
    >>> decoded = api.decode_fba(data)
    >>> len(decoded.stream.frames), decoded.damage
    (3, ())
    """
    reading = _Reading(BitReader(data))
    damage: list[FormatError] = []
    for problem in _decoded(reading, progress):
        error = FormatError(path, problem, offset=min(reading.bits.byte, len(data)))
        if strict:
            raise error
        damage.append(error)
    if not reading.frames:
        raise damage[0] if damage else FormatError(path, "contains no frame", offset=len(data))
    return Decoded(_stream(reading, Path(path).stem), tuple(damage))


def _decoded(reading: _Reading, progress: Report | None) -> Iterator[str]:
    """Decode all frames; yields what is wrong, and goes on at the next start code."""
    bits = reading.bits
    if begins_as_fba(bits.data):
        bits.position = reading.start = 32
    else:
        yield "does not begin with an FBA start code (00 00 01 BA): is it an MPEG-4 face stream?"
        if not _go_on(reading):
            return
    while True:
        try:
            code = bits.take_start_code(PLANE_STARTS | {SEQUENCE_END})
            if code == SEQUENCE_END:
                return
            if code is not None:
                reading.start = bits.position
                if progress is not None:
                    progress(Progress.counted(bits.byte, len(bits.data), "bytes"))
            _read_plane(reading)
        except EndOfBits:
            yield "ends before its end code: the stream is cut off or damaged"
        except (Damage, ParameterError) as error:
            yield str(error)
        else:
            continue
        if not _go_on(reading):
            return


def _go_on(reading: _Reading) -> bool:
    """Go to the next start code after damage, and forget what was read beyond it; False where there is none."""
    bits = reading.bits
    bits.position = reading.start
    found = bits.seek_start_code(PLANE_STARTS)
    _forget(reading, [index for index, end in reading.ends.items() if end > bits.position])
    reading.coding, reading.lost = None, True
    bits.position += 32
    reading.start = bits.position
    return found


def _forget(reading: _Reading, indices: list[int]) -> None:
    """Drop frames that were misread."""
    for index in indices:
        for kept in (reading.frames, reading.visemes, reading.expressions, reading.ends):
            kept.pop(index, None)
    reading.last = max(reading.frames, default=-1)


def _timed(reading: _Reading, index: int, seconds: int) -> int:
    """The frame of a time code: where frames go on after damage. What was misread beyond it is dropped.

    Time codes tell whole seconds: the first frame at or after them is meant. They need not begin at 0.
    """
    at = first_frame_of(seconds, reading.rate or DEFAULT_RATE)
    if not reading.lost:
        reading.offset = at - index if reading.offset is None else reading.offset
        return index
    at -= reading.offset or 0
    if not reading.begun < at <= index + LONGEST_GAP:
        return index
    _forget(reading, [misread for misread in reading.frames if misread >= at])
    return at


def _read_plane(reading: _Reading) -> None:
    """One frame."""
    bits = reading.bits
    intra, objects = bool(bits.get()), bits.get(2)
    if objects & BODY:
        raise Damage("contains body animation (BAP), which is not supported: use a stream of the face alone")
    if not objects & FACE:
        raise Damage("has a frame that is neither face nor body: the stream is damaged")
    clock = read_clock(bits) if intra else Clock(None, None)
    reading.rate = reading.rate or clock.rate
    index = reading.last + read_skip(bits) + 1
    if intra:
        reading.coding = read_coding(bits, reading.coding.limits if reading.coding else DEFAULT_LIMITS)
    if reading.coding is None:
        raise Damage("has a P frame without an I frame before it")
    if clock.seconds is not None:
        index = _timed(reading, index, clock.seconds)
    if index >= FRAMES_LIMIT:
        raise Damage(f"gives more than {FRAMES_LIMIT} frames: shorten the stream")
    flags = read_levels(bits, reading.coding, intra=intra)
    _keep(reading, reading.coding, index, flags)
    reading.last, reading.lost = index, False
    reading.begun = index if intra else reading.begun


def _keep(reading: _Reading, coding: Coding, index: int, flags: tuple[tuple[int, ...], ...]) -> None:
    """Add a frame to what has been decoded; ParameterError where FAP 1 or 2 has no such value."""
    frame = np.full(FAP_COUNT, np.nan)
    fields: dict[int, list[int]] = {1: [], 2: []}
    for channel, value in zip(coding.channels, coding.reached, strict=True):
        if channel.top is None:
            frame[channel.fap - 1] = value
        else:
            quantised = channel.step is not None  # and may have been rounded up beyond its top
            fields[channel.fap].append(min(value, FULL) if quantised else value)
    if fields[1]:
        reading.visemes[index] = VisemeField(*fields[1], *flags[0])
    if fields[2]:
        reading.expressions[index] = ExpressionField(*fields[2], *flags[1])
    reading.frames[index] = frame
    reading.ends[index] = reading.bits.position


def _stream(reading: _Reading, name: str) -> FapStream:
    """The decoded frames side by side, frame 0 first."""
    frames = np.full((reading.last + 1, FAP_COUNT), np.nan)
    for index, frame in reading.frames.items():
        frames[index] = frame
    printable = "".join(character for character in name if character.isprintable())
    return FapStream(
        frames=frames,
        fps=reading.rate or DEFAULT_RATE,
        name=printable,
        visemes=reading.visemes,
        expressions=reading.expressions,
    )
