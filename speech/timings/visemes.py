"""Streams of FAPs that say which viseme is shown when: FAP 1."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from ...errors import FormatError
from ...mpeg4 import FapStream, read_fap, read_fba
from ...mpeg4.high_level import FULL
from ...mpeg4.streams.fba.decoder import begins_as_fba
from .labels import Label, Timings, viseme_number


def viseme_timings(path: Path, data: bytes) -> Timings:
    """The visemes of a .fap or .fba file, each from the frame that states it to the next that states another.

    Raises
    ------
    FormatError : it cannot be read, or states no viseme.
    """
    stream = read_fba(path) if begins_as_fba(data) else read_fap(path)
    shown = list(_shown(stream))
    if not any(number for _, number in shown):
        raise FormatError(path, "states no viseme (FAP 1), so it does not say when sounds are: play it as a stream")
    ends = [frame for frame, _ in shown[1:]] + [len(stream.frames)]
    labels = [
        Label(frame / stream.fps, end / stream.fps, str(number), f"frame {frame}")
        for (frame, number), end in zip(shown, ends, strict=True)
        if number
    ]
    return Timings(path, labels, duration=len(stream.frames) / stream.fps, read=viseme_number)


def _shown(stream: FapStream) -> Iterator[tuple[int, int]]:
    """Frame and viseme wherever another one begins: of two that are blended, the one that shows more."""
    before = 0
    for frame in sorted(stream.visemes):
        field = stream.visemes[frame]
        number = field.select1 if 2 * field.blend >= FULL else field.select2
        if number != before:
            yield frame, number
        before = number
