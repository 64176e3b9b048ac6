"""Processes that are killed at any moment, a disk that is really full, two processes at one folder."""

from __future__ import annotations

import json
import multiprocessing
import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from multiprocessing.process import BaseProcess
from pathlib import Path

import pytest
from risorius.batch.doing import DiskFullError, Told
from risorius.batch.jobs import Job
from risorius.batch.place import JobSet, State
from risorius.batch.records import damage, read_record
from risorius.batch.running import work_off
from risorius.progress import Progress, Work

from .plain import MadePlainly, jobs_of

pytestmark = [pytest.mark.slow, pytest.mark.skipif(sys.platform == "win32", reason="signals as Unix has them")]

FORK = multiprocessing.get_context("fork") if sys.platform != "win32" else None


def make_slowly(job: Job, folder: Path, scratch: Path) -> Work[MadePlainly]:
    """A file written in small steps."""
    for part in range(3):
        with (folder / "clip.fap").open("a") as file:
            file.write(f"{job.id} {part}\n")
        time.sleep(0.01)
        yield Progress(part / 3, "Making")
    return MadePlainly({"fap": "clip.fap"})


def work(jobs: list[Job], place: JobSet, log: Path, deadly: int, changed: bool) -> None:
    """Work off jobs; the call number `deadly` of the system that changes a file kills the process."""
    calls = [0]

    def counted(usual: Callable[..., object]) -> Callable[..., object]:
        def call(*arguments: object, **options: object) -> object:
            calls[0] += 1
            if calls[0] == deadly:
                os.kill(os.getpid(), signal.SIGKILL)
            return usual(*arguments, **options)

        return call

    def tell(job: Job, told: Told, left: object) -> None:
        with log.open("a") as file:
            file.write(f"{told.how.name} {job.id}\n")

    place.prepare()
    for name in ("rename", "fsync", "mkdir", "unlink", "rmdir", "open"):
        setattr(os, name, counted(getattr(os, name)))
    pause = lambda seconds: time.sleep(0.05)  # noqa: E731
    work_off(jobs, place, tell, changed=changed, make=make_slowly, sleep=pause)  # type: ignore[arg-type]


def start(jobs: list[Job], place: JobSet, log: Path, deadly: int = 0, *, changed: bool = False) -> BaseProcess:
    """A process that works off jobs."""
    assert FORK is not None
    process = FORK.Process(target=work, args=(jobs, place, log, deadly, changed))
    process.start()
    return process


def ended(process: BaseProcess) -> int:
    """How a process ended."""
    process.join(60)
    assert process.exitcode is not None
    return process.exitcode


def damage_of(folder: Path) -> str | None:
    """What is not as a folder's record says."""
    record = read_record(folder)
    assert record is not None
    return damage(folder, record)


def refuse_halves(place: JobSet, count: int) -> None:
    """Every folder that has its name is whole."""
    for number in range(count):
        folder = place.folder / f"c{number}"
        if folder.exists():
            assert (folder / "clip.fap").read_text() == "".join(f"c{number} {part}\n" for part in range(3))
            assert json.loads((folder / "job.json").read_text())["id"] == f"c{number}"


def test_killed_at_every_call_that_changes_a_file_it_goes_on(tmp_path: Path) -> None:
    jobs, place, log = jobs_of(tmp_path, 3), JobSet(tmp_path / "set"), tmp_path / "log"
    deadly = 1
    while (code := ended(start(jobs, place, log, deadly))) != 0:
        assert code == -signal.SIGKILL
        refuse_halves(place, 3)
        if all(place.state(job)[0] is State.DONE for job in jobs):
            shutil.rmtree(place.folder)
        deadly += 1
    assert deadly > 8
    assert all(place.state(job)[0] is State.DONE for job in jobs)
    assert place.left() == set()


