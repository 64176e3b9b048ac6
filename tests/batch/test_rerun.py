"""A clip whose row has changed is made anew where that is asked for; the old one stays until the new one is there."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from risorius.batch.doing import DiskFullError
from risorius.batch.jobs import Job
from risorius.batch.manifest import write_manifest
from risorius.batch.place import JobSet, State
from risorius.batch.running import Outcome
from risorius.cli import main
from risorius.errors import ModelError
from risorius.progress import Work

from .plain import MadePlainly, fill_disk, jobs_of, make_plainly

Run = Callable[..., Outcome]


def left_in(place: JobSet, room: str) -> list[str]:
    """Names of what is in one of the set's own folders."""
    folder = place.folder / ".risorius" / room
    return sorted(path.name for path in folder.iterdir()) if folder.exists() else []


def test_changed_rows_are_made_anew_and_others_kept(tmp_path: Path, place: JobSet, work: Run) -> None:
    work(jobs_of(tmp_path, 2), place)
    jobs = [jobs_of(tmp_path, 2)[0], jobs_of(tmp_path, 2, extra=",5")[1]]
    outcome = work(jobs, place, changed=True)
    assert ([told.id for told in outcome.kept], [told.id for told in outcome.made]) == (["c0"], ["c1"])
    assert outcome.made[0].remarks == ("its row has changed (yaw)",)
    assert "yaw" in (place.place_of(jobs[1]) / "clip.fap").read_text()
    assert left_in(place, "replaced") == left_in(place, "aside") == []
    assert len(work(jobs, place, changed=True).kept) == 2


def test_a_file_that_has_changed_is_a_change_of_its_row(tmp_path: Path, place: JobSet, work: Run) -> None:
    table, head = tmp_path / "jobs.csv", tmp_path / "head.obj"

    def jobs() -> list[Job]:
        from risorius.batch.table import read_jobs

        table.write_text("id,emotion,head,outputs\na,joy,head.obj,fap\n")
        return list(read_jobs(table).jobs)

    head.write_text("v 0 0 0\n")
    work(jobs(), place)
    head.write_text("v 0 0 1 \n")
    assert work(jobs(), place).failed
    assert work(jobs(), place, changed=True).made[0].remarks == ("its row has changed (head)",)


def test_the_manifest_tells_what_was_there_before(tmp_path: Path, place: JobSet, work: Run) -> None:
    for extra in ("", ",5", ",9"):
        jobs = jobs_of(tmp_path, 1, extra=extra)
        work(jobs, place, changed=True)
    (line,) = write_manifest(jobs, place).read_text().splitlines()
    record = json.loads(line)
    assert record["row"]["yaw"] == 9
    assert [each["row"].get("yaw") for each in record["before"]] == [None, 5]
    assert all(each["files"]["clip.fap"]["sha256"] and "before" not in each for each in record["before"])


def test_the_old_clip_stays_where_the_new_one_fails(tmp_path: Path, place: JobSet, work: Run) -> None:
    jobs = jobs_of(tmp_path, 1)
    work(jobs, place)
    before = (place.place_of(jobs[0]) / "clip.fap").read_bytes()

    def fail(job: Job, folder: Path, scratch: Path) -> Work[MadePlainly]:
        yield from ()
        assert (place.place_of(job) / "clip.fap").read_bytes() == before
        raise ModelError("no nose")

    assert "no nose" in work(jobs_of(tmp_path, 1, extra=",5"), place, fail, changed=True).failed[0].why
    assert work(jobs, place).kept
    assert left_in(place, "replaced") == left_in(place, "unfinished") == []


@pytest.mark.parametrize("harm", ["changed", "added"])
def test_an_old_clip_that_somebody_has_changed_is_kept_aside(
    tmp_path: Path, place: JobSet, work: Run, harm: str
) -> None:
    jobs = jobs_of(tmp_path, 1)
    work(jobs, place)
    mine = place.place_of(jobs[0]) / ("clip.fap" if harm == "changed" else "mine.txt")
    mine.write_text("mine")
    outcome = work(jobs_of(tmp_path, 1, extra=",5"), place, changed=True)
    assert harm in outcome.made[0].remarks[0]
    assert (place.folder / ".risorius" / "aside" / "c0~1" / mine.name).read_text() == "mine"


@pytest.mark.parametrize("call", range(12))
def test_a_full_disk_at_any_write_leaves_the_old_clip_or_the_new_one(
    tmp_path: Path, place: JobSet, work: Run, monkeypatch: pytest.MonkeyPatch, call: int
) -> None:
    old, new = jobs_of(tmp_path, 1), jobs_of(tmp_path, 1, extra=",5")
    work(old, place)
    with monkeypatch.context() as patch:
        is_full = fill_disk(patch, place, call, lasts=False)  # room enough to put back what was moved
        try:
            work(new, place, changed=True)
        except DiskFullError:
            assert is_full()
    assert State.DONE in (place.state(old[0])[0], place.state(new[0])[0])
    outcome = work(new, place, changed=True)
    assert outcome.made or outcome.kept
    assert left_in(place, "replaced") == left_in(place, "unfinished") == []


def test_what_a_killed_process_moved_away_comes_back(tmp_path: Path, place: JobSet, work: Run) -> None:
    jobs = jobs_of(tmp_path, 1)
    work(jobs, place)
    moved = place.folder / ".risorius" / "replaced" / "c0~abc"
    moved.parent.mkdir()
    place.place_of(jobs[0]).rename(moved)
    assert work(jobs, place).kept
    assert left_in(place, "replaced") == []


def test_the_command_counts_the_rows_that_have_changed(
    tmp_path: Path, place: JobSet, work: Run, capsys: pytest.CaptureFixture[str]
) -> None:
    work(jobs_of(tmp_path, 3), place)
    changed = jobs_of(tmp_path, 3, extra=",5")
    command = ["batch", str(tmp_path / "jobs.csv"), "--out", str(place.folder), "--dry-run"]
    assert main(command) == 1
    assert "would fail: c0" in capsys.readouterr().out
    assert main([*command, "--rerun-changed"]) == 0
    said = capsys.readouterr().out
    assert "3 would be made" in said
    assert "would be made anew: c2: made from another row" in said
    assert {place.state(job)[0] for job in changed} == {State.OTHER}


def test_without_being_asked_for_nothing_is_replaced(tmp_path: Path, place: JobSet, work: Run) -> None:
    work(jobs_of(tmp_path, 1), place)
    outcome = work(jobs_of(tmp_path, 1, extra=",5"), place, make_plainly)
    assert "or make the clip anew with --rerun-changed" in outcome.failed[0].why
    assert work(jobs_of(tmp_path, 1), place).kept
