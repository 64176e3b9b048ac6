"""Jobs that are made without Blender, for the tests of this folder."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from risorius.batch.jobs import Job
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