def test_killed_while_it_replaces_a_clip_there_is_the_old_one_or_the_new_one(tmp_path: Path) -> None:
    place, log, deadly = JobSet(tmp_path / "set"), tmp_path / "log", 1
    (old,), (new,) = jobs_of(tmp_path, 1), jobs_of(tmp_path, 1, extra=",5")
    assert ended(start([old], place, log)) == 0
    while ended(start([new], place, log, deadly, changed=True)) != 0:
        places = [place.folder / "c0", *(place.folder / ".risorius" / "replaced").glob("c0~*")]
        assert any((folder / "job.json").is_file() and damage_of(folder) is None for folder in places)
        if place.state(new)[0] is State.DONE:
            shutil.rmtree(place.folder)
            assert ended(start([old], place, log)) == 0
        deadly += 1
    assert deadly > 8
    assert place.state(new)[0] is State.DONE
    assert place.left() == set()
    assert not list((place.folder / ".risorius" / "replaced").iterdir())


def test_killed_at_any_time_it_goes_on_and_makes_nothing_twice(tmp_path: Path) -> None:
    jobs, place, log = jobs_of(tmp_path, 12), JobSet(tmp_path / "set"), tmp_path / "log"
    for wait in (0.05, 0.08, 0.11, 0.14, 0.2):
        process = start(jobs, place, log)
        time.sleep(wait)
        process.kill()
        ended(process)
        refuse_halves(place, 12)
    assert ended(start(jobs, place, log)) == 0
    made = [line.split()[1] for line in log.read_text().splitlines() if line.startswith("MADE")]
    assert len(made) == len(set(made))
    assert all(place.state(job)[0] is State.DONE for job in jobs)
    assert place.left() == set()


def test_processes_share_the_jobs_of_one_folder(tmp_path: Path) -> None:
    jobs, place = jobs_of(tmp_path, 20), JobSet(tmp_path / "set")
    logs = [tmp_path / f"log{number}" for number in range(3)]
    processes = [start(jobs, place, log) for log in logs]
    assert [ended(process) for process in processes] == [0, 0, 0]
    made = [line.split()[1] for log in logs for line in log.read_text().splitlines() if line.startswith("MADE")]
    assert sorted(made) == sorted(job.id for job in jobs)
    refuse_halves(place, 20)


def test_the_job_of_a_process_that_dies_is_taken_over_by_one_that_waits(tmp_path: Path) -> None:
    jobs, place, log = jobs_of(tmp_path, 6), JobSet(tmp_path / "set"), tmp_path / "log"
    first, second = start(jobs, place, log), start(jobs, place, log)
    time.sleep(0.1)
    first.kill()
    ended(first)
    assert ended(second) == 0
    assert all(place.state(job)[0] is State.DONE for job in jobs)


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """A disk of two megabytes."""
    folder = tmp_path / "disk"
    folder.mkdir()
    mount = shutil.which("mount")
    command = [str(mount), "-t", "tmpfs", "-o", "size=2m", "tmpfs", str(folder)]
    if mount is None or os.geteuid() != 0 or subprocess.run(command, capture_output=True, check=False).returncode:
        pytest.skip("only root may mount a small disk")
    try:
        yield folder
    finally:
        subprocess.run(["umount", "-l", str(folder)], check=True)


def test_a_disk_that_is_really_full_loses_nothing_and_room_lets_it_go_on(tmp_path: Path, small_disk: Path) -> None:
    def make(job: object, folder: Path, scratch: Path) -> object:
        yield from ()
        (folder / "clip.fap").write_bytes(b"x" * 300_000)
        return MadePlainly({"fap": "clip.fap"})

    jobs = jobs_of(tmp_path, 8)
    place = JobSet(small_disk / "set")
    (small_disk / "ballast").write_bytes(b"x" * 1_000_000)
    place.prepare()
    with pytest.raises(DiskFullError, match="free some room"):
        work_off(jobs, place, lambda job, told, left: None, make=make)  # type: ignore[arg-type]
    states = [place.state(job)[0] for job in jobs]
    assert set(states) == {State.DONE, State.MISSING}
    assert place.left() == set()
    (small_disk / "ballast").unlink()
    shutil.rmtree(place.folder / jobs[0].id)
    with pytest.raises(DiskFullError):
        work_off(jobs, place, lambda job, told, left: None, make=make)  # type: ignore[arg-type]
    more = [place.state(job)[0] for job in jobs]
    assert more.count(State.DONE) > states.count(State.DONE)
