"""The folder of a set of clips, in which each job has a folder of its own, whole or not there at all.

    set/ID/                     a job that is done, with its record
    set/manifest.jsonl          all that are done, a line each
    set/.risorius/claims/       locks of the jobs that are in work
    set/.risorius/unfinished/   what is in work; what a killed process leaves is removed by the next one
    set/.risorius/failed/       why a job could not be made
    set/.risorius/replaced/     clips whose row has changed, until the new ones have their places
    set/.risorius/heads/        prepared heads, for those who come next; safe to delete
    set/.risorius/aside/        folders that were not as their record says, kept for you

A job is made in a folder on the same disk, written through to it, and gets its place by one renaming, which is done or
not done whatever happens in between.
"""

from __future__ import annotations

import contextlib
import json
import os
import secrets
import shutil
import sys
from collections.abc import Iterator
from enum import Enum
from pathlib import Path

from ..errors import FormatError
from .claims import Claim, claimed
from .jobs import Job
from .records import RECORD, Record, damage, read_record, record_bytes, same_row

#: The folder for what is not the user's.
OWN = ".risorius"


class State(Enum):
    """What is there of a job."""

    MISSING = "not made"
    DONE = "done"
    DAMAGED = "not as its record says"
    OTHER = "made from another row"
    FOREIGN = "not a job's folder"


class JobSet:
    """The folder of a set."""

    def __init__(self, folder: str | Path) -> None:
        """Use a folder; it is made by `prepare`."""
        self.folder = Path(folder)
        own = self.folder / OWN
        self._claims, self._unfinished = own / "claims", own / "unfinished"
        self._failed, self._aside, self.heads = own / "failed", own / "aside", own / "heads"
        self._replaced = own / "replaced"

    def prepare(self) -> None:
        """Make the folder.

        Raises
        ------
        FormatError : it cannot be made or written.
        """
        try:
            for folder in (self._claims, self._unfinished, self._failed):
                folder.mkdir(parents=True, exist_ok=True)
            probe = self._unfinished / f".probe-{secrets.token_hex(6)}"
            probe.mkdir()
            probe.rmdir()
        except OSError as error:
            problem = f"cannot be written ({error.strerror}): choose a folder you may write to"
            raise FormatError(self.folder, problem) from error

    def is_there(self) -> bool:
        """Whether it has been prepared, and is seen from here."""
        return self._unfinished.is_dir()

    def place_of(self, job: Job) -> Path:
        """Where a job stands when it is done."""
        return self.folder / job.id

    def claim(self, job: Job) -> contextlib.AbstractContextManager[Claim]:
        """Hold a job for this process."""
        return claimed(self._claims / f"{job.id}.lock")

    def state(self, job: Job, *, check: bool = True) -> tuple[State, Record | None, str]:
        """What is there of a job, its record, and why it is no good; `check` : whether to read every byte of it."""
        place = self.place_of(job)
        if not place.exists():
            return State.MISSING, None, ""
        try:
            record = read_record(place)
        except FormatError as error:
            return State.DAMAGED, None, error.problem
        if record is None:
            return State.FOREIGN, None, "it has no record of a job"
        if not same_row(record, job):
            return State.OTHER, record, ""
        why = damage(place, record) if check else None
        return (State.DONE, record, "") if why is None else (State.DAMAGED, record, why)

    @contextlib.contextmanager
    def making(self, job: Job, claim: Claim) -> Iterator[Path]:
        """A folder to make a job in, which is removed unless it was `publish`ed."""
        if claim is Claim.HELD:  # whoever made these is gone
            for left in self._unfinished.glob(f"{job.id}~*"):
                _clear(left)
        folder = self._unfinished / f"{job.id}~{secrets.token_hex(6)}"
        folder.mkdir()
        try:
            yield folder
        finally:
            _clear(folder)

    def publish(self, job: Job, folder: Path, record: Record, *, replaced: Record | None = None) -> bool:
        """Give a job that is made in `folder` its place; False where another process was first.

        The clip of the record `replaced`, where it stands there, gives way last of all, and is removed when the new one
        has its place.

        Raises
        ------
        OSError : the disk is full, or the folder cannot be renamed; nothing has changed then.
        """
        (folder / RECORD).write_bytes(record_bytes(record))
        _write_through(folder)
        place = self.place_of(job)
        if replaced is not None:
            self._give_way(job, replaced)
        try:
            os.rename(folder, place)
        except OSError:
            if place.exists():
                return False
            self.recover(job)
            raise
        _write_through_folder(self.folder)
        self.recover(job)
        with contextlib.suppress(OSError):
            self.failure_of(job).unlink()
        return True

    def _give_way(self, job: Job, replaced: Record) -> None:
        """Move a clip that is to be replaced out of its place; one that another process has replaced stays."""
        there = read_record(self.place_of(job))
        if there is not None and there.fingerprint == replaced.fingerprint:
            self._replaced.mkdir(exist_ok=True)
            os.rename(self.place_of(job), self._replaced / f"{job.id}~{secrets.token_hex(6)}")

    def recover(self, job: Job) -> None:
        """End what a process began that replaced a clip: the old one goes back to its place, or where the new one is
        there, away. Whoever calls this holds the job.
        """
        place = self.place_of(job)
        for old in sorted(self._replaced.glob(f"{job.id}~*")):
            if place.exists():
                _clear(old)
            else:
                os.rename(old, place)

    def put_aside(self, job: Job) -> Path:
        """Move what stands in a job's place away, and say where it is now."""
        self._aside.mkdir(exist_ok=True)
        number = 1
        while (to := self._aside / f"{job.id}~{number}").exists():
            number += 1
        os.rename(self.place_of(job), to)
        return to

    def write_failure(self, job: Job, why: str) -> None:
        """Keep why a job could not be made; a disk that is full keeps nothing."""
        with contextlib.suppress(OSError):
            self.failure_of(job).write_text(json.dumps({"id": job.id, "why": why}) + "\n", encoding="utf-8")

    def left(self) -> set[str]:
        """Names of the jobs at which a process is, or ended."""
        return {path.name.partition("~")[0] for path in self._unfinished.glob("*~*")}

    def free(self) -> int:
        """Bytes that are free on the disk."""
        return shutil.disk_usage(self.folder).free

    def failure_of(self, job: Job) -> Path:
        """The file that tells why a job could not be made."""
        return self._failed / f"{job.id}.json"


def _clear(folder: Path) -> None:
    """Remove a folder; what cannot be removed now, the next process that makes the job will remove."""
    shutil.rmtree(folder, ignore_errors=True)


def _write_through(folder: Path) -> None:
    """Have all files of a folder on the disk, not only on their way to it."""
    for path in folder.rglob("*"):
        if path.is_file():
            with path.open("r+b") as file:
                os.fsync(file.fileno())
        elif path.is_dir():
            _write_through_folder(path)
    _write_through_folder(folder)


def _write_through_folder(folder: Path) -> None:
    """The same for the list of a folder's files; Windows does so itself."""
    if sys.platform == "win32":
        return
    handle = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
