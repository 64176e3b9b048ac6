"""The jobs of a set on the workers of a Dask cluster: one job a task.

A worker makes its jobs in one thread of its own process, into which it has loaded Blender. When a worker is lost, Dask
gives its job to another. The folder of the set must be one that all workers see.

Not in Blender's zip: Dask opens connections, and Blender's own Python has no Dask.
"""

from __future__ import annotations

import contextlib
import os
import secrets
import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import lru_cache, partial
from typing import Any

from ..errors import RisoriusError
from .doing import How, StoppedError, Told, do_job
from .jobs import Job
from .making import ready_blender
from .place import JobSet
from .running import Outcome, Tell, in_order

MISSING = "Dask is missing: pip install risorius[batch]"
#: Bytes that one worker needs for Blender, a head and a film.
MEMORY = 3 * 2**30
#: Tasks that a worker knows of: enough that none waits, few enough that a lost worker loses little.
AHEAD = 2
#: Seconds until a job is tried again that is in work elsewhere, and between two looks at all.
PAUSE, LOOK = 2.0, 0.5
#: Seconds in which a scheduler must answer, at first and when it was lost.
PATIENCE = 20


class SchedulerLostError(StoppedError):
    """The scheduler has ended, or cannot be reached any more; what its workers have made is there."""


@dataclass(frozen=True)
class Cluster:
    """Where the workers are.

    Attributes
    ----------
    address : of a scheduler, as tcp://10.0.0.1:8786; None: a cluster of this computer's own.
    processes : workers of such a cluster.
    memory : bytes that each of them may use before Dask ends it.
    """

    address: str | None = None
    processes: int = 2
    memory: int = MEMORY


@contextlib.contextmanager
def connected(cluster: Cluster) -> Iterator[Any]:
    """A client of a cluster.

    Raises
    ------
    RisoriusError : there is no Dask here, or no scheduler there.
    """
    try:
        from distributed import Client, LocalCluster
    except ModuleNotFoundError:
        raise RisoriusError(f"--dask and --processes {MISSING}") from None
    if cluster.address is not None:
        try:
            found = Client(cluster.address, timeout=f"{PATIENCE}s")
        except (OSError, ValueError) as error:
            problem = f"no Dask scheduler answers at {cluster.address}: check the address"
            raise RisoriusError(f"{problem} ({error})") from error
        with found as client:
            yield client
        return
    local = LocalCluster(
        n_workers=cluster.processes,
        threads_per_worker=1,
        processes=True,
        memory_limit=cluster.memory,
        dashboard_address=None,
    )
    with local, Client(local) as client:
        yield client


def work_on(
    client: Any,
    jobs: Sequence[Job],
    place: JobSet,
    tell: Tell,
    *,
    changed: bool = False,
    tick: Callable[[], None] = lambda: None,
    say: Callable[[str], None] = lambda text: None,
    task: Callable[[Job, str], Told] | None = None,
) -> Outcome:
    """Make all jobs that are not done on the workers of a client.

    Parameters
    ----------
    changed : make those anew whose rows have changed.
    tick : called every second; what it raises ends the work.
    say : called with what people should know meanwhile.
    task : what a worker runs; by default `made_by_worker`.

    Raises
    ------
    StoppedError : there is no room, or no scheduler any more; what is done stays done.
    """
    run, folder = partial(made_by_worker, changed=changed) if task is None else task, str(place.folder.resolve())
    outcome, tasks = Outcome(), _Tasks(client, lambda job: (run, job, folder), deque(in_order(jobs, place)))
    try:
        while tasks.left():
            tick()
            try:
                ended = tasks.ended()
            except Exception as error:
                if client.status == "running" and not isinstance(error, _cancelled()):
                    raise
                tasks.take_back()
                _wait_for_scheduler(client, tick, say)
                continue
            for future in ended:
                job = tasks.going.pop(future)
                told = _told(future, job, place)
                if told.how is How.ELSEWHERE:
                    tasks.try_later(job)
                    continue
                outcome.note(told)
                tell(job, told, tasks.left())
    finally:
        if client.status == "running":
            client.cancel(list(tasks.going))
    return outcome


