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
from dataclasses import dataclass
from functools import lru_cache, partial
from typing import Any

from ..errors import RisoriusError
from .doing import DiskFullError, How, Told, do_job
from .jobs import Job
from .making import ready_blender
from .place import JobSet
from .running import Outcome, Tell, in_order

MISSING = "needs Dask: pip install risorius[batch]"
#: Bytes that one worker needs for Blender, a head and a film.
MEMORY = 3 * 2**30
#: Tasks that a worker knows of: enough that none waits, few enough that a lost worker loses little.
AHEAD = 2
#: Seconds until a job is tried again that is in work elsewhere, and between two looks at all.
PAUSE, LOOK = 2.0, 0.5


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
            with Client(cluster.address, timeout="20s") as client:
                yield client
        except (OSError, ValueError) as error:
            problem = f"no Dask scheduler answers at {cluster.address}: check the address"
            raise RisoriusError(f"{problem} ({error})") from error
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
    task: Callable[[Job, str], Told] | None = None,
) -> Outcome:
    """Make all jobs that are not done on the workers of a client.

    Parameters
    ----------
    changed : make those anew whose rows have changed.
    tick : called every second; what it raises ends the work.
    task : what a worker runs; by default `made_by_worker`.

    Raises
    ------
    DiskFullError : there is no room; what is done stays done.
    """
    from distributed import wait

    run, folder = partial(made_by_worker, changed=changed) if task is None else task, str(place.folder.resolve())
    outcome, waiting = Outcome(), deque(in_order(jobs, place))
    asleep: list[tuple[float, Job]] = []
    going: dict[Any, Job] = {}
    try:
        while waiting or going or asleep:
            tick()
            now = time.monotonic()
            waiting.extend(job for wakes, job in asleep if wakes <= now)
            asleep = [(wakes, job) for wakes, job in asleep if wakes > now]
            room = AHEAD * max(sum(client.nthreads().values()), 1)
            while waiting and len(going) < room:
                job = waiting.popleft()
                going[client.submit(run, job, folder, pure=False, key=f"{job.id}-{secrets.token_hex(4)}")] = job
            if not going:
                time.sleep(LOOK)
                continue
            with contextlib.suppress(TimeoutError):
                wait(list(going), timeout=LOOK, return_when="FIRST_COMPLETED")
            for future in [each for each in going if each.done()]:
                job = going.pop(future)
                told = _told(future, job, place)
                if told.how is How.ELSEWHERE:
                    asleep.append((time.monotonic() + PAUSE, job))
                    continue
                outcome.note(told)
                tell(job, told, [*waiting, *going.values(), *(job for _, job in asleep)])
    finally:
        client.cancel(list(going))
    return outcome


def _told(future: Any, job: Job, place: JobSet) -> Told:
    """What became of a job on a worker."""
    error = future.exception()
    if error is None:
        result: Told = future.result()
        return result
    if isinstance(error, DiskFullError):
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
