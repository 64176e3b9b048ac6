"""Recordings as lines of text: Face Cap's files, logs of what iFacialMocap and VMC senders send. They become tables.

Face Cap (.txt): lines ``info,...``, ``bs,NAME,...`` and for each frame ``k,MILLISECONDS``, the head's place (3) and
turn (3), the left and the right eye's turn (2 each), then a score for each name. Source: public importers, one of them
by the app's author (hizzlehoff/FaceCapImporters).

iFacialMocap: a line for each frame, ``NAME-SCORE|...|=head#X,Y,Z,...|rightEye#...|leftEye#...``, scores from 0 to 100;
version 2 writes ``NAME&SCORE``. Over TCP a frame ends with ``___iFacialMocap``. Loggers put a time before it. Source:
the developer's page (ifacialmocap.com/for-developer).

Both apps write degrees about ARKit's axes of a face; here they become columns in rad, ``headEulerX`` and so on, whose
signs stand in presets/capture/live_link.toml.

VMC: a line for each message, ``/VMC/Ext/Blend/Val NAME SCORE``, ``/VMC/Ext/T SECONDS``; ``/VMC/Ext/Blend/Apply`` ends a
frame. Source: the protocol's specification (protocol.vmc.info). Loggers put a time before and types between.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from ....errors import FormatError
from ....tables import parsed_number
from .delimited import read_text
from .table_file import TableFile

FACE_CAP_TURNS = (
    "headPositionX", "headPositionY", "headPositionZ", "headEulerX", "headEulerY", "headEulerZ",
    "leftEyeEulerX", "leftEyeEulerY", "rightEyeEulerX", "rightEyeEulerY",
)  # fmt: skip

#: Names of turns and places among those of scores.
TURN_OR_PLACE = re.compile(r"(Euler|Position)[XYZ]$")

#: A frame of iFacialMocap: what a logger wrote before it, then the first name with its score.
IFACIALMOCAP = re.compile(r"^(?P<before>.*?)(?P<frame>[A-Za-z_]+[-&]-?[\d.]+\|.*)$")
PART = re.compile(r"([A-Za-z_]+)[-&](-?[\d.]+(?:[eE][-+]?\d+)?)")
FRAME_END = "___iFacialMocap"
#: What loggers put beside the time before a line.
BESIDE_TIME = " \t,;|[]()"
VMC = re.compile(r"^(?P<before>.*?)(?P<address>/VMC/Ext/(?:Blend/Val|Blend/Apply|T|OK))\b(?P<rest>.*)$")

#: What a message says: a name, its quotes and types apart, and a score at the end.
SAID = re.compile(
    r"[\s(\[]*(?:,?[sfiTFd]+[\s,]+)?[\s(\['\"]*(?P<name>.*?)['\"]?[\s,]*(?P<score>[-+]?[\d.]+(?:[eE][-+]?\d+)?)[\s)\]]*"
)


def begins_as_json(head: str) -> bool:
    """Whether a file begins as JSON, and not as a line of a log with a time in brackets before it."""
    first = next((line for line in head.splitlines() if line.strip()), "").strip()
    if not first.startswith(("{", "[")):
        return False
    return not is_text_log(head) or first[0] == "{" or re.match(r"\[\s*[\[{\"]", first) is not None


def is_text_log(head: str) -> bool:
    """Whether a file that begins so is one of these."""
    lines = [line.strip() for line in head.splitlines() if line.strip()]
    return bool(lines) and (_is_face_cap(lines) or _is_vmc(lines) or _is_ifacialmocap(lines))


def read_text_log(path: str | Path) -> TableFile:
    """The frames as a table: a column of times, if there are any, and one for each name.

    Raises
    ------
    FormatError : a line that is none; names it.
    """
    file = Path(path)
    lines = [
        (number, line.strip()) for number, line in enumerate(read_text(file).splitlines(), start=1) if line.strip()
    ]
    texts = [line for _, line in lines]
    if _is_face_cap(texts):
        return _face_cap(file, lines)
    return _vmc(file, lines) if _is_vmc(texts) else _ifacialmocap(file, lines)


def _is_face_cap(lines: Sequence[str]) -> bool:
    """Whether lines are Face Cap's."""
    return lines[0].startswith(("info,", "bs,")) and any(line.startswith("bs,") for line in lines[:20])


def _is_vmc(lines: Sequence[str]) -> bool:
    """Whether lines are messages of VMC."""
    return any("/VMC/Ext/" in line for line in lines[:20])


def _is_ifacialmocap(lines: Sequence[str]) -> bool:
    """Whether lines are frames of iFacialMocap."""
    return any(line.count("|") > 3 and len(PART.findall(line)) > 3 for line in lines[:5])


