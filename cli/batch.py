"""The verb batch: many clips and stills from a table."""

from __future__ import annotations

import argparse
import contextlib
import signal
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING

from ..errors import RisoriusError
from ..files import scratch_folder
from ..progress import Progress
from .films import needing_blender, silent_blender
from .options import Verbs, verb
from .result import Result, UsageError

if TYPE_CHECKING:
    from ..batch.doing import Told
    from ..batch.jobs import Job
    from ..batch.place import JobSet
    from ..batch.running import Outcome
    from ..batch.table import JobTable

#: Workers, and GB of memory of each, at most.
MOST_PROCESSES, MOST_MEMORY = 1000, 100_000.0
#: Seconds between two lines about one job.
PATIENCE = 20.0


def add_batch_verb(verbs: Verbs) -> None:
    """Add batch to the verbs."""
    batch = verb(verbs, "batch", _batch)
    about = "a row for each clip or still, .csv or .toml; docs/batch.md lists the columns"
    batch.add_argument("table", type=Path, nargs="?", metavar="TABLE", help=about)
    about = (
        'instead: factors and levels, as a .toml file or a line: "emotion=joy,fear yaw=-30..30 seed=0..999 kind=random '
        'count=100"; the table that it stands for is written to jobs.csv in the folder of the set'
    )
    batch.add_argument("--design", metavar="DESIGN", help=about)
    batch.add_argument("--out", type=Path, required=True, help="the folder of the set; started again, it goes on there")
    about = "only this part of the jobs, as 3/10: for the job arrays of a cluster"
    batch.add_argument("--shard", metavar="PART/PARTS", help=about)
    about = "workers of a Dask cluster on this computer (default: 1, without Dask)"
    batch.add_argument("--processes", type=int, default=1, metavar="N", help=about)
    about = "GB of memory that each of them may use (default: 3)"
    batch.add_argument("--memory", type=float, default=3.0, metavar="GB", help=about)
    about = "instead: the workers of a Dask scheduler, as tcp://10.0.0.1:8786; all must see the folder of the set"
    batch.add_argument("--dask", metavar="ADDRESS", help=about)
    about = "make the clips anew whose rows have changed; without it, such a row fails and its clip stays"
    batch.add_argument("--rerun-changed", action="store_true", help=about)
    batch.add_argument("--dry-run", action="store_true", help="say what would be done, and how long it would take")


def _batch(arguments: argparse.Namespace) -> Result:
    """Make many clips and stills from a table, each whole or not at all; started again, go on where it was."""
    from ..batch.place import JobSet
    from ..batch.running import shard
    from ..batch.table import read_jobs

    if not 1 <= arguments.processes <= MOST_PROCESSES or not 0.0 < arguments.memory <= MOST_MEMORY:
        raise UsageError(f"--processes must be 1 to {MOST_PROCESSES}, --memory above 0 and at most {MOST_MEMORY:.0f}")
    if arguments.dask is not None and arguments.processes != 1:
        raise UsageError("--processes is for this computer alone: leave it out with --dask")
    with _table_of(arguments) as path:
        table = read_jobs(path)
    jobs = list(table.jobs) if arguments.shard is None else shard(table.jobs, arguments.shard)
    place = JobSet(arguments.out)
    for problem in table.problems:
        print(f"skipped: {problem}", file=sys.stderr)
    if arguments.dry_run:
        return _foretold(table, jobs, place, arguments.rerun_changed)
    if not _on_cluster(arguments):
        with needing_blender():
            from ..batch.making import ready_blender

            ready_blender(place.heads)
    place.prepare()
    if arguments.rerun_changed:
        print(_count_changed(jobs, place), file=sys.stderr)
    return _worked_off(arguments, table, jobs, place)


@contextlib.contextmanager
def _table_of(arguments: argparse.Namespace) -> Iterator[Path]:
    """The table: as given, or the one that a design stands for, which a dry run keeps nowhere."""
    from ..batch.design import read_design, write_design

    if (arguments.table is None) == (arguments.design is None):
        raise UsageError("give either a table, or --design")
    if arguments.design is None:
        yield arguments.table
        return
    design = read_design(arguments.design)
    with scratch_folder() as temporary:
        folder = temporary if arguments.dry_run else arguments.out
        folder.mkdir(parents=True, exist_ok=True)
        write_design(design, folder / "jobs.csv")
        yield folder / "jobs.csv"


def _foretold(table: JobTable, jobs: Sequence[Job], place: JobSet, changed: bool) -> Result:
    """What would be done."""
    from ..batch.measures import HEAD, START, Pace, for_people
    from ..batch.place import State

    pace, found = Pace(), {state: list[str]() for state in State}
    for job in jobs:
        state, record, _ = place.state(job, check=False)
        found[state].append(job.id)
        if state is State.DONE and record is not None:
            pace.note(job, record.seconds)
    makes = {State.MISSING, State.DAMAGED, *([State.OTHER] if changed else [])}
    fails = {State.OTHER, State.FOREIGN} - makes
    to_make = [job for job in jobs if job.id in {name for state in makes for name in found[state]}]
    heads = {job.text("head") for job in to_make}
    seconds = pace.left(to_make) + (START + HEAD * len(heads) if to_make else 0.0)
    by = f"as the {len(found[State.DONE])} jobs took that are done" if pace.guessed else "by the manual's figures"
    data = {
        "jobs": len(jobs),
        "bad_rows": [str(problem) for problem in table.problems],
        "heads": len(heads),
        "seconds": seconds,
        **{state.name.lower(): names for state, names in found.items()},
    }
    lines = [
        f"{len(jobs)} jobs on {len(heads)} heads, {len(table.problems)} problems in rows that would be skipped",
        f"{len(found[State.DONE])} are done, {len(to_make)} would be made",
        f"it would take {for_people(seconds)} in one process ({by})",
    ]
    if changed:
        lines += [f"would be made anew: {name}: {State.OTHER.value}" for name in found[State.OTHER]]
    failing = [f"would fail: {name}: {state.value}" for state in State if state in fails for name in found[state]]
    return Result(data, lines + failing, code=int(bool(table.problems or failing)))


