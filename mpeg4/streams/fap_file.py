"""Reading and writing ASCII .fap files (versions 2.0 to 2.2). The format is described in docs/formats.md.

The reader goes line by line rather than by tokens, because real files carry a 69th mask flag that throws token readers
out of step.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...arrays import Bools, Floats
from ...errors import FormatError, ParameterError
from ...files import read_bytes, write_whole
from ..high_level import ExpressionField, VisemeField
from ..standard import FAP_COUNT, FAP_LIMIT, FRAMES_LIMIT
from .fap_stream import FapStream

VERSIONS = ("2.0", "2.1", "2.2")
VISEME_FIELDS, EXPRESSION_FIELDS = 4, 6
LONGEST_GAP = 10_000  # frames in a row that state nothing; beyond it a frame number is damaged
LARGEST_NUMBER = 2**31 - 1  # of a frame


@dataclass(eq=False)
class _Frame:
    """One frame as it stands in the file."""

    number: int
    values: Floats  # (68,), NaN where not stated
    viseme: VisemeField | None = None
    expression: ExpressionField | None = None


def read_fap(path: str | Path) -> FapStream:
    """A .fap file.

    Survives what real files do: 69 mask flags, blanks in the name, tabs, CRLF, comments, empty lines, frame numbers
    from 0 or 1 and with gaps (a missing frame states nothing), a wrong frame count in the header, "inf" (not stated),
    FAP 1 packed in one number, and decimals. Values outside the coding limits or below 0 are kept as they are.

    Parameters
    ----------
    path : the file.

    Returns
    -------
    The stream; frame 0 is the first frame the file states.

    Raises
    ------
    FormatError
        Names the file, the line, what is wrong and the remedy.

    Examples
    --------
    >>> api.write_fap("still.fap", api.FapStream(np.zeros((3, 68)), fps=25.0))
    >>> stream = api.read_fap("still.fap")
    >>> stream.fps, len(stream.frames)
    (25.0, 3)
    """
    file = Path(path)
    lines = _lines(file)
    try:
        line, header = next(lines)
    except StopIteration:
        raise FormatError(file, "is empty: a .fap file begins with 'version name fps frames'") from None
    version, name, fps = _header(file, line, header)
    frames: dict[int, _Frame] = {}
    first, last = 0, -1
    for line, text in lines:
        mask = _mask(file, line, text)
        try:
            line, text = next(lines)
        except StopIteration:
            raise FormatError(file, "the mask has no values after it: the file is cut off", line=line) from None
        frame = _frame(file, line, text, mask)
        if last >= 0:
            _check_order(file, line, frame.number, first=first, last=last)
        else:
            first = frame.number
        last = frame.number
        frames[last] = frame
    if not frames:
        raise FormatError(file, "contains no frame after its header", line=line)
    return _stream(frames, fps=fps, name=name, version=version)


def looks_like_fap(text: str) -> bool:
    """Whether a text begins as a .fap file does: with a header, and a mask of flags below it."""
    lines = [line.split() for line in text.splitlines() if line.strip() and not line.lstrip().startswith("#")][:2]
    if len(lines) < 2 or len(lines[0]) < 3 or lines[0][0] not in VERSIONS:
        return False
    return len(lines[1]) >= FAP_COUNT and set(lines[1]) <= {"0", "1"}


def write_fap(path: str | Path, stream: FapStream, *, decimals: int = 0) -> None:
    """Write a stream as a .fap file, whole or not at all.

    Parameters
    ----------
    path : the file, replaced if it exists.
    stream : what to write; its version and first frame number are kept.
    decimals : digits after the point; the format means whole numbers, and some readers want them.

    Raises
    ------
    FormatError
        When the file cannot be written.
    ParameterError
        When the decimals are negative, the stream has no frame, or a value is too large for the reader.

    Examples
    --------
    >>> stream = api.FapStream(np.zeros((3, 68)), fps=25.0, name="still")
    >>> api.write_fap("still.fap", stream)
    >>> api.read_fap("still.fap").name
    'still'
    """
    if not 0 <= decimals <= 17:
        raise ParameterError("decimals", "must be in 0..17", decimals)
    if not len(stream.frames):
        raise ParameterError("stream", "must contain at least one frame", 0)
    write_whole(path, "".join(_text(stream, decimals)))


def _lines(file: Path) -> Iterator[tuple[int, str]]:
    """Lines that say something, with their numbers. Old files name Windows paths in whatever code page."""
    data = read_bytes(file)
    if b"\0" in data:
        raise FormatError(file, "is binary, but a .fap file is text: is it an .fba stream?", offset=data.index(b"\0"))
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = data.decode("latin-1")
    for number, line in enumerate(text.replace("\r\n", "\n").replace("\r", "\n").split("\n"), start=1):
        if line.strip() and not line.lstrip().startswith("#"):
            yield number, line.strip()


def _header(file: Path, line: int, text: str) -> tuple[str, str, float]:
    """Version, name (which may hold blanks) and frame rate; the frame count is not to be trusted."""
    tokens = text.split()
    if len(tokens) < 3 or tokens[0] not in VERSIONS:
        hint = " (3.x is a body animation file)" if tokens[0].startswith("3.") else ""
        wanted = f"the header must be 'version name fps frames' with version {', '.join(VERSIONS)}{hint}"
        raise FormatError(file, f"{wanted}, but it is {text[:80]!r}", line=line)
    fps = _number(tokens[-2])
    if fps is None or not (math.isfinite(fps) and fps > 0.0):
        raise FormatError(file, f"the frame rate must be a positive number, but it is {tokens[-2]!r}", line=line)
    count = _number(tokens[-1])
    if count is None:
        raise FormatError(file, f"the frame count must be a number, but it is {tokens[-1]!r}", line=line)
    return tokens[0], "".join(c for c in " ".join(tokens[1:-2]) if c.isprintable()), fps


def _check_order(file: Path, line: int, number: int, *, first: int, last: int) -> None:
    """Refuse a frame number that does not follow the last one."""
    if number <= last:
        raise FormatError(file, f"frame {number} comes after frame {last}: frame numbers must increase", line=line)
    if number - last > LONGEST_GAP:
        problem = f"frame number {number} is more than {LONGEST_GAP} frames after {last}: correct the number"
        raise FormatError(file, problem, line=line)
    if number - first >= FRAMES_LIMIT:
        problem = f"frame number {number} gives more than {FRAMES_LIMIT} frames: shorten the file"
        raise FormatError(file, problem, line=line)


def _mask(file: Path, line: int, text: str) -> Bools:
    """(68,) flags; a 69th that is 0 is let pass."""
    flags = text.split()
    for place, flag in enumerate(flags, start=1):
        if flag not in ("0", "1"):
            raise FormatError(file, f"mask flag {place} must be 0 or 1, but it is {flag!r}", line=line)
    if len(flags) < FAP_COUNT or "1" in flags[FAP_COUNT:]:
        problem = f"a mask has {FAP_COUNT} flags (more only if they are 0), but this line has {len(flags)}"
        raise FormatError(file, problem, line=line)
    return np.array([flag == "1" for flag in flags[:FAP_COUNT]])


def _frame(file: Path, line: int, text: str, mask: Bools) -> _Frame:
    """A value line under its mask."""
    tokens = text.split()
    numbers = [_number(token) for token in tokens]
    for place, (token, number) in enumerate(zip(tokens, numbers, strict=True), start=1):
        if number is None or math.isnan(number):
            raise FormatError(file, f"value {place} must be a number, but it is {token!r}", line=line)
    values = [number for number in numbers if number is not None]
    if not values[0].is_integer() or not 0 <= values[0] <= LARGEST_NUMBER:
        rule = f"the frame number must be 0, 1, 2, ... up to {LARGEST_NUMBER}"
        raise FormatError(file, f"{rule}, but it is {tokens[0]!r}", line=line)
    viseme, expression = _high_level_counts(mask, tokens)
    stated = int(mask[2:].sum())
    wanted = 1 + viseme + expression + stated
    if len(values) != wanted:
        problem = f"the mask above requires {wanted} numbers (the frame's and {wanted - 1} values), but this line has"
        raise FormatError(file, f"{problem} {len(values)}", line=line)
    frame = _Frame(int(values[0]), np.full(FAP_COUNT, np.nan))
    try:
        if viseme:
            fields = [_whole(value) for value in values[1 : 1 + viseme]]
            frame.viseme = VisemeField(*(fields if viseme == VISEME_FIELDS else _unpacked(fields[0])))
        if expression:
            frame.expression = ExpressionField(*map(_whole, values[1 + viseme : 1 + viseme + expression]))
    except ParameterError as error:
        raise FormatError(file, str(error), line=line) from error
    low_level = np.array(values[wanted - stated :], dtype=np.float64)
    endless = np.isinf(low_level)
    huge = ~endless & (np.abs(low_level) > FAP_LIMIT)
    if huge.any():
        place = wanted - stated + int(huge.argmax())
        problem = f"value {place + 1} must be within {FAP_LIMIT:.0f} FAP units, but it is {tokens[place]!r}"
        raise FormatError(file, problem, line=line)
    frame.values[2:][mask[2:]] = np.where(endless, np.nan, low_level)
    return frame


def _high_level_counts(mask: Bools, tokens: Sequence[str]) -> tuple[int, int]:
    """How many numbers FAP 1 and FAP 2 have on a value line; FAP 1 may be packed in one."""
    expression = EXPRESSION_FIELDS if mask[1] else 0
    if not mask[0]:
        return 0, expression
    packed = len(tokens) == 2 + expression + int(mask[2:].sum()) and len(tokens[1]) > 2
    return 1 if packed else VISEME_FIELDS, expression


def _whole(value: float) -> int:
    """A sub-field's value; ParameterError where it is not whole."""
    if not value.is_integer():
        raise ParameterError("a sub-field of FAP 1 or 2", "must be a whole number", value)
    return int(value)