def _face_cap(file: Path, lines: Sequence[tuple[int, str]]) -> TableFile:
    """Face Cap's frames."""
    names: list[str] = []
    rows: list[tuple[str, ...]] = []
    numbers: list[int] = []
    for number, line in lines:
        mark, *cells = [cell.strip() for cell in line.split(",")]
        if mark == "bs":
            if rows:
                raise FormatError(file, "names the shapes after frames: the line bs,... must come first", line=number)
            names = [cell for cell in cells if cell]
        elif mark == "k":
            cells = cells[: 1 + len(FACE_CAP_TURNS) + len(names)]
            if len(cells) < 1 + len(FACE_CAP_TURNS) + len(names):
                problem = (
                    f"has {len(cells)} values, but {1 + len(FACE_CAP_TURNS) + len(names)} are due: is the file cut off?"
                )
                raise FormatError(file, problem, line=number)
            turns = cells[1 : 1 + len(FACE_CAP_TURNS)]
            turned = [_in_radians(c) if "Euler" in n else c for n, c in zip(FACE_CAP_TURNS, turns, strict=True)]
            rows.append((cells[0], *turned, *cells[1 + len(FACE_CAP_TURNS) :]))
            numbers.append(number)
    return _table(file, ["timestamp_ms", *FACE_CAP_TURNS, *names], rows, numbers)


def _ifacialmocap(file: Path, lines: Sequence[tuple[int, str]]) -> TableFile:
    """iFacialMocap's frames."""
    found: list[tuple[str, dict[str, str]]] = []
    numbers = []
    for number, line in lines:
        for text in (part for part in line.split(FRAME_END) if part.strip(" |")):
            match = IFACIALMOCAP.match(text.strip())
            if match is None:
                raise FormatError(file, f"must be a frame NAME-SCORE|..., but it is {text[:40]!r}", line=number)
            scores, _, turns = match["frame"].partition("=")
            values = dict(part for segment in scores.split("|") for part in PART.findall(segment))
            values |= _turns_and_places(turns)
            found.append((match["before"].strip(BESIDE_TIME), values))
            numbers.append(number)
    return replace(_of_dicts(file, found, numbers), per_cent=_per_cent(found))


def _turns_and_places(text: str) -> dict[str, str]:
    """Turns in rad, and the head's place, of ``head#X,Y,Z,x,y,z|rightEye#X,Y,Z|...``."""
    found: dict[str, str] = {}
    for name, numbers in re.findall(r"([A-Za-z]+)#([^|#]*)", text):
        cells = [cell.strip() for cell in numbers.split(",")]
        found |= {f"{name}Euler{axis}": _in_radians(cell) for axis, cell in zip("XYZ", cells, strict=False)}
        found |= {f"{name}Position{axis}": cell for axis, cell in zip("XYZ", cells[3:], strict=False)}
    return found


def _in_radians(cell: str) -> str:
    """An angle in degrees as one in rad, of less than half a turn; what is none as it is."""
    degrees = parsed_number(cell)
    if degrees is None or not math.isfinite(degrees):
        return cell
    return f"{math.radians((degrees + 180.0) % 360.0 - 180.0):.9g}"


def _per_cent(found: Sequence[tuple[str, dict[str, str]]]) -> bool:
    """Whether scores go from 0 to 100, as they are sent; a logger may have made them shares."""
    scores = [score for _, values in found for name, score in values.items() if not TURN_OR_PLACE.search(name)]
    return not (any("." in score for score in scores) and all(float(score) <= 1.0 for score in scores))


def _vmc(file: Path, lines: Sequence[tuple[int, str]]) -> TableFile:
    """VMC's frames."""
    found: list[tuple[str, dict[str, str]]] = []
    numbers, values, before, clock = [], {}, "", ""
    for number, line in lines:
        match = VMC.match(line)
        if match is None:
            continue
        said = SAID.fullmatch(match["rest"].strip())
        if match["address"].endswith("/T") and said is not None:
            clock = said["score"]
        elif match["address"].endswith("/Val"):
            if said is None or not said["name"]:
                raise FormatError(file, "must have a name and a score", line=number)
            values[said["name"]] = said["score"]
            before = match["before"].strip(BESIDE_TIME) or before
        elif match["address"].endswith("/Apply") and values:
            found.append((clock or before, dict(values)))
            numbers.append(number)
            values = {}
    return _of_dicts(file, found, numbers)


def _of_dicts(file: Path, found: Sequence[tuple[str, dict[str, str]]], numbers: Sequence[int]) -> TableFile:
    """A table of frames that name what they state, with the times before them."""
    names = list(dict.fromkeys(name for _, values in found for name in values))
    timed = any(time for time, _ in found)
    rows = [(*([time] if timed else []), *(values.get(name, "") for name in names)) for time, values in found]
    return _table(file, [*(["timestamp"] if timed else []), *names], rows, numbers)


def _table(file: Path, columns: Sequence[str], rows: Sequence[tuple[str, ...]], numbers: Sequence[int]) -> TableFile:
    """The table; one without frames is refused."""
    if not rows:
        raise FormatError(file, "contains no frames: nothing was recorded")
    return TableFile(file, tuple(columns), tuple(rows), tuple(numbers))
