"""One job from its claim to its place: made whole, kept as it is, or failed with a reason."""

from __future__ import annotations

import contextlib
import errno
import shutil
import tempfile
import time
import traceback
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from enum import Enum
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING

from ..errors import RisoriusError
from ..progress import Report, Work, run
from . import making
from .claims import Claim
from .jobs import Job
from .place import JobSet, State
from .records import Record, changes, damage, files_in, measured, versions
from .whole import what_is_missing

if TYPE_CHECKING:
    from ..scene.jobs.clip import MadeClip

#: Bytes under which a disk counts as full where something could not be written.
FULL = 32 * 2**20

#: Makes a job in a folder, with another folder for what is not kept.
Make = Callable[[Job, Path, Path], "Work[MadeClip]"]


class How(Enum):
    """What became of a job."""

    MADE = "made"
    KEPT = "kept"
    FAILED = "failed"
    ELSEWHERE = "in work elsewhere"


@dataclass(frozen=True)
class Told:
    """What became of a job, how long it took, and what is to be said: `why` it failed, and remarks."""

    id: str
    how: How
    seconds: float = 0.0
    why: str = ""
    remarks: tuple[str, ...] = ()


class StoppedError(RisoriusError):
    """Nothing more can be made now; what is done stays done, and the same command goes on."""


class DiskFullError(StoppedError):
    """There is no room left: nothing more can be made, and nothing that is done is lost."""


def do_job(
    job: Job, place: JobSet, *, changed: bool = False, make: Make = making.make, progress: Report | None = None
) -> Told:
    """Make a job unless it is done, or another process is at it.

    Parameters
    ----------
    changed : make it anew where its row has changed, in the place of what was made.

    Raises
    ------
    DiskFullError : there is no room; the job is as it was before.
    """
    began = time.time()
    try:
        with place.claim(job) as claim:
            if claim is Claim.TAKEN:
                return Told(job.id, How.ELSEWHERE)
            if claim is Claim.HELD:
                place.recover(job)
            state, record, why = place.state(job)
            if state is State.DONE:
                return Told(job.id, How.KEPT)
            replaced = record if changed and state is State.OTHER else None
            refused = None if replaced else _refusal(job, place, state)
            if refused:
                return Told(job.id, How.FAILED, why=refused)
            said = (_aside(job, place, why),) if state is State.DAMAGED else ()
            remarks = _make_it(job, place, claim, make, progress, replaced)
            return Told(job.id, How.MADE, time.time() - began, remarks=said + remarks)
    except (RisoriusError, OSError) as error:
        if isinstance(error, DiskFullError) or _is_full(error, place):
            room = f"{place.folder} or {tempfile.gettempdir()}"
            raise DiskFullError(f"the disk is full: free some room on that of {room}, and start again") from error
        why = str(error)
    except Exception as error:  # one job that goes wrong in a new way must not end thousands
        place.write_failure(job, traceback.format_exc())
        why = f"unexpected {type(error).__name__}: {error} (all of it is in {place.failure_of(job)})"
        return Told(job.id, How.FAILED, time.time() - began, why)
    place.write_failure(job, why)
    return Told(job.id, How.FAILED, time.time() - began, why)


def _refusal(job: Job, place: JobSet, state: State) -> str | None:
    """Why what stands in a job's place keeps it from being made."""
    there = place.place_of(job)
    if state is State.OTHER:
        remedy = "give this row another id, or make the clip anew with --rerun-changed"
        return f"{there} was made from another row: {remedy}"
    if state is State.FOREIGN:
        return f"{there} is there already and is no clip of this set: give this row another id, or move it away"
    return None


def _aside(job: Job, place: JobSet, why: str) -> str:
    """Put a damaged folder aside, and say so."""
    return f"{place.place_of(job)} was damaged ({why}): it is in {place.put_aside(job)} now, and made again"


def _replacing(job: Job, place: JobSet, replaced: Record) -> str:
    """Say which clip gives way; one that somebody has changed is kept aside, since no row makes it again."""
    there = place.place_of(job)
    what = f"its row has changed ({changes(replaced, job)})"
    by_hand = damage(there, replaced) or next(
        (f"{name} was added" for name in files_in(there).keys() - replaced.files), ""
    )
    return f"{what}: what was made before, {by_hand}, is in {place.put_aside(job)} now" if by_hand else what


def _make_it(
    job: Job, place: JobSet, claim: Claim, make: Make, progress: Report | None, replaced: Record | None
) -> tuple[str, ...]:
    """Make a job and give it its place, and that of the clip it replaces; returns remarks."""
    began = time.time()
    with place.making(job, claim) as folder, _scratch(job, place, claim) as scratch:
        made = run(make(job, folder, scratch), progress)
        for name in made.files.values():
            _refuse_incomplete(folder / name)
        files = {name: measured(path) for name, path in files_in(folder).items()}
        record = Record(
            id=job.id,
            row=job.said(),
            fingerprint=job.fingerprint(),
            inputs=job.digests(),
            files=files,
            contents=made.contents,
            versions=versions(made.blender),
            seconds=time.time() - began,
            began=began,
            frames=made.frames,
            remarks=made.remarks,
            before=replaced.as_past() if replaced else (),
        )
        said = (_replacing(job, place, replaced),) if replaced else ()
        if not place.publish(job, folder, record, replaced=replaced):
            return ("another process made it at the same time, and was first",)
    return said + tuple(made.remarks)


def _refuse_incomplete(path: Path) -> None:
    """Refuse a file, or a folder of files, that was not written to its end.

    Raises
    ------
    RisoriusError : says which.
    """
    if not path.exists():
        raise RisoriusError(f"{path.name} was not written: see what Blender said, and start again")
    for file in sorted(path.rglob("*")) if path.is_dir() else [path]:
        missing = what_is_missing(file) if file.is_file() else None
        if missing is not None:
            raise RisoriusError(f"{file.name} was not written to its end ({missing}): start again")


@contextlib.contextmanager
def _scratch(job: Job, place: JobSet, claim: Claim) -> Iterator[Path]:
    """A folder on this computer for all temporary files of a job; those of killed processes are removed."""
    prefix = f"risorius-{sha256(str(place.folder.resolve()).encode()).hexdigest()[:12]}-{job.id}~"
    usual, temporary = tempfile.tempdir, Path(tempfile.gettempdir())
    if claim is Claim.HELD:
        for left in temporary.glob(f"{prefix}*"):
            shutil.rmtree(left, ignore_errors=True)
    folder = tempfile.mkdtemp(prefix=prefix)
    tempfile.tempdir = folder
    try:
        yield Path(folder)
    finally:
        tempfile.tempdir = usual
        shutil.rmtree(folder, ignore_errors=True)


def _is_full(error: BaseException, place: JobSet) -> bool:
    """Whether something went wrong for want of room: as the system says, or where nobody does, by looking."""
    cause: BaseException | None = error
    while cause is not None:
        if isinstance(cause, OSError) and cause.errno in (errno.ENOSPC, errno.EDQUOT):
            return True
        cause = cause.__cause__ or cause.__context__
    try:
        return min(place.free(), shutil.disk_usage(tempfile.gettempdir()).free) < FULL
    except OSError:
        return False
