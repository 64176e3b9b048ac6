"""Jobs on the workers of a Dask cluster: each once, whole, whatever becomes of the workers."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from risorius.batch.doing import DiskFullError, Told
from risorius.batch.jobs import Job
from risorius.batch.place import JobSet, State
from risorius.errors import RisoriusError

from .plain import jobs_of

pytest.importorskip("distributed")
from risorius.batch.cluster import Cluster, SchedulerLostError, connected, work_on

pytestmark = pytest.mark.slow


@pytest.fixture
def client() -> Iterator[Any]:
    """Two workers of this computer."""
    with connected(Cluster(processes=2, memory=2**30)) as found:
        yield found


def slow_task() -> Any:
    """A task that goes to workers as it is: it makes a stream in some time, without Blender."""

    def task(job: Job, folder: str) -> Told:
        import time
        from types import SimpleNamespace

        from risorius.batch.doing import do_job
        from risorius.batch.place import JobSet
        from risorius.progress import Progress

        def make(job: Any, folder: Any, scratch: Any) -> Any:
            for part in range(4):
                with (folder / "clip.fap").open("a") as file:
                    file.write(f"{job.id} {part}\n")
                time.sleep(0.1)
                yield Progress(part / 4, "Making")
            return SimpleNamespace(files={"fap": "clip.fap"}, frames=1, remarks=(), contents={}, blender="none")

        return do_job(job, JobSet(folder), make=make)

    return task


def test_each_job_is_made_once(tmp_path: Path, place: JobSet, client: Any) -> None:
    jobs = jobs_of(tmp_path, 8)
    left: list[int] = []
    outcome = work_on(client, jobs, place, lambda job, told, rest: left.append(len(rest)), task=slow_task())
    assert sorted(told.id for told in outcome.made) == sorted(job.id for job in jobs)
    assert left == list(range(7, -1, -1))
    again = work_on(client, jobs, place, lambda job, told, rest: None, task=slow_task())
    assert len(again.kept) == 8


def test_workers_that_are_killed_lose_nothing(tmp_path: Path, place: JobSet, client: Any) -> None:
    jobs = jobs_of(tmp_path, 10)
    killed: list[int] = []

    def kill_one(job: Job, told: Told, rest: object) -> None:
        if len(killed) < 3:
            pids = list(client.run(os.getpid, on_error="ignore").values())  # of those that live
            os.kill(pids[0], signal.SIGKILL)
            killed.append(pids[0])

    outcome = work_on(client, jobs, place, kill_one, task=slow_task())
    assert len(killed) == 3
    assert not outcome.failed
    assert sorted(told.id for told in (*outcome.made, *outcome.kept)) == sorted(job.id for job in jobs)
    for job in jobs:
        assert place.state(job)[0] is State.DONE
        lines = (place.place_of(job) / "clip.fap").read_text().splitlines()
        assert lines == [f"{job.id} {part}" for part in range(4)]
    assert place.left() == set()


def test_a_job_that_ends_every_worker_is_told_and_the_others_are_made(
    tmp_path: Path, place: JobSet, client: Any
) -> None:
    def task(job: Job, folder: str) -> Told:
        import os

        if job.id == "c1":
            os._exit(1)
        return usual(job, folder)

    usual = slow_task()
    outcome = work_on(client, jobs_of(tmp_path, 3), place, lambda job, told, rest: None, task=task)
    assert [told.id for told in outcome.failed] == ["c1"]
    assert "no worker could make it (KilledWorker" in outcome.failed[0].why
    there = (*outcome.made, *outcome.kept)  # kept: what was told of it was lost with a worker
    assert {told.id for told in there} == {"c0", "c2"}


def test_a_full_disk_on_a_worker_ends_the_work(tmp_path: Path, place: JobSet, client: Any) -> None:
    def task(job: Job, folder: str) -> Told:
        from risorius.batch.doing import DiskFullError

        raise DiskFullError("the disk is full")

    with pytest.raises(DiskFullError, match="the disk is full"):
        work_on(client, jobs_of(tmp_path, 3), place, lambda job, told, rest: None, task=task)


def test_it_can_be_stopped(tmp_path: Path, place: JobSet, client: Any) -> None:
    end = time.monotonic() + 1.5

    def tick() -> None:
        if time.monotonic() > end:
            raise KeyboardInterrupt

    jobs = jobs_of(tmp_path, 40)
    with pytest.raises(KeyboardInterrupt):
        work_on(client, jobs, place, lambda job, told, rest: None, task=slow_task(), tick=tick)
    states = {place.state(job)[0] for job in jobs}
    assert states == {State.DONE, State.MISSING}


@pytest.fixture
def scheduler() -> Iterator[Callable[[], subprocess.Popen[bytes]]]:
    """Starts a scheduler at one address, and a worker beside it, as people do by hand."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = str(free.getsockname()[1])
    started: list[subprocess.Popen[bytes]] = []

    def start() -> subprocess.Popen[bytes]:
        for command in (
            ("dask_scheduler", "--host", "127.0.0.1", "--port", port, "--no-dashboard"),
            ("dask_worker", f"tcp://127.0.0.1:{port}", "--nthreads", "1", "--no-nanny", "--no-dashboard"),
        ):
            words = [sys.executable, "-m", f"distributed.cli.{command[0]}", *command[1:]]
            started.append(subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL))
        return started[-2]

    start.address = f"tcp://127.0.0.1:{port}"  # type: ignore[attr-defined]
    try:
        yield start
    finally:
        for process in started:
            process.kill()
            process.wait()


@pytest.mark.parametrize("comes_back", [False, True])
def test_a_scheduler_that_is_lost_ends_the_work_unless_it_comes_back(
    tmp_path: Path, place: JobSet, scheduler: Any, monkeypatch: pytest.MonkeyPatch, comes_back: bool
) -> None:
    jobs, heard, first = jobs_of(tmp_path, 6), list[str](), list[str]()
    process = scheduler()

    def end_it(job: Job, told: Told, left: object) -> None:
        if not first:
            process.kill()
            process.wait()
            if comes_back:
                scheduler()
        first.append(told.id)

    with connected(Cluster(scheduler.address)) as client, monkeypatch.context() as hurried:
        if comes_back:
            work_on(client, jobs, place, end_it, task=slow_task(), say=heard.append)
        else:
            hurried.setattr("risorius.batch.cluster.PATIENCE", 2)
            with pytest.raises(SchedulerLostError, match="the Dask scheduler has gone: what is made is kept; start"):
                work_on(client, jobs, place, end_it, task=slow_task(), say=heard.append)
    if comes_back:
        assert heard[-1] == "the Dask scheduler has lost its tasks: they are given to it again"
    else:
        assert heard == ["the Dask scheduler does not answer: waiting for it, 2 s at most"]
        scheduler()
        with connected(Cluster(scheduler.address)) as client:
            work_on(client, jobs, place, lambda job, told, left: None, task=slow_task())
    assert {place.state(job)[0] for job in jobs} == {State.DONE}


def test_no_scheduler_is_told(tmp_path: Path) -> None:
    with pytest.raises(RisoriusError, match="no Dask scheduler answers at"), connected(Cluster("tcp://127.0.0.1:9")):
        pass
