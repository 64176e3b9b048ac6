"""Files of FAPs over time, and of what trackers saw, read and written: one way for every format.

`read_stream` and `write_stream` are for whoever wants the stream; `read_recording` also tells what the file is, what it
does not say and had to be assumed, and what of it is damaged.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ...arrays import Floats
from ...errors import FormatError, ParameterError
from ...files import read_bytes
from ...mpeg4 import FapStream, bridged, decode_fba, read_fap, write_fap, write_fap_json, write_fba
from ...mpeg4.streams.capture import Samples, write_fap_csv
from ...mpeg4.streams.capture.times import checked_rate
from ...mpeg4.streams.fap_json import stream_of_document
from ...progress import Report
from .flipping import checked_flips, flipped
from .formats import WRITABLE, StreamFormat
from .neutral import Neutral, counted_from
from .opening import Opened, open_stream
from .steady import steadied
from .trackers import ASPECT, Told


@dataclass(frozen=True)
class Recording:
    """A file as it was read.

    Attributes
    ----------
    stream : its FAPs at an even rate; what is not known in it is masked.
    format : what the file was taken for.
    assumed : what it does not say and was assumed, in words for people.
    damage : what of an .fba file could not be decoded; the frames it cost are masked.
    """

    stream: FapStream
    format: StreamFormat
    assumed: tuple[str, ...] = ()
    damage: tuple[FormatError, ...] = ()

    def played(self, under: Floats | None = None) -> tuple[Floats, tuple[str, ...]]:
        """What a face plays of it, and what of that was unknown, in words for people.

        Visemes and expressions are low-level FAPs; where the recording is unknown for a while, it is bridged.

        Parameters
        ----------
        under : (T, 68) FAPs that show where it knows nothing, NaN where that is rest; None: rest.

        Returns
        -------
        (T, 68) FAP units, NaN where silent; lines.

        Examples
        --------
        >>> _ = open("take.csv", "w").write("timestamp, AU45_r\\n0.00, 2\\n0.04, \\n0.08, 4\\n")
        >>> frames, said = api.read_recording("take.csv").played()
        >>> frames[:, 19 - 1].round().tolist(), said
        ([375.0, 562.0, 750.0], ('1 unknown frame (1): bridged from those around',))
        """
        whole = self.format not in (StreamFormat.FAP, StreamFormat.FBA, StreamFormat.JSON, StreamFormat.FAPS)
        found = bridged(self.stream.expanded(), self.stream.fps, whole=whole, under=under)
        return found.frames, found.said


def read_recording(
    path: str | Path,
    format: str | StreamFormat | None = None,
    *,
    fps: float | None = None,
    rate: float | None = None,
    start: float | str | None = None,
    face: int | None = None,
    flip: Sequence[str] = (),
    aspect: float = ASPECT,
    neutral: Neutral | None = None,
    steady: bool = False,
    strict: bool = False,
    progress: Report | None = None,
) -> Recording:
    """A file of any format, with what was assumed to read it.

    Parameters
    ----------
    path : .fap or .fba; FAPs as JSON or CSV; OpenFace CSV; ARKit, Live Link Face or MediaPipe blend shapes (CSV, JSON);
        MediaPipe landmarks (CSV, JSON).
    format : which of these; None: what the file contains tells, then its ending.
    fps : frames per second of the stream; None: those of the file. At another rate, visemes and expressions are FAPs.
    rate : frames per second of a tracker's file; None: as its times, timecodes or frame numbers show, else 30.
    start : where the stream begins, in seconds of the recording's own times or as one of its timecodes; None: with its
        first row.
    face : which face of a recording of several: its number in the column of faces, else its place in a frame.
    flip : turns of a tracker's file that are the other way round: "yaw", "pitch", "roll" of the head, "eye_yaw",
        "eye_pitch".
    aspect : landmarks only: the picture's width over its height.
    neutral : of a tracker's file, counted from its first row: seconds from and to which the face is neutral, or the
        number of one frame at the file's own rate. What shows there is taken off every frame; landmarks are measured
        from it. None: the tracker's zero; of landmarks, the face's usual shape.
    steady : take out the trembling of a tracker; blinks and closing lips keep their time and their edge.
    strict : .fba only: refuse any damage.
    progress : .fba only: called as it is decoded.

    Raises
    ------
    FormatError : names the file, line and column, frame or byte, and the remedy.
    ParameterError : an option outside its rule.

    Examples
    --------
    >>> _ = open("take.csv", "w").write("timestamp, AU45_r\\n0.00, 0\\n0.04, 2.5\\n0.08, 5\\n")
    >>> recording = api.read_recording("take.csv")
    >>> print(recording.format, recording.stream.fps)
    openface 25.0
    """
    checked_rate(rate)
    told = Told(rate, start, face, aspect, neutral)
    recording = _read(Path(path), format, fps, told, checked_flips(flip), strict, progress)
    if not steady:
        return recording
    stream = recording.stream
    return replace(recording, stream=replace(stream, frames=steadied(stream.frames, stream.fps)))


def _read(
    path: Path,
    format: str | StreamFormat | None,
    fps: float | None,
    told: Told,
    flips: tuple[str, ...],
    strict: bool,
    progress: Report | None,
) -> Recording:
    """See `read_recording`."""
    opened = open_stream(path, None if format is None else StreamFormat.of(format))
    if opened.samples is None:
        options = {name: getattr(told, name) for name in ("rate", "start", "face", "neutral")}
        _refuse_options({**options, "flip": flips or None})
    if opened.format is StreamFormat.FBA:
        decoded = decode_fba(read_bytes(path), path=path, strict=strict, progress=progress)
        return Recording(_at(decoded.stream, fps), StreamFormat.FBA, damage=decoded.damage)
    if opened.format is StreamFormat.FAP:
        return Recording(_at(read_fap(path), fps), StreamFormat.FAP)
    if opened.samples is None:
        return Recording(_at(stream_of_document(path, opened.document), fps), StreamFormat.JSON)
    samples = opened.samples(told)
    if told.neutral is not None and opened.format is not StreamFormat.LANDMARKS:
        samples = counted_from(samples, told.neutral)
    frames, per_second = samples.evenly(fps)
    frames = flipped(frames, flips)
    try:
        stream = FapStream(frames=frames, fps=per_second, name=_name(opened), assumed=samples.assumed)
    except ParameterError as error:
        raise FormatError(path, f"has values that no face shows: {error}") from error
    return Recording(stream, opened.format, samples.assumed)


def read_stream(
    path: str | Path,
    format: str | StreamFormat | None = None,
    *,
    fps: float | None = None,
    rate: float | None = None,
    start: float | str | None = None,
    face: int | None = None,
    flip: Sequence[str] = (),
    aspect: float = ASPECT,
    neutral: Neutral | None = None,
    steady: bool = False,
) -> FapStream:
    """The stream of a file of any format; parameters and errors as `read_recording`.

    Examples
    --------
    >>> _ = open("take.csv", "w").write("timestamp, AU45_r\\n0.00, 0\\n0.04, 2.5\\n0.08, 5\\n")  # OpenFace
    >>> api.read_stream("take.csv").frames[:, 19 - 1].round().tolist()  # close_t_l_eyelid
    [0.0, 468.0, 937.0]
    """
    return read_recording(
        path,
        format,
        fps=fps,
        rate=rate,
        start=start,
        face=face,
        flip=flip,
        aspect=aspect,
        neutral=neutral,
        steady=steady,
    ).stream


def read_capture(
    path: str | Path,
    *,
    kind: str | StreamFormat | None = None,
    fps: float | None = None,
    rate: float | None = None,
    start: float | str | None = None,
    face: int | None = None,
    flip: Sequence[str] = (),
    aspect: float = ASPECT,
    neutral: Neutral | None = None,
) -> FapStream:
    """The stream of a tracker's file: the older name of `read_stream`, whose `format` is called `kind` here.

    Examples
    --------
    >>> api.write_fap_csv("still.csv", api.FapStream(np.zeros((3, 68)), fps=25.0))
    >>> len(api.read_capture("still.csv").frames)
    3
    """
    return read_stream(
        path, kind, fps=fps, rate=rate, start=start, face=face, flip=flip, aspect=aspect, neutral=neutral
    )


def write_stream(
    path: str | Path,
    stream: FapStream,
    format: str | StreamFormat | None = None,
    *,
    decimals: int = 0,
    quantiser: int = 1,
    refresh: float = 10.0,
    progress: Report | None = None,
) -> None:
    """Write a stream, whole or not at all.

    Parameters
    ----------
    format : "fap", "fba", "json" or "faps" (CSV); None: as the file's ending says.
    decimals : .fap only: of the values.
    quantiser, refresh, progress : .fba only; see `encode_fba`.

    Raises
    ------
    FormatError : an ending or format that is not written; the file cannot be written.
    ParameterError : an option, or a value of the stream, outside its rule.

    Examples
    --------
    >>> stream = api.FapStream(np.zeros((3, 68)), fps=25.0)
    >>> for name in ("a.fap", "a.fba", "a.json", "a.csv"):
    ...     api.write_stream(name, stream)
    >>> {api.read_stream(name).fps for name in ("a.fap", "a.fba", "a.json", "a.csv")}
    {25.0}
    """
    chosen = _ENDINGS.get(Path(path).suffix.lower()) if format is None else StreamFormat.of(format)
    if chosen is StreamFormat.FAP:
        write_fap(path, stream, decimals=decimals)
    elif chosen is StreamFormat.FBA:
        write_fba(path, stream, quantiser=quantiser, refresh=refresh, progress=progress)
    elif chosen is StreamFormat.JSON:
        write_fap_json(path, stream)
    elif chosen is StreamFormat.FAPS:
        write_fap_csv(path, stream)
    else:
        raise FormatError(path, f"is not a writable FAP stream: use {', '.join(WRITABLE)}")


_ENDINGS = {
    ".fap": StreamFormat.FAP,
    ".fba": StreamFormat.FBA,
    ".json": StreamFormat.JSON,
    ".csv": StreamFormat.FAPS,
}


def _refuse_options(options: Mapping[str, object]) -> None:
    """Refuse what only the recordings of trackers leave open."""
    for name, value in options.items():
        if value is not None:
            raise ParameterError(name, "must be left out: the file is a FAP stream, which states it", value)


def _at(stream: FapStream, fps: float | None) -> FapStream:
    """The stream at another rate."""
    if fps is None or fps == stream.fps or not len(stream.frames):
        return stream
    times = np.arange(len(stream.frames)) / stream.fps
    frames, per_second = Samples(times, stream.expanded()).evenly(fps)
    return FapStream(frames=frames, fps=per_second, name=stream.name)


def _name(opened: Opened) -> str:
    """What the stream of a tracker's file is called: the file's name, in one printable line."""
    return "".join(letter for letter in opened.path.stem if letter.isprintable()) or "capture"
