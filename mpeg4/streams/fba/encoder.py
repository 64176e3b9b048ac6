"""A stream of FAPs becomes an FBA bitstream."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ....errors import ParameterError
from ....files import write_whole
from ....progress import Progress, Report
from ...standard import GROUPS
from ..fap_stream import FapStream
from .arithmetic import Model, SegmentWriter
from .bits import BitWriter
from .channels import LARGEST_QUANTISER, Limits, bounds_of, channels_of
from .plan import Picture, Run, limits_of, runs
from .syntax import (
    MARKER_EVERY,
    PLANE_START,
    SEQUENCE_END,
    SEQUENCE_START,
    Rate,
    first_frame_of,
    write_masks,
    write_skip,
    write_time,
)

#: Seconds from one start code to the next.
LEAST_REFRESH, MOST_REFRESH = 1e-3, 1e9
FACE_ONLY, INTRA_FACE = 0b001, 0b101  # is_intra and the two bits of the object mask


def encode_fba(
    stream: FapStream, *, quantiser: int = 1, refresh: float = 10.0, progress: Report | None = None
) -> bytes:
    """The FBA bitstream of a stream, predictive coding.

    An I frame with a start code begins the stream, follows after `refresh` seconds, and comes wherever the mask changes
    or a difference is too large for a P frame. Frames that state nothing are skipped, but for the first, the last,
    and one in ten thousand, beyond which a reader takes a skip for damage.

    Parameters
    ----------
    stream : what to code; values are rounded to whole FAP units. Name, version and first frame number are not coded.
    quantiser : 0 (lossless, values up to 1860) or 1..31 times each FAP's own step (`Fap.quant_step`).
    refresh : seconds from one start code to the next, 0.001 or more: so much is lost at most where bytes are damaged.
    progress : called after each start code's frames.

    Raises
    ------
    ParameterError : quantiser, refresh or rate out of range; a value that no limit allows, with frame and FAP.

    Examples
    --------
    >>> frames = np.full((5, 68), np.nan)
    >>> frames[:, 2] = [0, 40, 80, 120, 160]
    >>> data = api.encode_fba(api.FapStream(frames, fps=25.0))
    >>> api.decode_fba(data).stream.frames[:, 2].tolist()
    [0.0, 40.0, 80.0, 120.0, 160.0]
    """
    if not 0 <= quantiser <= LARGEST_QUANTISER:
        raise ParameterError("quantiser", f"must be a whole number in 0..{LARGEST_QUANTISER}", quantiser)
    if not LEAST_REFRESH <= refresh <= MOST_REFRESH:
        raise ParameterError("refresh", f"must be from {LEAST_REFRESH:g} to {MOST_REFRESH:g} seconds", refresh)
    if not len(stream.frames):
        raise ParameterError("stream", "must contain at least one frame", 0)
    rate = Rate.nearest(stream.fps)
    bits = BitWriter()
    bits.put(SEQUENCE_START, 32)
    last = -1
    for run in runs(stream, quantiser, refresh):
        _write_run(bits, run, rate, quantiser, last)
        last = run.pictures[-1].index
        if progress is not None:
            progress(Progress.counted(last + 1, len(stream.frames), "frames"))
    bits.start_code(SEQUENCE_END)
    return bits.data()


def write_fba(
    path: str | Path,
    stream: FapStream,
    *,
    quantiser: int = 1,
    refresh: float = 10.0,
    progress: Report | None = None,
) -> None:
    """Write a stream as an FBA file; as `encode_fba`, and FormatError where it cannot be written.

    Examples
    --------
    >>> api.write_fba("still.fba", api.FapStream(np.zeros((3, 68)), fps=25.0))
    >>> len(api.read_fba("still.fba").frames)
    3
    """
    write_whole(path, encode_fba(stream, quantiser=quantiser, refresh=refresh, progress=progress))


def _write_run(bits: BitWriter, run: Run, rate: Rate, quantiser: int, last: int) -> None:
    """One I frame and its P frames; `last` is the frame before them."""
    first = run.pictures[0]
    channels = channels_of(first.mask)
    limits = limits_of(run, channels, quantiser)
    for intra, pictures, rows in ((True, run.pictures[:1], run.levels[:1]), (False, run.pictures[1:], run.levels[1:])):
        bounds = [bounds_of(channel, limits, quantiser, intra=intra) for channel in channels]
        models = [Model(high - low + 1) for low, high in bounds]
        for picture, levels in zip(pictures, rows, strict=True):
            if intra:
                _write_intra_header(bits, picture, rate, quantiser, limits, picture.index - last - 1)
            else:
                bits.put(FACE_ONLY, 3)
                write_skip(bits, picture.index - last - 1)
            symbols = [level - low for level, (low, _) in zip(levels, bounds, strict=True)]
            _write_symbols(bits, picture, models, symbols, learn=not intra)
            last = picture.index


def _write_intra_header(
    bits: BitWriter, picture: Picture, rate: Rate, quantiser: int, limits: Limits, skipped: int
) -> None:
    """Everything of an I frame that comes before its symbols."""
    bits.start_code(PLANE_START)
    bits.put(INTRA_FACE, 3)
    bits.put(1)
    rate.write(bits)
    second = int(picture.index / rate.fps + 1e-6)
    timed = picture.index == first_frame_of(second, rate.fps)
    bits.put(int(timed))
    if timed:
        write_time(bits, second)
    write_skip(bits, skipped)
    bits.put(quantiser, 5)
    write_masks(bits, picture.mask)
    bits.put(0, 2)  # no suggested gender, predictive coding
    bits.put(0b1111, 4)  # all four kinds of limits follow
    for codes in (limits.intra_high, limits.intra_low, limits.inter_high, limits.inter_low):
        _write_limits(bits, picture, codes)


def _write_limits(bits: BitWriter, picture: Picture, codes: Sequence[int]) -> None:
    """One kind of limits of all FAPs that are sent, with markers between them."""
    for members in list(GROUPS.values())[1:]:
        for place, number in enumerate(members):
            if place % MARKER_EVERY == 0:
                bits.put(1)
            if picture.mask[number - 1]:
                bits.put(codes[number - 3], 5)


def _write_symbols(
    bits: BitWriter, picture: Picture, models: Sequence[Model], symbols: Sequence[int], *, learn: bool
) -> None:
    """The segments of a frame: FAP 1 and 2 where they are sent, each with its flags, and the low-level FAPs."""
    coded = list(zip(models, symbols, strict=True))
    for flags, count in ((picture.viseme_flags, 3), (picture.expression_flags, 4), (None, len(coded))):
        if flags == ():
            continue
        segment = SegmentWriter(bits)
        for model, symbol in coded[:count]:
            segment.put(model, symbol)
            if learn:
                model.learn(symbol)
        segment.flush()
        for flag in flags or ():
            bits.put(flag)
        del coded[:count]