def _unpacked(number: int) -> list[int]:
    """FAP 1 in one number: (select1 * 10000 + 100000) + (select2 * 100 + 1000) + (blend + 10)."""
    rest = number - 101010
    return [rest // 10000, rest % 10000 // 100, rest % 100, 0]


def _number(token: str) -> float | None:
    """A decimal number, or None; float() alone would take '1_000' and make 1e400 infinite."""
    try:
        number = float(token)
    except ValueError:
        return None
    overflowed = math.isinf(number) and token.lstrip("+-")[:3].lower() != "inf"
    return None if "_" in token or overflowed else number


def _stream(frames: Mapping[int, _Frame], *, fps: float, name: str, version: str) -> FapStream:
    """The frames side by side; frames the file skips state nothing."""
    first, last = min(frames), max(frames)
    values = np.full((last - first + 1, FAP_COUNT), np.nan)
    for number, frame in frames.items():
        values[number - first] = frame.values
    return FapStream(
        frames=values,
        fps=fps,
        name=name,
        visemes={n - first: frame.viseme for n, frame in frames.items() if frame.viseme is not None},
        expressions={n - first: frame.expression for n, frame in frames.items() if frame.expression is not None},
        first_frame=first,
        version=version,
    )


def _text(stream: FapStream, decimals: int) -> Iterator[str]:
    """The lines of the file."""
    yield f"{stream.version} {stream.name} {_rate(stream.fps)} {len(stream.frames)}\n"
    for index, (values, mask) in enumerate(zip(stream.frames, stream.mask, strict=True)):
        yield " ".join("1" if flag else "0" for flag in mask) + "\n"
        fields: list[str] = [str(index + stream.first_frame)]
        if index in stream.visemes:
            fields += map(str, stream.visemes[index].values)
        if index in stream.expressions:
            fields += map(str, stream.expressions[index].values)
        fields += (_rounded(value, decimals) for value in values[2:][mask[2:]])
        yield " ".join(fields) + "\n"


def _rate(fps: float) -> str:
    """The shortest number that is read back as the same rate; most readers want whole ones whole."""
    return str(int(fps)) if float(fps).is_integer() else repr(float(fps))


def _rounded(value: float, decimals: int) -> str:
    """The number without needless zeros and without a minus before 0."""
    text = f"{value:.{decimals}f}"
    if "." in text:
        text = text.rstrip("0").rstrip(".")
    return "0" if text == "-0" else text
