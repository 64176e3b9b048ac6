"""A job is done whole or not at all, never lost, never twice; what is there is known again."""

from __future__ import annotations

import errno
import json
import os
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import IO

import pytest
import risorius.batch.claims as claims
import risorius.batch.doing as doing
import risorius.batch.place as places
from risorius.batch.claims import Claim, claimed
from risorius.batch.doing import DiskFullError, How, do_job
from risorius.batch.jobs import Job
from risorius.batch.manifest import write_manifest
from risorius.batch.place import JobSet, State
from risorius.batch.records import RECORD
from risorius.batch.running import Outcome, in_order, shard
from risorius.errors import ModelError, ParameterError
from risorius.progress import Work

from .plain import MadePlainly, fill_disk, jobs_of, make_plainly

Run = Callable[..., Outcome]


def ids(told: list[doing.Told]) -> list[str]:
    """Names of jobs."""
    return [each.id for each in told]


def test_jobs_are_made_once_and_kept_after(tmp_path: Path, place: JobSet, work: Run) -> None:
    jobs = jobs_of(tmp_path)
    first = work(jobs, place)
    assert ids(first.made) == [job.id for job in jobs]
    second = work(jobs, place)
    assert ids(second.kept) == [job.id for job in jobs]
    assert not second.made
    assert sorted(path.name for path in place.folder.iterdir()) == [".risorius", *sorted(job.id for job in jobs)]


def test_nothing_is_left_over(tmp_path: Path, place: JobSet, work: Run) -> None:
    work(jobs_of(tmp_path), place)
    left = [path for path in (place.folder / ".risorius").rglob("*") if path.is_file()]
    assert left == []
    assert place.left() == set()


def test_the_record_says_what_was_made_and_of_what(tmp_path: Path, place: JobSet, work: Run) -> None:
    (job, *_) = jobs_of(tmp_path)
    work([job], place)
    record = json.loads((place.place_of(job) / RECORD).read_text())
    film = place.place_of(job) / "clip.fap"
    assert record["files"]["clip.fap"]["bytes"] == film.stat().st_size
    assert record["row"] == job.said()
    assert set(record["versions"]) >= {"risorius", "blender", "python", "numpy", "scipy", "platform"}


@pytest.mark.parametrize("harm", ["change", "cut", "remove", "record"])
def test_what_is_damaged_is_put_aside_and_made_again(tmp_path: Path, place: JobSet, work: Run, harm: str) -> None:
    jobs = jobs_of(tmp_path, 2)
    work(jobs, place)
    film = place.place_of(jobs[0]) / "clip.fap"
    good = film.read_bytes()
    (film.parent / "mine.txt").write_text("mine")
    if harm == "remove":
        film.unlink()
    elif harm == "record":
        (film.parent / RECORD).write_text("{")
    else:
        film.write_bytes(good[:-1] if harm == "cut" else b"?" + good[1:])
    outcome = work(jobs, place)
    assert ids(outcome.made) == [jobs[0].id]
    assert "was damaged" in outcome.made[0].remarks[0]
    assert film.read_bytes() == good
    assert (place.folder / ".risorius" / "aside" / "c0~1" / "mine.txt").read_text() == "mine"


def test_a_row_that_has_changed_does_not_replace_what_it_was(tmp_path: Path, place: JobSet, work: Run) -> None:
    jobs = jobs_of(tmp_path)
    work(jobs, place)
    before = (place.place_of(jobs[0]) / "clip.fap").read_bytes()
    outcome = work(jobs_of(tmp_path, extra=",5"), place)
    assert len(outcome.failed) == len(jobs)
    assert "was made from another row: give this row another id" in outcome.failed[0].why
    assert (place.place_of(jobs[0]) / "clip.fap").read_bytes() == before


def test_a_folder_of_the_users_is_left_alone(tmp_path: Path, place: JobSet, work: Run) -> None:
    jobs = jobs_of(tmp_path, 2)
    place.place_of(jobs[0]).mkdir()
    (place.place_of(jobs[0]) / "mine.txt").write_text("mine")
    outcome = work(jobs, place)
    assert ids(outcome.made) == [jobs[1].id]
    assert "is no clip of this set" in outcome.failed[0].why
    assert [path.name for path in place.place_of(jobs[0]).iterdir()] == ["mine.txt"]


