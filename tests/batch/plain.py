"""Jobs that are made without Blender, for the tests of this folder."""

from __future__ import annotations

import errno
import os
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import pytest
from risorius.batch.jobs import Job
from risorius.batch.place import JobSet
from risorius.batch.table import read_jobs
from risorius.progress import Progress, Work


@dataclass
class MadePlainly:
    """What scene's jobs tell of a clip, without Blender."""

    files: dict[str, str]
    frames: int = 1
    remarks: tuple[str, ...] = ()
    contents: dict[str, str] = field(default_factory=dict)
    blender: str = "none"


def make_plainly(job: Job, folder: Path, scratch: Path) -> Work[MadePlainly]:
    """A stream of text that says what the row says."""
    yield Progress(0.0, "Beginning")
    (scratch / "draft").write_bytes(b"x" * 1000)
    (folder / "clip.fap").write_text(f"{job.said()}\n" * 100)
    yield Progress(1.0, "Made")
    return MadePlainly({"fap": "clip.fap"})


def jobs_of(folder: Path, count: int = 5, extra: str = "") -> list[Job]:
    """As many jobs; `extra` is a note on each."""
    path = folder / "jobs.csv"
    rows = "".join(f"c{number},joy,{number % 6 + 1},fap{extra}\n" for number in range(count))
    path.write_text(f"id,emotion,activation,outputs{',yaw' if extra else ''}\n{rows}")
    return list(read_jobs(path).jobs)


def fill_disk(
    patch: pytest.MonkeyPatch, place: JobSet, calls: int, code: int = errno.ENOSPC, *, lasts: bool = True
) -> Callable[[], bool]:
    """After so many calls that change a file of the set, all others fail, or the next one; returns whether any has."""
    left = calls

    def limited(function: Callable[..., object]) -> Callable[..., object]:
        def run(*arguments: object, **options: object) -> object:
            nonlocal left
            inside = str(place.folder) in str(arguments[0]) or isinstance(arguments[0], int)
            left -= int(inside)
            if inside and (left < 0 if lasts else left == -1):
                raise OSError(code, os.strerror(code))
            return function(*arguments, **options)

        return run

    writes = ((Path, "write_bytes"), (Path, "write_text"), (Path, "mkdir"), (os, "rename"), (os, "fsync"))
    for owner, name in writes:
        patch.setattr(owner, name, limited(getattr(owner, name)))
    return lambda: left < 0
