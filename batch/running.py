"""All jobs of a set one after another in this process, beside others who do the same with the same folder."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from ..errors import ParameterError
from ..progress import Report
from . import making
from .doing import How, Make, Told, do_job
from .jobs import Job
from .place import JobSet

#: Seconds between two looks at jobs that another process makes.
PAUSE = 1.0

#: Called with each job that is finished, what became of it, and the jobs that are left.
Tell = Callable[[Job, Told, Sequence[Job]], None]


@dataclass
class Outcome:
    """What became of all jobs."""

    made: list[Told] = field(default_factory=list)
    kept: list[Told] = field(default_factory=list)
    failed: list[Told] = field(default_factory=list)

    def note(self, told: Told) -> None:
        """A job is finished."""
        {How.MADE: self.made, How.KEPT: self.kept, How.FAILED: self.failed}[told.how].append(told)


def in_order(jobs: Sequence[Job], place: JobSet) -> list[Job]:
    """Jobs in the order in which they are made: those of one head together, and last those that ended a process."""
    heads: dict[str, int] = {}
    for job in jobs:
        heads.setdefault(job.text("head"), len(heads))
    left = place.left()
    return sorted(jobs, key=lambda job: (job.id in left, heads[job.text("head")]))


def shard(jobs: Sequence[Job], part: str) -> list[Job]:
    """The jobs of one part of several: "2/10" is the second of ten.

    Raises
    ------
    ParameterError : no such part.
    """
    number, _, count = part.partition("/")
    rule = "must be PART/PARTS, from 1/PARTS to PARTS/PARTS"
    if not (number.isdigit() and count.isdigit() and 1 <= int(number) <= int(count)):
        raise ParameterError("--shard", rule, part)
    return list(jobs[int(number) - 1 :: int(count)])


def work_off(
    jobs: Sequence[Job],
    place: JobSet,
    tell: Tell,
    *,
    changed: bool = False,
    make: Make = making.make,
    progress: Report | None = None,
    sleep: Callable[[float], None] = time.sleep,
) -> Outcome:
    """Make all jobs that are not done, and wait for those that other processes make.

    Parameters
    ----------
    changed : make those anew whose rows have changed.

    Raises
    ------
    DiskFullError : there is no room; what is done stays done.
    """
    outcome, waiting = Outcome(), in_order(jobs, place)
    while waiting:
        elsewhere: list[Job] = []
        for number, job in enumerate(waiting):
            told = do_job(job, place, changed=changed, make=make, progress=progress)
            if told.how is How.ELSEWHERE:
                elsewhere.append(job)
                continue
            outcome.note(told)
            tell(job, told, [*elsewhere, *waiting[number + 1 :]])
        if len(elsewhere) == len(waiting):
            sleep(PAUSE)
        waiting = elsewhere
    return outcome