@pytest.mark.parametrize("error", [ModelError("no nose"), ValueError("odd"), MemoryError(), RuntimeError("Blender")])
def test_a_job_that_fails_is_told_and_the_others_are_made(
    tmp_path: Path, place: JobSet, work: Run, error: Exception
) -> None:
    jobs = jobs_of(tmp_path, 3)

    def make(job: Job, folder: Path, scratch: Path) -> Work[MadePlainly]:
        if job.id == "c1":
            (folder / "clip.fap").write_text("half")
            raise error
        return (yield from make_plainly(job, folder, scratch))

    outcome = work(jobs, place, make)
    assert ids(outcome.made) == ["c0", "c2"]
    assert str(error) in outcome.failed[0].why
    assert place.failure_of(jobs[1]).is_file()
    assert place.state(jobs[1])[0] is State.MISSING
    assert ids(work(jobs, place).made) == ["c1"]
    assert not place.failure_of(jobs[1]).exists()


@pytest.mark.parametrize("name", ["still.png", "film.mp4", "clip.glb", "clip.blend"])
def test_a_file_that_is_cut_off_is_not_taken_for_done(tmp_path: Path, place: JobSet, work: Run, name: str) -> None:
    whole = {
        "still.png": b"\x89PNG\r\n\x1a\n" + b"x" * 50 + b"IEND\xaeB`\x82",
        "film.mp4": b"\0\0\0\x08free" + b"\0\0\0\x10mdat12345678" + b"\0\0\0\x08moov",
        "clip.glb": b"glTF\2\0\0\0\x14\0\0\0" + b"x" * 8,
        "clip.blend": b"BLENDER-v405" + b"x" * 50 + b"ENDB" + b"\0" * 20,
    }[name]

    def make(data: bytes) -> Callable[..., Work[MadePlainly]]:
        def write(job: Job, folder: Path, scratch: Path) -> Work[MadePlainly]:
            yield from ()
            (folder / name).write_bytes(data)
            return MadePlainly({"any": name})

        return write

    for cut in (0, 4, len(whole) // 2, len(whole) - 25 if name == "clip.blend" else len(whole) - 1):
        outcome = work(jobs_of(tmp_path, 1), place, make(whole[:cut]))
        assert "was not written to its end" in outcome.failed[0].why
    assert work(jobs_of(tmp_path, 1), place, make(whole)).made


def test_an_output_that_was_not_written_is_told(tmp_path: Path, place: JobSet, work: Run) -> None:
    def make(job: Job, folder: Path, scratch: Path) -> Work[MadePlainly]:
        yield from ()
        return MadePlainly({"film": "film.mp4"})

    assert "film.mp4 was not written" in work(jobs_of(tmp_path, 1), place, make).failed[0].why


@pytest.mark.parametrize("code", [errno.ENOSPC, errno.EDQUOT])
@pytest.mark.parametrize("call", range(12))
def test_a_full_disk_at_any_write_ends_the_batch_and_loses_nothing(
    tmp_path: Path, place: JobSet, work: Run, monkeypatch: pytest.MonkeyPatch, call: int, code: int
) -> None:
    jobs = jobs_of(tmp_path, 3)
    work(jobs[:1], place)
    before = (place.place_of(jobs[0]) / "clip.fap").read_bytes()
    with monkeypatch.context() as patch:
        fill_disk(patch, place, call, code)
        with pytest.raises(DiskFullError, match="the disk is full: free some room"):
            work(jobs, place)
    states = [place.state(job)[0] for job in jobs]
    assert set(states) <= {State.DONE, State.MISSING}
    assert place.left() == set()
    assert (place.place_of(jobs[0]) / "clip.fap").read_bytes() == before
    assert len(work(jobs, place).made) == states.count(State.MISSING)


def test_a_disk_that_is_full_without_a_word_is_found_by_looking(
    tmp_path: Path, place: JobSet, work: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    def make(job: Job, folder: Path, scratch: Path) -> Work[MadePlainly]:
        yield from ()
        raise ModelError("Blender wrote nothing")

    assert work(jobs_of(tmp_path, 1), place, make).failed
    usage = shutil.disk_usage(tmp_path)
    monkeypatch.setattr(shutil, "disk_usage", lambda path: usage._replace(free=4096))
    with pytest.raises(DiskFullError):
        work(jobs_of(tmp_path, 1), place, make)


def test_a_job_in_work_is_left_to_whoever_makes_it(tmp_path: Path, place: JobSet) -> None:
    (job,) = jobs_of(tmp_path, 1)
    with place.claim(job) as claim:
        assert claim is Claim.HELD
        assert do_job(job, place, make=make_plainly).how is How.ELSEWHERE
    assert do_job(job, place, make=make_plainly).how is How.MADE


def test_a_claim_is_free_again_after_its_block_whatever_happens(tmp_path: Path) -> None:
    lock = tmp_path / "a.lock"
    with pytest.raises(ValueError, match="odd"), claimed(lock):
        raise ValueError("odd")
    assert not lock.exists()
    with claimed(lock) as first, claimed(lock) as second:
        assert (first, second) == (Claim.HELD, Claim.TAKEN)


def test_a_claim_that_was_given_up_meanwhile_is_not_taken_for_held(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its last owner removes the file between our opening it and locking it: the lock would be one on nothing."""
    lock, usual, given_up = tmp_path / "a.lock", claims._lock, list[bool]()

    def remove_first(file: IO[bytes]) -> None:
        if not given_up:
            given_up.append(True)
            lock.unlink()
        usual(file)

    monkeypatch.setattr(claims, "_lock", remove_first)
    with claimed(lock) as first:
        assert first is Claim.HELD
        with claimed(lock) as second:
            assert second is Claim.TAKEN


def test_without_locks_two_processes_still_give_one_result(
    tmp_path: Path, place: JobSet, monkeypatch: pytest.MonkeyPatch
) -> None:
    def no_locks(file: object) -> None:
        raise OSError(errno.ENOLCK, "no locks")

    monkeypatch.setattr("risorius.batch.claims._lock", no_locks)
    (job,) = jobs_of(tmp_path, 1)

    def slowly(job: Job, folder: Path, scratch: Path) -> Work[MadePlainly]:
        made = yield from make_plainly(job, folder, scratch)
        assert do_job(job, place, make=make_plainly).how is How.MADE  # the other process, meanwhile
        return made

    told = do_job(job, place, make=slowly)
    assert told.how is How.MADE
    assert "another process" in told.remarks[0]
    assert place.state(job)[0] is State.DONE
    assert place.left() == set()


def test_what_a_killed_process_leaves_is_removed_and_its_job_comes_last(
    tmp_path: Path, place: JobSet, work: Run
) -> None:
    jobs = jobs_of(tmp_path, 3)
    (place.folder / ".risorius" / "unfinished" / "c0~abc").mkdir()
    (place.folder / ".risorius" / "unfinished" / "c0~abc" / "half").write_text("half")
    assert [job.id for job in in_order(jobs, place)] == ["c1", "c2", "c0"]
    assert ids(work(jobs, place).made) == ["c1", "c2", "c0"]
    assert place.left() == set()


def test_a_job_that_is_cancelled_leaves_nothing(tmp_path: Path, place: JobSet) -> None:
    def stop(step: object) -> None:
        raise KeyboardInterrupt

    (job,) = jobs_of(tmp_path, 1)
    with pytest.raises(KeyboardInterrupt):
        do_job(job, place, make=make_plainly, progress=stop)
    assert place.state(job)[0] is State.MISSING
    assert place.left() == set()
    assert do_job(job, place, make=make_plainly).how is How.MADE


def test_the_manifest_lists_what_is_done(tmp_path: Path, place: JobSet, work: Run) -> None:
    jobs = jobs_of(tmp_path, 3)
    work(jobs[:2], place)
    lines = [json.loads(line) for line in write_manifest(jobs, place).read_text().splitlines()]
    assert [line["folder"] for line in lines] == ["c0", "c1"]
    assert lines[0]["files"]["clip.fap"]["sha256"]


def test_parts_are_all_jobs_and_no_job_twice(tmp_path: Path) -> None:
    jobs = jobs_of(tmp_path, 7)
    parts = [shard(jobs, f"{number}/3") for number in (1, 2, 3)]
    assert sorted(job.id for part in parts for job in part) == sorted(job.id for job in jobs)
    for wrong in ("0/3", "4/3", "1", "a/b", "1/0", "-1/3"):
        with pytest.raises(ParameterError, match="--shard must be PART/PARTS"):
            shard(jobs, wrong)


def test_places_are_written_through_before_they_get_their_name(
    tmp_path: Path, place: JobSet, work: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    steps: list[str] = []
    sync, rename = os.fsync, os.rename
    monkeypatch.setattr(places.os, "fsync", lambda handle: (steps.append("fsync"), sync(handle))[1])
    monkeypatch.setattr(places.os, "rename", lambda a, b: (steps.append("rename"), rename(a, b))[1])
    work(jobs_of(tmp_path, 1), place)
    assert steps == ["fsync", "fsync", "fsync", "rename", "fsync"]  # stream, record, their folder; then the set's


def test_the_manifest_of_a_set_keeps_what_another_table_made_there(tmp_path: Path, place: JobSet, work: Run) -> None:
    jobs = jobs_of(tmp_path, 4)
    work(jobs, place)
    path = write_manifest(jobs[2:], place)
    assert [json.loads(line)["id"] for line in path.read_text().splitlines()] == ["c2", "c3", "c0", "c1"]
    path = write_manifest(jobs[2:], place, "manifest.2-of-2.jsonl")
    assert [json.loads(line)["id"] for line in path.read_text().splitlines()] == ["c2", "c3"]
