"""A set of clips, and jobs worked off without Blender."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import pytest
from risorius.batch.doing import Told
from risorius.batch.jobs import Job
from risorius.batch.place import JobSet
from risorius.batch.running import Outcome, work_off

from .plain import make_plainly


@pytest.fixture
def place(tmp_path: Path) -> JobSet:
    """An empty set."""
    made = JobSet(tmp_path / "set")
    made.prepare()
    return made


@pytest.fixture
def work() -> Callable[..., Outcome]:
    """Work off jobs, by `make_plainly` where nothing else is said."""

    def run(jobs: Sequence[Job], place: JobSet, make: object = make_plainly, *, changed: bool = False) -> Outcome:
        def tell(job: Job, told: Told, left: Sequence[Job]) -> None:
            pass

        return work_off(jobs, place, tell, changed=changed, make=make, sleep=lambda seconds: None)

    return run
