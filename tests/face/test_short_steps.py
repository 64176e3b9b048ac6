"""Long work on a face comes in short steps: what takes time is done once between two of them, and in parts."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from risorius import api
from risorius.face.mesh import openings, points, sewn, weld
from risorius.face.response import followers, rooted
from risorius.face.response.sheet import AT_ONCE, ElasticSheet
from risorius.face.skin import coarse
from risorius.progress import Work, run

#: What takes long on a dense mesh, each in one call.
LONG = [
    (openings, "dijkstra"), (sewn, "dijkstra"), (rooted, "dijkstra"), (points, "own_lips"), (weld, "_places"),
    (followers, "_ties"), (ElasticSheet, "relax"), (ElasticSheet, "point_responses"),
]  # fmt: skip


class Spy:
    """Notes what is called between two steps of a work."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.now: list[str] = []
        self.steps: list[list[str]] = []
        for owner, name in LONG:
            called = f"{getattr(owner, '__name__', owner)}.{name}"
            monkeypatch.setattr(owner, name, self._noting(called, getattr(owner, name)))

    def _noting(self, name: str, call: Callable[..., Any]) -> Callable[..., Any]:
        def noted(*arguments: Any, **options: Any) -> Any:
            self.now.append(name)
            return call(*arguments, **options)

        return noted

    def drive(self, work: Work[Any]) -> Any:
        """Drive a work to its end; every step's calls are noted."""

        def next_step(_: object) -> None:
            self.steps.append(self.now)
            self.now = []

        result = run(work, next_step)
        next_step(None)
        return result


@pytest.mark.slow
def test_no_step_does_two_things_that_take_long(monkeypatch: pytest.MonkeyPatch) -> None:
    spy = Spy(monkeypatch)
    head = api.build_default_head()
    face = spy.drive(api.Face.from_arrays_steps(head.vertices, head.polygons, head.points))
    spy.drive(face.prepare())
    assert {name for step in spy.steps for name in step} >= {
        "risorius.face.mesh.openings.dijkstra", "ElasticSheet.relax", "risorius.face.response.followers._ties",
    }  # fmt: skip
    assert [step for step in spy.steps if len(step) > 1] == []


@pytest.mark.slow
def test_so_many_fields_are_solved_in_a_step(monkeypatch: pytest.MonkeyPatch) -> None:
    solved = list[int]()
    relax = ElasticSheet.relax

    def noted(sheet: ElasticSheet, forces: Any) -> Any:
        solved.append(len(forces))
        return relax(sheet, forces)

    monkeypatch.setattr(ElasticSheet, "relax", noted)
    head = api.build_default_head()
    run(api.Face.from_arrays(head.vertices, head.polygons, head.points).prepare())
    assert len(solved) > 1
    assert max(solved) == AT_ONCE


def test_vertices_are_compared_in_parts(monkeypatch: pytest.MonkeyPatch) -> None:
    positions = np.random.default_rng(1).uniform(size=(3000, 3))
    apart, every = np.full(3000, 0.05), np.ones(3000, dtype=bool)
    choice = positions, apart, np.zeros(0, dtype=np.int64), every
    whole = run(coarse._chosen(*choice))
    monkeypatch.setattr(coarse, "COMPARED", 100)
    steps = list[object]()
    assert np.array_equal(run(coarse._chosen(*choice), steps.append), whole)
    assert len(steps) >= (3000 - coarse.FIRST_BATCH) / 100
    distances = np.linalg.norm(positions[whole][:, None] - positions[whole], axis=2)
    assert distances[~np.eye(len(whole), dtype=bool)].min() >= 0.05


@pytest.mark.slow
def test_paths_are_searched_from_fewer_places_at_once_among_more(monkeypatch: pytest.MonkeyPatch) -> None:
    searched = list[int]()
    search = rooted.dijkstra

    def noted(lengths: Any, *, indices: Any, **options: Any) -> Any:
        searched.append(len(indices) * lengths.shape[0])
        return search(lengths, indices=indices, **options)

    head = api.build_default_head()
    usual = api.Face.from_arrays(head.vertices, head.polygons, head.points).anatomy.rooted_parts
    monkeypatch.setattr(rooted, "dijkstra", noted)
    monkeypatch.setattr(rooted, "FIGURES", 50_000)
    parts = api.Face.from_arrays(head.vertices, head.polygons, head.points).anatomy.rooted_parts
    assert max(searched) <= 50_000
    moved, again = (np.random.default_rng(2).normal(size=(1, *head.vertices.shape)) for _ in range(2))
    usual.follow(moved)
    parts.follow(again)
    assert np.array_equal(moved, again)
