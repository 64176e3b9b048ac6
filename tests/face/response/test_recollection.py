"""What springs add is recalled from balances found before, as far as that can be trusted."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import risorius.api as api
from risorius.face.response.recollection import KEPT, Recollection
from risorius.physics.equilibrium import EquilibriumSolver

#: Nodes and muscles of a made-up skin.
NODES, MUSCLES = 20, 3


def added(amounts: Any) -> Any:
    """(n, 3) metres that made-up springs add for amounts (k,) in metres: nothing without a pull."""
    ways = np.random.default_rng(1).normal(size=(MUSCLES, NODES, 3))
    return 1e-3 * np.tensordot((amounts / 0.02) ** 2, ways, axes=1)


def learn(known: Recollection, amounts: Any, off: float = 0.0) -> None:
    """Let a recollection find the made-up springs, which add as much on the sheet, for amounts (k,)."""
    known.learn(amounts, added(amounts) + off, added(amounts))


def taught(*shares: float) -> Recollection:
    """A recollection of the made-up springs along one way."""
    known = Recollection()
    for share in shares:
        learn(known, share * np.array([0.01, 0.005, 0.0]))
    return known


def test_what_is_known_is_recalled_without_a_doubt() -> None:
    known, amounts = taught(0.3, 0.6, 1.0), 0.6 * np.array([0.01, 0.005, 0.0])
    foretold, doubt = known.foretold(amounts)
    assert doubt < 1e-6
    assert np.allclose(foretold, added(amounts), atol=1e-7)


def test_what_is_between_is_foretold_within_its_doubt() -> None:
    known, amounts = taught(0.2, 0.4, 0.6, 0.8, 1.0), 0.7 * np.array([0.01, 0.005, 0.0])
    foretold, doubt = known.foretold(amounts)
    assert np.linalg.norm(foretold - added(amounts), axis=1).max() <= doubt < 1e-4


def test_another_way_is_doubtful() -> None:
    known = taught(0.2, 0.4, 0.6, 0.8, 1.0)
    assert known.foretold(np.array([0.007, 0.0035, 0.008]))[1] > 10 * known.foretold(np.array([0.007, 0.0035, 0.0]))[1]


def test_nothing_is_foretold_before_anything_is_known() -> None:
    foretold, doubt = Recollection().foretold(np.array([0.01, 0.0, 0.0]))
    assert np.all(foretold == 0.0)
    assert doubt > 1e-3


def test_a_surprise_makes_it_wary() -> None:
    known, beside = taught(0.2, 0.4, 0.6, 0.8, 1.0), np.array([0.012, 0.006, 0.0])
    before = known.foretold(beside)[1]
    learn(known, np.array([0.009, 0.006, 0.0]), off=0.01)
    assert known.foretold(beside)[1] > before


def test_it_keeps_no_more_than_so_many() -> None:
    known, random = Recollection(), np.random.default_rng(2)
    for _ in range(KEPT + 5):
        learn(known, 0.02 * random.random(MUSCLES))
    assert len(known._added) == len(known._amounts) - 1 == KEPT


def test_a_search_begins_where_the_others_foretell() -> None:
    known, amounts = taught(0.2, 0.4, 0.6, 0.8, 1.0), 0.7 * np.array([0.01, 0.005, 0.0])
    assert np.linalg.norm(known.on_sheet(amounts) - added(amounts), axis=1).max() < 1e-4
    assert np.all(Recollection().on_sheet(amounts) == 0.0)


@pytest.mark.slow
def test_a_drag_there_and_back_is_near_the_poses_and_solved_less_and_less(monkeypatch: pytest.MonkeyPatch) -> None:
    solves, solve = list[int](), EquilibriumSolver.solve

    def counted(self: EquilibriumSolver, *force: Any, **options: Any) -> Any:
        found = solve(self, *force, **options)
        solves.append(found.iterations)
        return found

    monkeypatch.setattr(EquilibriumSolver, "solve", counted)
    face = api.default_face()
    sketcher = face.sketcher()
    words = [api.expression("surprise", activation=level) for level in np.linspace(1.0, 7.0, 13)]
    there = [sketcher.sketch(word.frame(), emotion=word.weights).positions for word in words]
    assert len(solves) <= 9
    assert sum(solves) <= 14  # 17 where each begins at the balance found last
    solves.clear()
    back = [sketcher.sketch(word.frame(), emotion=word.weights).positions for word in words[::-1]][::-1]
    assert len(solves) <= 1
    for word, once, again in zip(words, there, back, strict=True):
        pose = face.pose(word.frame(), emotion=word.weights).positions
        assert max(np.linalg.norm(shown - pose, axis=1).max() for shown in (once, again)) < 1e-4
