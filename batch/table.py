"""The rows of a table of jobs, CSV or TOML; what is wrong with a row is told cell by cell, and the row left out."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from ..errors import FormatError
from ..tables import Cells
from .columns import BY_NAME, COLUMNS, Value
from .jobs import Job, file_columns, name_problem, own_name
from .rows import Row, csv_rows, toml_rows
from .values import read_value

#: Columns that say what is shown, of which a row has one.
SOURCES = ("emotion", "angle", "fap", "text")
#: Columns that mean something only beside another.
ONLY_WITH = {
    "text": ("voice", "speed", "voice_pitch", "articulation", "jaw", "lean"),
    "head": ("object", "points"),
    "seed": ("variation",),
    "emotion or angle": ("activation", "variant", "timing", "onset", "apex", "offset", "before", "after", "tissue"),
}
#: Columns that mean nothing beside a text: its own sounds say when.
NOT_BESIDE_TEXT = ("timing", "onset", "apex", "offset", "before", "after", "tissue")
#: The longest table that is read: rows.
MOST_ROWS = 2_000_000
#: How tables are read, by the endings of their names.
READERS = {".csv": csv_rows, ".tsv": csv_rows, ".toml": toml_rows}
#: Heads that are read as one mesh and hold no objects.
PLAIN_MESHES = (".npz", ".obj")


@dataclass(frozen=True, eq=False)
class JobTable:
    """The jobs of a table in its order, and what is wrong with rows that are no jobs."""

    path: Path
    jobs: tuple[Job, ...]
    problems: tuple[FormatError, ...]


def read_jobs(path: str | Path) -> JobTable:
    """Read a table of jobs: .csv or .tsv, or .toml with a [[jobs]] for each and [defaults] for all.

    Raises
    ------
    FormatError : it cannot be read, has an unknown column, or no rows at all.
    """
    file = Path(path)
    suffix = file.suffix.lower()
    if suffix not in READERS:
        raise FormatError(file, "must be a .csv, .tsv or .toml file: save the table as one of these")
    jobs: list[Job] = []
    problems: list[FormatError] = []
    taken: dict[str, str] = {}
    for count, row in enumerate(READERS[suffix](file, problems)):
        if count == MOST_ROWS:
            raise FormatError(file, f"has more than {MOST_ROWS} rows: make it several tables")
        found = _job(row)
        if not isinstance(found, Job):
            problems += found
            continue
        before = taken.setdefault(found.id.lower(), row.place)
        if before is row.place:
            jobs.append(found)
        elif "id" in row.cells:
            problems.append(row.cells.refuse(f"{found.id!r} is the id of {before}, too: give each row its own", "id"))
        else:
            problems.append(row.cells.refuse(f"says what {before} says: remove one of them, or give both an id"))
    if not jobs and not problems:
        raise FormatError(file, "has no rows: give it one for each clip")
    return JobTable(file, tuple(jobs), tuple(problems))


def _job(row: Row) -> Job | list[FormatError]:
    """The job of a row, or all that is wrong with it."""
    cells = row.cells
    values: dict[str, Value] = {}
    problems: list[FormatError] = []
    for column in COLUMNS:
        with _noted(problems):
            values[column.name] = read_value(cells, column)
    if problems:
        return problems
    with _noted(problems):
        _one_source(cells, values)
        _refuse_idle(row, values)
        _known_words(cells, values)
        _files_there(cells, values)
        values["id"] = _id_of(cells, values)
    if problems:
        return problems
    inputs = {name: _file(cells, values, name) for name in file_columns() if values[name] is not None}
    return Job(str(values["id"]), row.place, values, inputs)


class _noted:
    """A block whose FormatError is put on a list instead of being raised."""

    def __init__(self, problems: list[FormatError]) -> None:
        self._problems = problems

    def __enter__(self) -> None:
        pass

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> bool:
        if isinstance(error, FormatError):
            self._problems.append(error)
            return True
        return False


def _one_source(cells: Cells, values: dict[str, Value]) -> None:
    """Exactly one thing is shown; a text may have a feeling."""
    given = [name for name in SOURCES if values[name] is not None]
    feeling = [name for name in given if name in ("emotion", "angle")]
    if not given:
        raise cells.refuse("says nothing to show: fill one of emotion, angle, fap and text")
    if len(feeling) == 2:
        raise cells.refuse("must be empty where there is an emotion: a word has its own angle", "angle")
    if "fap" in given and len(given) > 1:
        raise cells.refuse(f"must be empty where there is {given[0]}: a stream says all that is shown", "fap")
    if "angle" in given and values["activation"] is None:
        raise cells.refuse("needs an activation: fill it with 1 to 7", "angle")


def _refuse_idle(row: Row, values: dict[str, Value]) -> None:
    """No cell is filled that would say nothing; what is said for all rows is for those in which it says something."""
    for name, why in _idle(values):
        if values[name] == BY_NAME[name].default:
            continue
        if name in row.shared:
            values[name] = BY_NAME[name].default
        else:
            raise row.cells.refuse(why, name)


def _idle(values: Mapping[str, Value]) -> Iterator[tuple[str, str]]:
    """Columns that say nothing in a row, and why."""
    there = {
        "text": values["text"] is not None,
        "head": values["head"] is not None,
        "seed": values["seed"] is not None,
        "emotion or angle": values["emotion"] is not None or values["angle"] is not None,
    }
    for needed, names in ONLY_WITH.items():
        if not there[needed]:
            yield from ((name, f"says nothing without {needed}: empty it") for name in names)
    if there["text"]:
        yield from ((name, "says nothing beside text, whose sounds say when: empty it") for name in NOT_BESIDE_TEXT)
    if _suffix(values["head"]) in PLAIN_MESHES:
        yield "object", "says nothing here: a .npz or .obj is read as one mesh; empty it"
    if there["emotion or angle"] and not there["text"] and _is_posed(values):
        yield "tissue", "says nothing in a still alone, whose skin is at rest: empty it, or add film to outputs"
    if "labels" not in _outputs(values):
        about = "says nothing without labels in outputs: empty it, or add labels"
        yield from ((name, about) for name in ("label_pictures", "licence"))
    if "still" not in _outputs(values):
        yield "still_at", "says nothing without still in outputs: empty it, or add still"


def _known_words(cells: Cells, values: dict[str, Value]) -> None:
    """The emotion is known, and lasts."""
    from .. import api

    word, angle, variant = values["emotion"], values["angle"], values["variant"]
    if word is None and angle is None:
        return
    number = int(str(variant)) if variant is not None and str(variant).isdigit() else variant
    options = {"activation": values["activation"], "variants": number}
    felt = {"word": word} if word is not None else {"angle": angle}
    cells.made(lambda: api.expression(**felt, **options), "variant" if variant is not None else "emotion")  # type: ignore[arg-type]
    timing = api.load_timings()[str(values["timing"])]
    seconds = 0.0
    for name in ("onset", "apex", "offset"):
        value = values[name]
        seconds += value if isinstance(value, float) else getattr(timing, name)
    if values["text"] is not None:
        return
    if seconds <= 0.0:
        raise cells.refuse("must be more than 0 s together with apex and offset: nothing would show", "onset")
    end = seconds + sum(value for value in (values["before"], values["after"]) if isinstance(value, float))
    if isinstance(values["still_at"], float) and values["still_at"] > end:
        problem = f"must be {end:.6g} s or less, when the motion ends, but it is {values['still_at']:g}"
        raise cells.refuse(problem, "still_at")


def _files_there(cells: Cells, values: dict[str, Value]) -> None:
    """Every file that is named is there."""
    for name in file_columns():
        if values[name] is not None and not os.path.isfile(_file(cells, values, name)):
            raise cells.refuse(f"names no file: {_file(cells, values, name)} is not there; correct the path", name)


def _id_of(cells: Cells, values: dict[str, Value]) -> str:
    """The row's own id, or one made for it."""
    if "id" not in cells:
        return own_name(values)
    problem = name_problem(str(values["id"]))
    if problem is not None:
        raise cells.refuse(f"{problem}, but it is {str(values['id'])[:40]!r}", "id")
    return str(values["id"])


def _is_posed(values: Mapping[str, Value]) -> bool:
    """Whether a row shows the pose of the apex alone, for which no motion is simulated."""
    outputs = set(_outputs(values))
    if values["still_at"] is not None or outputs & {"film", "blend", "glb"}:
        return False
    return "still" in outputs or "labels" not in outputs


def _outputs(values: Mapping[str, Value]) -> tuple[str, ...]:
    """What is to be made."""
    found = values["outputs"]
    return found if isinstance(found, tuple) else ()


def _suffix(value: Value) -> str:
    """Ending of a file's name, in small letters."""
    return Path(value).suffix.lower() if isinstance(value, str) else ""


def _file(cells: Cells, values: dict[str, Value], name: str) -> Path:
    """A file that a row names, seen from the table's folder."""
    path = Path(os.path.expanduser(str(values[name])))  # Path's own raises where there is no such user
    return path if path.is_absolute() else cells.path.parent / path
