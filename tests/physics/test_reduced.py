"""Skin in a few fields about its moving balance: as the implicit solver moves every node."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from risorius.arrays import Floats
from risorius.errors import ParameterError
from risorius.physics import Factor, ImplicitSolver, Skin, State, tissue
from risorius.physics.reduced import ReducedSkin, principal_fields

STEP, FRAMES = 0.04, 14


@pytest.fixture(scope="module")
def sheet() -> Skin:
    """A flat sheet of 15 by 15 nodes, 6 cm wide."""
    side = np.linspace(-0.03, 0.03, 15)
    x, y = np.meshgrid(side, side, indexing="ij")
    vertices = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)
    corner = np.arange(225).reshape(15, 15)
    quads = np.stack([corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:]], axis=2).reshape(-1, 4)
    return Skin.from_mesh(vertices, quads, tissue())


def pull(skin: Skin) -> Floats:
    """(n, 3) where the balance of the sheet goes, metres: a bump beside its middle, along it and out of it."""
    away = np.linalg.norm(skin.rest - np.array([0.008, 0.004, 0.0]), axis=1)
    return np.exp(-((away / 0.012) ** 2))[:, None] * np.array([0.004, 0.001, 0.002])


def course() -> Floats:
    """(T,) strength of the pull: up in five frames, then held."""
    return np.sin(0.5 * np.pi * np.clip(np.arange(FRAMES) / 5.0, 0.0, 1.0)) ** 2


def node_by_node(skin: Skin, parts: int) -> Floats:
    """(T, n, 3) what the implicit solver makes of it, so many steps a frame."""
    solver, strength = ImplicitSolver(skin, STEP / parts), course()
    state, shown = State.at_rest(skin.rest), [np.zeros_like(skin.rest)]
    for before, after in pairwise(strength):
        for part in range(parts):
            balance = skin.rest + (before + (part + 0.5) / parts * (after - before)) * pull(skin)
            state = solver.step(state, -skin.force(balance))
        shown.append(state.positions - skin.rest)
    return np.array(shown)


def in_fields(skin: Skin, count: int, *, parts: int = 1) -> Floats:
    """(T, n, 3) what the reduced skin makes of it."""
    reduced = ReducedSkin(skin, Factor(skin.matrix()), principal_fields(pull(skin)[None], 1), STEP / parts, count=count)
    passage, strength = reduced.passage(skin.rest), course()
    state, felt = reduced.at_rest(), reduced.read(np.zeros_like(skin.rest))
    shown = [np.zeros_like(skin.rest)]
    for before, after in pairwise(strength):
        for part in range(parts):
            now = reduced.read((before + (part + 1.0) / parts * (after - before)) * pull(skin))
            state, felt = reduced.follow(state, felt, now, passage), now
        shown.append(after * pull(skin) + reduced.displacement(state))
    return np.array(shown)


def off(moving: Floats, reference: Floats) -> float:
    """The largest distance of any node in any frame as a share of the largest motion."""
    return float(np.linalg.norm(moving - reference, axis=2).max() / np.linalg.norm(reference, axis=2).max())


def test_what_some_nodes_feel_is_what_all_feel_of_them(sheet: Skin) -> None:
    """None at all included: lids of one eye may take no skin along."""
    reduced = ReducedSkin(sheet, Factor(sheet.matrix()), pull(sheet)[None], STEP, count=5)
    for nodes in (np.array([3, 77, 130]), np.empty(0, dtype=np.int64)):
        some = np.random.default_rng(1).normal(size=(2, 4, len(nodes), 3))
        every = np.zeros((2, 4, *sheet.rest.shape))
        every[:, :, nodes] = some
        felt = reduced.read(some, nodes)
        assert felt.shape == (2, 4, 2 * len(reduced.fields))
        np.testing.assert_allclose(felt, reduced.read(every), atol=1e-12)


def test_a_few_fields_move_as_all_nodes_do(sheet: Skin) -> None:
    reference = node_by_node(sheet, 16)
    still = off(course()[:, None, None] * pull(sheet), reference)
    assert still > 0.05  # without inertia and damping it is far off
    assert off(in_fields(sheet, 3), reference) < 0.02
    assert off(in_fields(sheet, 31), reference) < 0.008


def test_the_answers_to_answers_count(sheet: Skin) -> None:
    reference = node_by_node(sheet, 16)
    assert off(in_fields(sheet, 31), reference) < 0.7 * off(in_fields(sheet, 3), reference)


def test_a_step_is_exact_whatever_its_length(sheet: Skin) -> None:
    np.testing.assert_allclose(in_fields(sheet, 15, parts=4), in_fields(sheet, 15), atol=1e-10)


def test_a_held_balance_is_reached(sheet: Skin) -> None:
    last = in_fields(sheet, 15)[-1]
    assert np.linalg.norm(last - pull(sheet), axis=1).max() < 0.02 * np.linalg.norm(pull(sheet), axis=1).max()


def test_fields_are_orthonormal_in_mass(sheet: Skin) -> None:
    fields = ReducedSkin(sheet, Factor(sheet.matrix()), pull(sheet)[None], STEP, count=15).fields
    product = np.einsum("inc,n,jnc->ij", fields, sheet.mass, fields)
    np.testing.assert_allclose(product, np.eye(len(fields)), atol=1e-6)


def test_stiffness_is_the_change_of_force(sheet: Skin) -> None:
    reduced = ReducedSkin(sheet, Factor(sheet.matrix()), pull(sheet)[None], STEP, count=3)
    at = sheet.rest + 0.5 * pull(sheet)
    way = 1e-7 / np.abs(reduced.fields).max()
    change = [(sheet.force(at - way * f) - sheet.force(at + way * f)).ravel() / (2 * way) for f in reduced.fields]
    expected = reduced.fields.reshape(len(change), -1) @ np.array(change).T
    np.testing.assert_allclose(reduced.stiffness(at), expected, rtol=1e-4, atol=1e-4 * np.abs(expected).max())


def test_stiffness_never_drives_the_skin_away(sheet: Skin) -> None:
    reduced = ReducedSkin(sheet, Factor(sheet.matrix()), pull(sheet)[None], STEP, count=15)
    crushed = sheet.rest * np.array([0.3, 0.3, 1.0])
    assert np.linalg.eigvalsh(reduced.stiffness(crushed)).min() > -1e-6


def test_refuses_a_step_of_nothing_and_fields_of_another_skin(sheet: Skin) -> None:
    factor = Factor(sheet.matrix())
    with pytest.raises(ParameterError, match="step"):
        ReducedSkin(sheet, factor, pull(sheet)[None], 0.0, count=3)
    with pytest.raises(ParameterError, match="balances"):
        ReducedSkin(sheet, factor, pull(sheet)[None, 1:], STEP, count=3)