@dataclass
class _Tasks:
    """The jobs that are left: not given to the scheduler, given, and those in work elsewhere with when to try again."""

    client: Any
    call: Callable[[Job], tuple[Any, ...]]
    waiting: deque[Job]
    going: dict[Any, Job] = field(default_factory=dict)
    asleep: list[tuple[float, Job]] = field(default_factory=list)

    def left(self) -> list[Job]:
        """All of them."""
        return [*self.waiting, *self.going.values(), *(job for _, job in self.asleep)]

    def try_later(self, job: Job) -> None:
        """Another process is at a job."""
        self.asleep.append((time.monotonic() + PAUSE, job))

    def take_back(self) -> None:
        """The scheduler has forgotten what it was given."""
        self.waiting.extendleft(reversed(self.going.values()))
        self.going.clear()

    def ended(self) -> list[Any]:
        """Give the scheduler as many jobs as its workers can take, wait a moment, and say which have ended.

        Raises
        ------
        Exception : of many kinds, where the scheduler is lost.
        """
        from distributed import wait

        now = time.monotonic()
        self.waiting.extend(job for wakes, job in self.asleep if wakes <= now)
        self.asleep = [(wakes, job) for wakes, job in self.asleep if wakes > now]
        room = AHEAD * max(sum(self.client.nthreads().values()), 1)
        while self.waiting and len(self.going) < room:
            job = self.waiting[0]
            key = f"{job.id}-{secrets.token_hex(4)}"
            self.going[self.client.submit(*self.call(job), pure=False, key=key)] = job
            self.waiting.popleft()
        if not self.going:
            time.sleep(LOOK)
            return []
        with contextlib.suppress(TimeoutError):
            wait(list(self.going), timeout=LOOK, return_when="FIRST_COMPLETED")
        if any(future.cancelled() for future in self.going):
            raise _cancelled()("the scheduler has forgotten a job")
        return [future for future in self.going if future.done()]


def _cancelled() -> type[Exception]:
    """What Dask raises of tasks that the scheduler has forgotten."""
    from distributed import CancelledError

    found: type[Exception] = CancelledError
    return found


def _wait_for_scheduler(client: Any, tick: Callable[[], None], say: Callable[[str], None]) -> None:
    """Wait while the client tries to find its scheduler again.

    Raises
    ------
    SchedulerLostError : it is gone.
    """
    if client.status == "connecting":
        say(f"the Dask scheduler does not answer: waiting for it, {PATIENCE} s at most")
    while client.status == "connecting":
        tick()
        time.sleep(LOOK)
    if client.status != "running":
        raise SchedulerLostError(
            "the Dask scheduler has gone: what is made is kept; start the scheduler and this again"
        )
    say("the Dask scheduler has lost its tasks: they are given to it again")


def _told(future: Any, job: Job, place: JobSet) -> Told:
    """What became of a job on a worker."""
    error = future.exception()
    if error is None:
        result: Told = future.result()
        return result
    if isinstance(error, StoppedError):
        raise error
    why = f"no worker could make it ({type(error).__name__}: {error}): see the workers' logs"
    place.write_failure(job, why)
    return Told(job.id, How.FAILED, why=why)


def made_by_worker(job: Job, folder: str, *, changed: bool = False) -> Told:
    """What a worker does: make one job in a folder that all see; `changed` : anew where its row has changed.

    Raises
    ------
    RisoriusError : this worker does not see the folder, or has no Blender.
    """
    place = JobSet(folder)
    if not place.is_there():
        raise RisoriusError(f"{folder} is not there on this computer: choose a folder that all workers see")
    _ready(folder)
    return do_job(job, place, changed=changed)


@lru_cache(maxsize=1)
def _ready(folder: str) -> None:
    """Load Blender in this thread, once; what it prints about every frame is nobody's to read."""
    try:
        ready_blender(JobSet(folder).heads)
    except ModuleNotFoundError as missing:
        raise RisoriusError(f"this worker lacks {missing.name}: pip install bpy in its Python") from None
    with open(os.devnull, "wb") as nowhere:
        os.dup2(nowhere.fileno(), 1)
