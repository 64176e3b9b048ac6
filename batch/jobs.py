"""One row as a job: its name, all that it says, and the fingerprint by which it is known again."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from hashlib import sha256
from pathlib import Path
from typing import Any

from .columns import ASIDE, BY_NAME, COLUMNS, Kind, Value

#: What an id may be: a name that is a folder's on every system.
NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]{0,99}")
#: Names that Windows keeps for devices.
DEVICES = {"con", "prn", "aux", "nul", *(f"{port}{number}" for port in ("com", "lpt") for number in range(1, 10))}
#: Names of the files that a set's folder has of its own.
OWN = re.compile(r"manifest\..*jsonl|jobs\.csv")
#: Letters of a digest that tell rows without an id apart.
LETTERS = 10


@dataclass(frozen=True, eq=False)
class Job:
    """A clip or a still to be made.

    Attributes
    ----------
    id : name of its folder.
    place : where its row stands, for people.
    values : what each column says, defaults filled in.
    inputs : column -> file that is read.
    """

    id: str
    place: str
    values: Mapping[str, Value]
    inputs: Mapping[str, Path]

    @property
    def outputs(self) -> tuple[str, ...]:
        """What is made."""
        found = self.values["outputs"]
        assert isinstance(found, tuple)
        return found

    def said(self) -> dict[str, Any]:
        """What the row says that no default says, as JSON has it."""
        given = {name: value for name, value in self.values.items() if value != BY_NAME[name].default}
        return {name: list(value) if isinstance(value, tuple) else value for name, value in given.items()}

    def number(self, name: str) -> float:
        """A number that has a default."""
        value = self.values[name]
        assert isinstance(value, int | float)
        return float(value)

    def maybe(self, name: str) -> float | None:
        """A number, or None where it is left out."""
        return None if self.values[name] is None else self.number(name)

    def whole(self, name: str) -> int | None:
        """A whole number, or None where it is left out."""
        value = self.values[name]
        return value if isinstance(value, int) else None

    def text(self, name: str) -> str:
        """A text; empty where it is left out."""
        return str(self.values[name] or "")

    def digests(self) -> dict[str, str]:
        """Column -> SHA-256 of the file that is read.

        Raises
        ------
        OSError : a file cannot be read.
        """
        return {name: _digest_of(path, *_stamp(path)) for name, path in sorted(self.inputs.items())}

    def fingerprint(self) -> str:
        """By what the job is known again: what the row says, and what is in the files that it names."""
        said = {name: value for name, value in self.said().items() if name not in (*ASIDE, *self.inputs)}
        return sha256(json.dumps([said, self.digests()], sort_keys=True).encode()).hexdigest()


def own_name(values: Mapping[str, Value]) -> str:
    """An id for a row that has none: what it shows, and a digest of all that it says."""
    said = {name: value for name, value in values.items() if value != BY_NAME[name].default and name not in ASIDE}
    digest = sha256(json.dumps(said, sort_keys=True, default=list).encode()).hexdigest()[:LETTERS]
    fap = values["fap"]
    shown = Path(fap).stem if isinstance(fap, str) else str(values["emotion"] or "")
    shown = shown or ("wheel" if values["angle"] is not None else "speech")
    return f"{re.sub('[^A-Za-z0-9]+', '-', shown).strip('-')[:40].lower() or 'clip'}-{digest}"


def name_problem(name: str) -> str | None:
    """Why a name cannot be an id, and what can."""
    if not NAME.fullmatch(name) or name.endswith("."):
        return "must begin with a letter or digit and hold letters, digits, '.', '_' and '-' only, at most 100"
    if name.split(".")[0].lower() in DEVICES or OWN.fullmatch(name.lower()):
        return "must not be a name that is taken: choose another"
    return None


def file_columns() -> tuple[str, ...]:
    """Names of the columns that name a file."""
    return tuple(column.name for column in COLUMNS if column.kind is Kind.FILE)


def _stamp(path: Path) -> tuple[int, int]:
    """Size and time of a file: while they stay, so do its bytes."""
    found = path.stat()
    return found.st_size, found.st_mtime_ns


@lru_cache(maxsize=4096)
def _digest_of(path: Path, size: int, changed: int) -> str:
    """SHA-256 of a file that has had this size since this time."""
    return digest_of(path)


def digest_of(path: Path) -> str:
    """SHA-256 of a file.

    Raises
    ------
    OSError : it cannot be read.
    """
    digest = sha256()
    with path.open("rb") as file:
        while block := file.read(1 << 20):
            digest.update(block)
    return digest.hexdigest()