def _count_changed(jobs: Sequence[Job], place: JobSet) -> str:
    """How many clips were made from other rows, for people."""
    from ..batch.place import State

    count = sum(place.state(job, check=False)[0] is State.OTHER for job in jobs)
    said = f"{count} of {len(jobs)} rows have changed since their clips were made"
    return f"{said}: these are made anew" if count else said


def _worked_off(arguments: argparse.Namespace, table: JobTable, jobs: Sequence[Job], place: JobSet) -> Result:
    """Make the jobs, and say what became of them."""
    from ..batch.doing import StoppedError
    from ..batch.manifest import NAME, write_manifest

    shown = Shown(len(jobs))
    name = NAME if arguments.shard is None else f"manifest.{arguments.shard.replace('/', '-of-')}.jsonl"
    stopped = ""
    try:
        with silent_blender(), stopped_in_order(shown):
            _make(arguments, jobs, place, shown)
    except StoppedError as error:
        stopped = str(error)
    except KeyboardInterrupt:
        stopped = "stopped: start again to go on"
    with contextlib.suppress(*([RisoriusError] if stopped else [])):  # a full disk has no room for it, either
        write_manifest(jobs, place, name)
    return _told(table, jobs, place, shown.outcome, stopped)


def _on_cluster(arguments: argparse.Namespace) -> bool:
    """Whether workers make the jobs, not this process."""
    return arguments.dask is not None or arguments.processes > 1


def _make(arguments: argparse.Namespace, jobs: Sequence[Job], place: JobSet, shown: Shown) -> None:
    """Make the jobs, here or on workers."""
    from ..batch.running import work_off

    if not _on_cluster(arguments):
        work_off(jobs, place, shown.tell, changed=arguments.rerun_changed, progress=shown.step)
        return
    try:
        from ..batch.cluster import Cluster, connected, work_on
    except ModuleNotFoundError:
        raise RisoriusError(
            "--dask and --processes need Risorius in plain Python: pip install risorius[batch]"
        ) from None
    cluster = Cluster(arguments.dask, arguments.processes, int(arguments.memory * 2**30))
    with connected(cluster) as client:
        shown.pace.processes = arguments.processes if arguments.dask is None else max(len(client.nthreads()), 1)
        work_on(client, jobs, place, shown.tell, changed=arguments.rerun_changed, tick=shown.tick, say=shown.say)


def _told(table: JobTable, jobs: Sequence[Job], place: JobSet, outcome: Outcome, stopped: str) -> Result:
    """What became of all jobs."""
    done = len(outcome.made) + len(outcome.kept)
    failed = {told.id: told.why for told in outcome.failed}
    data = {
        "jobs": len(jobs),
        "made": [told.id for told in outcome.made],
        "kept": [told.id for told in outcome.kept],
        "failed": failed,
        "bad_rows": [str(problem) for problem in table.problems],
        "stopped": stopped,
        "out": place.folder,
    }
    lines = [f"{done} of {len(jobs)} clips are in {place.folder}: {len(outcome.made)} made now"]
    lines += [f"failed: {name}: {why}" for name, why in failed.items()]
    lines += [f"skipped: {problem}" for problem in table.problems]
    lines += [stopped] if stopped else []
    return Result(data, lines, code=int(bool(failed or table.problems or stopped)))


class Shown:
    """Progress of a batch on standard error: a line for each job, and now and then one about a long one."""

    def __init__(self, count: int) -> None:
        """So many jobs are to be done."""
        from ..batch.measures import Pace
        from ..batch.running import Outcome

        self.outcome, self.stop = Outcome(), False
        self.pace = Pace()
        self._count, self._said_at = count, time.monotonic()

    def tell(self, job: Job, told: Told, left: Sequence[Job]) -> None:
        """A job is finished."""
        from ..batch.doing import How
        from ..batch.measures import for_people

        self.outcome.note(told)
        done = self._count - len(left)
        line = f"{100 * done // max(self._count, 1):3d} %  {job.id} {told.how.value}"
        if told.how is How.MADE:
            self.pace.note(job, told.seconds)
            line += f" in {for_people(told.seconds)}"
        line += f" ({done} of {self._count}"
        line += f", about {for_people(self.pace.left(left))} left)" if left else ")"
        self.say(line)
        if told.why:
            self.say(f"       {told.why}")
        for remark in told.remarks:
            self.say(f"       note: {remark}")
        self.tick()

    def step(self, step: Progress) -> None:
        """A job is on its way."""
        self.tick()
        if time.monotonic() - self._said_at >= PATIENCE:
            self.say(f"       {step.text}")

    def tick(self) -> None:
        """End where the user has asked for it."""
        if self.stop:
            raise KeyboardInterrupt

    def say(self, line: str) -> None:
        """Print a line."""
        self._said_at = time.monotonic()
        print(line, file=sys.stderr, flush=True)


@contextlib.contextmanager
def stopped_in_order(shown: Shown) -> Iterator[None]:
    """Ctrl-C and SIGTERM end the batch at the next step of a job, which is left as if it had never begun."""

    def stop(number: int, frame: FrameType | None) -> None:
        if shown.stop:  # twice: at once
            raise KeyboardInterrupt
        shown.stop = True
        print("stopping after this step; once more stops at once", file=sys.stderr, flush=True)

    before = {number: signal.signal(number, stop) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
