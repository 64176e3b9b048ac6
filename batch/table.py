"""The rows of a table of jobs, CSV or TOML; what is wrong with a row is told cell by cell, and the row left out."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from ..errors import FormatError
from ..files import read_bytes
from ..tables import Cells, CsvRow, TomlTable, read_toml, row_cells, split_cells, table_lines
from .columns import BY_NAME, COLUMNS, Value
from .jobs import Job, file_columns, name_problem, own_name
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
#: Heads that are read as one mesh and hold no objects.
PLAIN_MESHES = (".npz", ".obj")


@dataclass(frozen=True, eq=False)
class JobTable:
    """The jobs of a table in its order, and what is wrong with rows that are no jobs."""

    path: Path
    jobs: tuple[Job, ...]
    problems: tuple[FormatError, ...]


def read_jobs(path: str | Path) -> JobTable:
    """Read a table of jobs: .csv, or .toml with a [[jobs]] for each and [defaults] for all.

    Raises
    ------
    FormatError : it cannot be read, has an unknown column, or no rows at all.
    """
    file = Path(path)
    suffix = file.suffix.lower()
    if suffix not in (".csv", ".toml"):
        raise FormatError(file, "must be a .csv or .toml file: save the table as one of these")
    jobs: list[Job] = []
    problems: list[FormatError] = []
    taken: dict[str, str] = {}
    rows = _csv_rows(file, problems) if suffix == ".csv" else _toml_rows(file)
    for count, (place, cells) in enumerate(rows):
        if count == MOST_ROWS:
            raise FormatError(file, f"has more than {MOST_ROWS} rows: make it several tables")
        found = _job(cells, place)
        if not isinstance(found, Job):
            problems += found
            continue
        before = taken.setdefault(found.id.lower(), place)
        if before is place:
            jobs.append(found)
        elif "id" in cells:
            problems.append(cells.refuse(f"{found.id!r} is the id of {before}, too: give each row its own", "id"))
        else:
            problems.append(cells.refuse(f"says what {before} says: remove one of them, or give both an id"))
    if not jobs and not problems:
        raise FormatError(file, "has no rows: give it one for each clip")
    return JobTable(file, tuple(jobs), tuple(problems))


def _csv_rows(file: Path, problems: list[FormatError]) -> Iterator[tuple[str, Cells]]:
    """The rows of a CSV file; a line that is no row is a problem of its own."""
    lines = table_lines(file)
    separator = _separator(lines[0][1])
    heading = [name.lower() for name in split_cells(file, *lines[0], separator=separator)]
    CsvRow(file, dict.fromkeys(heading, ""), lines[0][0]).only(*BY_NAME)
    for name in heading:
        if heading.count(name) > 1:
            raise FormatError(file, "stands twice in the heading: keep one", line=lines[0][0], column=name)
    for number, line in lines[1:]:
        try:
            cells = row_cells(file, len(heading), number, line, separator=separator)
        except FormatError as error:
            problems.append(error)
            continue
        if any(cells):
            yield f"line {number}", CsvRow(file, dict(zip(heading, cells, strict=True)), number)


def _separator(heading: str) -> str:
    """What parts the cells: spreadsheets of some countries write semicolons or tabs."""
    return max((",", ";", "\t"), key=heading.count)


class _Placed(TomlTable):
    """One job of a TOML file, that knows its line."""

    line: int | None = None

    def refuse(self, problem: str, name: str | None = None) -> FormatError:
        """The error for one cell, or for the whole job."""
        error = super().refuse(problem, name)
        return FormatError(self.path, problem, line=self.line, key=error.key)


def _toml_rows(file: Path) -> Iterator[tuple[str, Cells]]:
    """The jobs of a TOML file, with what its [defaults] say."""
    whole = read_toml(file)
    whole.only("defaults", "jobs")
    shared = whole.table("defaults", optional=True)
    shared.only(*(name for name in BY_NAME if name != "id"))
    entries = whole.listed("jobs")
    lines = [
        number
        for number, line in enumerate(read_bytes(file).decode("utf-8-sig").splitlines(), start=1)
        if re.match(r"\s*\[\[\s*jobs\s*\]\]", line)
    ]
    for number, entry in enumerate(entries):
        entry.only(*BY_NAME)
        row = _Placed(file, {**shared.cells, **entry.cells}, entry.key)
        row.line = lines[number] if len(lines) == len(entries) else None
        yield (f"line {row.line}" if row.line else f"job {number + 1}"), row


def _job(cells: Cells, place: str) -> Job | list[FormatError]:
    """The job of a row, or all that is wrong with it."""
    values: dict[str, Value] = {}
    problems: list[FormatError] = []
    for column in COLUMNS:
        with _noted(problems):
            values[column.name] = read_value(cells, column)
    if problems:
        return problems
    with _noted(problems):
        for check in (_one_source, _nothing_idle, _known_words, _files_there):
            check(cells, values)
        values["id"] = _id_of(cells, values)
    if problems:
        return problems
    inputs = {name: _file(cells, values, name) for name in file_columns() if values[name] is not None}
    return Job(str(values["id"]), place, values, inputs)


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


Check = Callable[[Cells, dict[str, Value]], None]


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


def _nothing_idle(cells: Cells, values: dict[str, Value]) -> None:
    """No cell is filled that would say nothing."""
    feels = values["emotion"] is not None or values["angle"] is not None
    there = {
        "text": values["text"] is not None,
        "head": values["head"] is not None,
        "seed": values["seed"] is not None,
        "emotion or angle": feels,
    }
    for needed, names in ONLY_WITH.items():
        for name in names:
            if name in cells and not there[needed] and values[name] != BY_NAME[name].default:
                raise cells.refuse(f"says nothing without {needed}: empty it", name)
    for name in NOT_BESIDE_TEXT:
        if name in cells and values["text"] is not None and values[name] != BY_NAME[name].default:
            raise cells.refuse("says nothing beside text, whose sounds say when: empty it", name)
    if values["object"] is not None and _suffix(values["head"]) in PLAIN_MESHES:
        raise cells.refuse("says nothing here: a .npz or .obj is read as one mesh; empty it", "object")
    for name in ("label_pictures", "licence"):
        if values[name] != BY_NAME[name].default and "labels" not in _outputs(values):
            raise cells.refuse("says nothing without labels in outputs: empty it, or add labels", name)
    if values["still_at"] is not None and "still" not in _outputs(values):
        raise cells.refuse("says nothing without still in outputs: empty it, or add still", "still_at")


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
    if values["text"] is None and seconds <= 0.0:
        raise cells.refuse("must be more than 0 s together with apex and offset: nothing would show", "onset")


def _files_there(cells: Cells, values: dict[str, Value]) -> None:
    """Every file that is named is there."""
    for name in file_columns():
        if values[name] is not None and not _file(cells, values, name).is_file():
            raise cells.refuse(f"names no file: {_file(cells, values, name)} is not there; correct the path", name)


def _id_of(cells: Cells, values: dict[str, Value]) -> str:
    """The row's own id, or one made for it."""
    if "id" not in cells:
        return own_name(values)
    problem = name_problem(str(values["id"]))
    if problem is not None:
        raise cells.refuse(f"{problem}, but it is {str(values['id'])[:40]!r}", "id")
    return str(values["id"])


def _outputs(values: dict[str, Value]) -> tuple[str, ...]:
    """What is to be made."""
    found = values["outputs"]
    return found if isinstance(found, tuple) else ()


def _suffix(value: Value) -> str:
    """Ending of a file's name, in small letters."""
    return Path(value).suffix.lower() if isinstance(value, str) else ""


def _file(cells: Cells, values: dict[str, Value], name: str) -> Path:
    """A file that a row names, seen from the table's folder."""
    path = Path(str(values[name])).expanduser()
    return path if path.is_absolute() else cells.path.parent / path
