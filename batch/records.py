"""What is written down of a job that is done, in its folder, and whether all of it is still there.

The record is written last into the folder in which a job is made, and the folder gets its name after that: a folder
with a record is whole.
"""

from __future__ import annotations

import json
import os
import platform
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..errors import LONGEST_PART, FormatError, short
from ..resources import version
from ..tables import KeyedTable, read_json
from .columns import ASIDE, COLUMNS
from .jobs import Job, digest_of

#: Name of a record in a job's folder.
RECORD = "job.json"
FORMAT = "risorius job"
VERSION = 1


@dataclass(frozen=True)
class Written:
    """A file that a job has made."""

    bytes: int
    sha256: str


@dataclass(frozen=True, eq=False)
class Record:
    """What is known of a job that is done.

    Attributes
    ----------
    row : what its row says.
    fingerprint : by which the row is known again.
    inputs : column -> SHA-256 of the file that was read.
    files : path inside the folder -> file. Labels lie in a folder of their own.
    contents : path -> digest of what a file holds, where its bytes differ from time to time: .blend.
    versions : of all that it was made with.
    seconds : how long it took. began : when, in seconds since 1970.
    frames : of the motion.
    remarks : what was said.
    before : what stood in this place before, oldest first: of each clip that this one replaced, its own record.
    """

    id: str
    row: Mapping[str, Any]
    fingerprint: str
    inputs: Mapping[str, str]
    files: Mapping[str, Written]
    contents: Mapping[str, str] = field(default_factory=dict)
    versions: Mapping[str, str] = field(default_factory=dict)
    seconds: float = 0.0
    began: float = 0.0
    frames: int = 0
    remarks: Sequence[str] = ()
    before: Sequence[Mapping[str, Any]] = ()

    def document(self) -> dict[str, Any]:
        """As JSON has it."""
        before = {"before": list(self.before)} if self.before else {}
        files = {name: {"bytes": each.bytes, "sha256": each.sha256} for name, each in sorted(self.files.items())}
        return {
            "format": FORMAT,
            "version": VERSION,
            "id": self.id,
            "row": dict(self.row),
            "seed": self.row.get("seed"),
            "fingerprint": self.fingerprint,
            "inputs": dict(self.inputs),
            "files": files,
            "contents": dict(self.contents),
            "frames": self.frames,
            "seconds": round(self.seconds, 3),
            "began": round(self.began, 3),
            "versions": dict(self.versions),
            "remarks": list(self.remarks),
            **before,
        }

    def as_past(self) -> list[dict[str, Any]]:
        """What the record of a clip says that replaces this one: all that stood in its place."""
        own = self.document()
        own.pop("before", None)
        return [*(dict(each) for each in self.before), own]


def files_in(folder: Path) -> dict[str, Path]:
    """Path inside a folder -> file, of all that is in it but the record."""
    found = {path.relative_to(folder).as_posix(): path for path in sorted(folder.rglob("*")) if path.is_file()}
    found.pop(RECORD, None)
    return found


def measured(path: Path) -> Written:
    """A file as it is.

    Raises
    ------
    OSError : it cannot be read.
    """
    return Written(path.stat().st_size, digest_of(path))


def record_bytes(record: Record) -> bytes:
    """A record as a file."""
    return (json.dumps(record.document(), indent=1, ensure_ascii=False) + "\n").encode()


def read_record(folder: Path) -> Record | None:
    """The record of a folder; None where it has none.

    Raises
    ------
    FormatError : it is not the record of a job.
    """
    path = folder / RECORD
    if not path.is_file():
        return None
    try:
        return _record(read_json(path, kind=FORMAT, version=VERSION))
    except FormatError as error:
        problem = f"is not the record of a job ({short(str(error), LONGEST_PART)}): remove its folder"
        raise FormatError(path, problem) from error


def _record(table: KeyedTable) -> Record:
    """A record as JSON has it."""
    files = {name: table.table("files").table(name) for name in table.table("files")}
    return Record(
        id=table.text("id"),
        row=dict(table.table("row").cells),
        fingerprint=table.text("fingerprint"),
        inputs=_texts(table.table("inputs")),
        files={name: Written(file.integer("bytes", least=0), file.text("sha256")) for name, file in files.items()},
        contents=_texts(table.table("contents")),
        versions=_texts(table.table("versions")),
        seconds=table.number("seconds", least=0.0),
        began=table.number("began", least=0.0),
        frames=table.integer("frames", least=0),
        remarks=table.texts("remarks"),
        before=[dict(past.cells) for past in (table.listed("before") if "before" in table else ())],
    )


def _texts(table: KeyedTable) -> dict[str, str]:
    """The texts of a table."""
    return {name: table.text(name, "") for name in table}


def damage(folder: Path, record: Record) -> str | None:
    """What is not as the record says; None where all is."""
    for name, written in record.files.items():
        path = folder / name
        try:
            if measured(path) != written:
                return f"{name} has changed"
        except OSError:
            return f"{name} is gone"
    return None


def versions(blender: str) -> dict[str, str]:
    """What jobs are made with here."""
    import numpy
    import scipy

    return {
        "risorius": version(),
        "blender": blender,
        "python": platform.python_version(),
        "numpy": numpy.__version__,
        "scipy": scipy.__version__,
        "platform": f"{platform.system()} {platform.machine()}",
        "cores": str(os.cpu_count()),
    }


def changes(record: Record, job: Job) -> str:
    """In which columns a job's row says other than a record, or names a file that has changed, for people."""
    now, files = job.said(), job.digests()
    differ = {name for name in {*now, *record.row} if name not in ASIDE and now.get(name) != record.row.get(name)}
    differ -= {*files, *record.inputs}  # by what they hold, wherever they are
    differ |= {name for name in {*files, *record.inputs} if files.get(name) != record.inputs.get(name)}
    return ", ".join(column.name for column in COLUMNS if column.name in differ)


def same_row(record: Record, job: Job) -> bool:
    """Whether a record is of what a job's row says now."""
    return record.fingerprint == job.fingerprint()
