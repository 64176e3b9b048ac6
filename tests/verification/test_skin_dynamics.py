"""The skin's motion and rest against closed forms, conservation laws, each other, and finer meshes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from risorius.errors import ParameterError, SolverError
from risorius.physics import mesh
from risorius.physics.equilibrium import EquilibriumSolver, equilibrium
from risorius.physics.implicit import ImplicitSolver
from risorius.physics.muscles import LinearMuscle
from risorius.physics.rk2 import Rk2Solver, highest_frequency, stable_step
from risorius.physics.skin import Skin, State
from risorius.physics.springs import SpringNetwork
from risorius.physics.tissue import tissue

SOLVERS = [Rk2Solver, ImplicitSolver]


def dome(count: int = 8, size: float = 0.08) -> tuple[Any, Any]:
    """A shallow cap of quads."""
    x, y = np.meshgrid(np.linspace(-0.5, 0.5, count + 1), np.linspace(-0.5, 0.5, count + 1))
    vertices = size * np.stack([x.ravel(), y.ravel(), 0.4 * (1 - 2 * x**2 - 2 * y**2).ravel()], axis=1)
    corner = (np.arange(count)[:, None] * (count + 1) + np.arange(count)).ravel()
    return vertices, np.stack([corner, corner + 1, corner + count + 2, corner + count + 1], axis=1)


def head(shared: Path, name: str) -> tuple[Any, list[Any]]:
    """A head's vertices and polygons."""
    data = np.load(shared / "heads" / f"{name}.npz")
    starts = np.cumsum(data["face_sizes"]) - data["face_sizes"]
    polygons = [data["loops"][a : a + n] for a, n in zip(starts, data["face_sizes"], strict=True)]
    return data["vertices"].astype(float), polygons


def subdivided(vertices: Any, polygons: Any) -> tuple[Any, list[list[int]]]:
    """Every triangle and quad cut in four, without moving the surface; the old vertices come first."""
    edges = mesh.unique_edges(polygons)
    middle = {tuple(edge): len(vertices) + k for k, edge in enumerate(edges.tolist())}
    centre = len(vertices) + len(edges)
    extra, finer = [], []
    for polygon in polygons:
        corners = [int(i) for i in polygon]
        sides = [middle[min(a, b), max(a, b)] for a, b in zip(corners, corners[1:] + corners[:1], strict=True)]
        if len(corners) == 3:
            finer.append(sides)
            finer += [[corners[k], sides[k], sides[k - 1]] for k in range(3)]
        else:
            extra.append(vertices[corners].mean(axis=0))
            finer += [[corners[k], sides[k], centre, sides[k - 1]] for k in range(4)]
            centre += 1
    return np.concatenate([vertices, vertices[edges].mean(axis=1), np.reshape(extra, (-1, 3))]), finer


def node(stiffness: float, mass: float, damping: float) -> Skin:
    """One node on an anchor: the damped harmonic oscillator."""
    none = np.empty(0)
    springs = SpringNetwork(1, none.astype(int), none.astype(int), none, none, none, none)
    one = np.ones(1)
    return Skin(np.zeros((1, 3)), springs, mass * one, stiffness * one, None, damping * one)


def smooth_load(vertices: Any, polygons: Any, *, millimetres: float = 10.0) -> Any:
    """A pull over 2 cm around the foremost point, in N per area times each node's area."""
    distance = ((vertices - vertices[np.argmin(vertices[:, 1])]) ** 2).sum(axis=1)
    density = np.exp(-distance / 0.02**2)[:, None] * np.array([0.5, -0.3, 1.0])
    density *= tissue().anchor_per_area * millimetres * 1e-3
    return density * mesh.vertex_areas(vertices, polygons)[:, None]


# ---- closed forms ---------------------------------------------------------------------------------------------


def oscillator(t: float, stiffness: float, mass: float, damping: float) -> float:
    """Released from 1 at rest, underdamped."""
    decay = damping / (2 * mass)
    omega = np.sqrt(stiffness / mass - decay**2)
    return float(np.exp(-decay * t) * (np.cos(omega * t) + decay / omega * np.sin(omega * t)))


@pytest.mark.parametrize(("solver", "order", "coarsest"), [(Rk2Solver, 2, 200), (ImplicitSolver, 2, 200)])
def test_order_of_convergence_on_a_damped_oscillator(solver: Any, order: int, coarsest: int) -> None:
    stiffness, mass, damping, end = 40.0, 0.1, 0.5, 1.0
    skin, errors = node(stiffness, mass, damping), []
    for count in (coarsest, 2 * coarsest):
        options = {"substeps": 1} if solver is Rk2Solver else {"tolerance": 1e-14}
        integrator, state = solver(skin, end / count, **options), State.at_rest(np.array([[1.0, 0.0, -2.0]]))
        for _ in range(count):
            state = integrator.step(state)
        exact = oscillator(end, stiffness, mass, damping) * np.array([[1.0, 0.0, -2.0]])
        errors.append(np.abs(state.positions - exact).max())
    ratios = np.log2(np.divide(errors[:-1], errors[1:]))
    assert ratios == pytest.approx(order, abs=0.05)


@pytest.mark.parametrize("solver", SOLVERS)
def test_constant_force_comes_to_rest_where_the_anchor_balances_it(solver: Any) -> None:
    options = {"tolerance": 1e-9} if solver is ImplicitSolver else {}
    integrator, state = solver(node(50.0, 0.1, 4.0), 0.01, **options), State.at_rest(np.zeros((1, 3)))
    for _ in range(300):
        state = integrator.step(state, np.array([[1.0, 2.0, 0.0]]))
    assert state.positions[0] == pytest.approx([0.02, 0.04, 0.0], abs=1e-7)


@pytest.mark.parametrize(("law", "extra"), [("continuous", 3.0), ("printed", 3.0)])
def test_two_nodes_pulled_apart_balance_in_closed_form(law: str, extra: float) -> None:
    """A spring past its threshold between two anchored nodes: k u + T(2u) = f on each side."""
    low, anchor, rest, limit = 10.0, 5.0, 0.1, 0.15
    high = (1 + extra) * low
    springs = SpringNetwork(2, [0], [1], [rest], [low], [high], [limit], law)
    skin = Skin(np.array([[0.0, 0, 0], [rest, 0, 0]]), springs, np.ones(2), np.full(2, anchor), None, np.zeros(2))
    u = 0.02
    tension = low * limit * rest + high * (2 * u - limit * rest) if law == "continuous" else high * 2 * u
    force = (anchor * u + tension) * np.array([[-1.0, 0, 0], [1, 0, 0]])
    found = equilibrium(skin, force, tolerance=1e-9)
    assert found[:, 0] == pytest.approx([-u, rest + u], abs=1e-8)


def test_a_load_in_proportion_to_the_bed_moves_the_skin_as_one() -> None:
    skin = Skin.from_mesh(*dome(), tissue())
    shift = np.array([0.001, -0.002, 0.003])
    found = equilibrium(skin, skin.anchor[:, None] * shift, tolerance=1e-9)
    assert found - skin.rest == pytest.approx(np.broadcast_to(shift, found.shape), abs=1e-8)


def test_highest_frequency_bounds_the_true_one_closely() -> None:
    for count in (3, 8):
        skin = Skin.from_mesh(*dome(count), tissue())
        scaled = skin.matrix(high=True).toarray() / np.sqrt(np.outer(skin.mass, skin.mass))
        exact = np.sqrt(np.linalg.eigvalsh(scaled).max())
        assert exact <= highest_frequency(skin) < 1.02 * exact


@pytest.mark.parametrize(("frequency", "damping"), [(100.0, 1.0), (100.0, 20.0), (100.0, 500.0)])
def test_stable_step_is_stable_and_not_much_too_short(frequency: float, damping: float) -> None:
    roots = np.roots([1.0, damping, frequency**2])

    def growth(h: float) -> float:
        return float(np.abs(1 + h * roots + (h * roots) ** 2 / 2).max())

    step = stable_step(frequency, (damping, damping))
    assert growth(step) <= 1 + 1e-12
    assert growth(1.2 * step) > 1 + 1e-4


# ---- conservation ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("solver", "law"), [(Rk2Solver, "continuous"), (Rk2Solver, "printed"), (ImplicitSolver, "continuous")]
)
@pytest.mark.parametrize("bending", [0.0, None])
def test_energy_never_grows_without_forces(solver: Any, law: str, bending: float | None) -> None:
    vertices, quads = dome(5)
    skin = Skin.from_mesh(vertices, quads, tissue(), law=law, bending=bending)
    start = vertices + 0.003 * np.random.default_rng(0).normal(size=vertices.shape)
    tight = {"tolerance": 1e-10} if solver is ImplicitSolver else {}
    integrator, state = solver(skin, 0.002, **tight), State.at_rest(start)
    energies = [skin.energy(start)]
    for _ in range(60):
        state = integrator.step(state)
        energies.append(skin.energy(state.positions) + skin.kinetic_energy(state.velocities))
    assert (np.diff(energies) <= 1e-9 * energies[0]).all()
    assert energies[-1] < 0.05 * energies[0]


@pytest.mark.parametrize("solver", SOLVERS)
def test_momentum_is_conserved_without_anchors(solver: Any) -> None:
    vertices, quads = dome(5)
    skin = Skin.from_mesh(vertices, quads, tissue(), anchor=0.0, damping=0.0)
    rng = np.random.default_rng(1)
    state = State(vertices + 0.001 * rng.normal(size=vertices.shape), 0.1 * rng.normal(size=vertices.shape))
    momentum = skin.mass @ state.velocities
    integrator = solver(skin, 0.0005, **({"tolerance": 1e-11} if solver is ImplicitSolver else {}))
    for _ in range(20):
        state = integrator.step(state)
    scale = np.abs(skin.mass @ np.abs(state.velocities)).max()
    assert skin.mass @ state.velocities == pytest.approx(momentum, abs=1e-6 * scale)


def test_midpoint_conserves_angular_momentum_of_the_paper_skin() -> None:
    vertices, quads = dome(5)
    skin = Skin.from_mesh(vertices, quads, tissue(), anchor=0.0, bending=0.0, damping=0.0)
    spin = np.cross([0.0, 0.0, 5.0], vertices)
    state = State(vertices, spin + 0.01 * np.random.default_rng(2).normal(size=vertices.shape))

    def angular(state: State) -> Any:
        return (skin.mass[:, None] * np.cross(state.positions, state.velocities)).sum(axis=0)

    before, integrator = angular(state), Rk2Solver(skin, 0.005)
    for _ in range(20):
        state = integrator.step(state)
    assert np.linalg.norm(state.positions - vertices, axis=1).max() > 0.01
    assert angular(state) == pytest.approx(before, abs=1e-3 * np.linalg.norm(before))


@pytest.mark.parametrize("solver", SOLVERS)
def test_skin_at_rest_stays_at_rest(solver: Any) -> None:
    vertices, quads = dome(5)
    state = solver(Skin.from_mesh(vertices, quads, tissue()), 0.01).step(State.at_rest(vertices))
    assert state.positions == pytest.approx(vertices, abs=1e-15)


# ---- the solvers against each other ---------------------------------------------------------------------------


@pytest.mark.parametrize("bending", [0.0, pytest.param(None, marks=pytest.mark.slow)])
def test_implicit_agrees_with_fine_rk2_on_a_face_within_a_percent(shared: Path, bending: float | None) -> None:
    vertices, polygons = head(shared, "mediapipe")
    skin, load = Skin.from_mesh(vertices, polygons, tissue(), bending=bending), smooth_load(vertices, polygons)
    frames, frame, fine, coarse = 3, 0.04, 20, 4

    def run(integrator: Any, substeps: int, late: float) -> Any:
        state, shapes = State.at_rest(vertices), []
        for k in range(frames * substeps):
            rise = np.sin(np.pi / 2 * min((k + late) / (frames * substeps), 1.0)) ** 2
            state = integrator.step(state, rise * load)
            shapes.append(state.positions)
        return np.array(shapes[substeps - 1 :: substeps])

    reference = run(Rk2Solver(skin, frame / fine), fine, 0.5)
    implicit = run(ImplicitSolver(skin, frame / coarse), coarse, 0.5)
    moved = np.linalg.norm(reference - vertices, axis=2).max()
    assert moved > 0.003
    assert np.linalg.norm(implicit - reference, axis=2).max() < 0.01 * moved


def test_implicit_converges_in_second_order_to_fine_rk2_on_a_small_sheet() -> None:
    """The paper's midpoint rule at 15 kHz is the reference; 1 % of the motion at two steps a frame the goal.

    A sheet of 81 nodes that bends, stretches past its threshold and swings, under a load that rises while the bone
    turns beneath, for four frames at 60 a second. Halving the step must take three quarters of the error away.
    """
    vertices, quads = dome()
    skin, load = Skin.from_mesh(vertices, quads, tissue()), smooth_load(vertices, quads, millimetres=60.0)
    frames, frame, hinge = 4, 1.0 / 60.0, np.array([0.0, 0.05, 0.0])

    def run(solver: Any, substeps: int) -> Any:
        integrator, state, shapes = solver(skin, frame / substeps), State.at_rest(vertices), []
        for k in range(frames * substeps):
            share = np.sin(np.pi / 2 * (k + 0.5) / (frames * substeps)) ** 2
            c, s = np.cos(0.2 * share), np.sin(0.2 * share)
            bone = hinge + (vertices - hinge) @ np.array([[1.0, 0, 0], [0, c, -s], [0, s, c]])
            state = integrator.step(state, share * load, bone)
            shapes.append(state.positions)
        return np.array(shapes[substeps - 1 :: substeps])

    paper = run(Rk2Solver, 256)
    stretch = np.linalg.norm(skin.springs.incidence @ paper[-1], axis=1) / skin.springs.rest_length - 1.0
    assert (stretch > skin.springs.threshold).any()
    motion = np.linalg.norm(paper - vertices, axis=2).max()
    assert motion > 0.01
    coarse, medium, fine, finest = (
        np.linalg.norm(run(ImplicitSolver, n) - paper, axis=2).max() / motion for n in (1, 2, 4, 8)
    )
    assert medium < 0.01
    assert medium < 0.35 * coarse
    assert fine < 0.35 * medium
    assert finest < 0.35 * fine


def test_motion_settles_in_the_equilibrium(shared: Path) -> None:
    vertices, polygons = head(shared, "mediapipe")
    skin, load = Skin.from_mesh(vertices, polygons, tissue()), smooth_load(vertices, polygons)
    integrator, state = ImplicitSolver(skin, 0.04), State.at_rest(vertices)
    for _ in range(40):
        state = integrator.step(state, load)
    assert np.linalg.norm(state.positions - equilibrium(skin, load), axis=1).max() < 5e-5


@pytest.mark.slow
def test_a_muscle_of_equation_9_moves_skin_alike_in_both(shared: Path) -> None:
    vertices, polygons = head(shared, "mediapipe")
    skin = Skin.from_mesh(vertices, polygons, tissue())
    corner = vertices[np.argmin(vertices[:, 1])]
    muscle = LinearMuscle(corner + np.array([0.03, 0.02, 0.03]), corner, radius=0.07, angle=0.7, exponent=1.0)
    size = tissue().anchor_per_area * 0.01 * mesh.vertex_areas(vertices, polygons)[:, None]

    def pull(positions: Any) -> Any:
        return size * muscle.force(positions)

    a, b = State.at_rest(vertices), State.at_rest(vertices)
    paper, production = Rk2Solver(skin, 0.01), ImplicitSolver(skin, 0.01 / 8)
    for _ in range(6):
        a = paper.step(a, pull)
        for _ in range(8):
            b = production.step(b, pull)
    moved = np.linalg.norm(a.positions - vertices, axis=1).max()
    assert moved > 0.001
    assert np.linalg.norm(a.positions - b.positions, axis=1).max() < 0.01 * moved


# ---- equilibrium ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["mediapipe", pytest.param("ict_narrow", marks=pytest.mark.slow)])
def test_equilibrium_balances_every_force(shared: Path, name: str) -> None:
    vertices, polygons = head(shared, name)
    skin, load = Skin.from_mesh(vertices, polygons, tissue()), smooth_load(vertices, polygons, millimetres=20)
    found = EquilibriumSolver(skin, tolerance=1e-8).solve(load)
    strain = np.linalg.norm(skin.springs.incidence @ found.positions, axis=1) / skin.springs.rest_length - 1
    assert (strain > skin.springs.threshold).any()
    assert np.abs(skin.force(found.positions) + load).max() < 1e-3 * np.abs(load).max()
    assert found.residual <= 1e-8


@pytest.mark.parametrize("name", ["mediapipe", pytest.param("ict_narrow", marks=pytest.mark.slow)])
def test_two_densities_of_one_face_agree(shared: Path, name: str) -> None:
    """The same load per area on a face and on its subdivision."""
    vertices, polygons = head(shared, name)
    shapes = []
    for v, p in ((vertices, polygons), subdivided(vertices, polygons)):
        shapes.append(equilibrium(Skin.from_mesh(v, p, tissue()), smooth_load(v, p), tolerance=1e-5)[: len(vertices)])
    moved = np.linalg.norm(shapes[1] - vertices, axis=1).max()
    assert moved > 0.004
    assert np.linalg.norm(shapes[0] - shapes[1], axis=1).max() < 0.02 * moved


def test_skin_follows_its_bone() -> None:
    vertices, quads = dome()
    skin = Skin.from_mesh(vertices, quads, tissue())
    c, s = np.cos(0.4), np.sin(0.4)
    carried = vertices @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1.0]]) + [0.0, 0.01, 0.0]
    zero = np.zeros_like(vertices)
    assert equilibrium(skin, zero, anchors=carried) == pytest.approx(carried, abs=1e-9)
    assert equilibrium(skin, zero, anchors=carried, start=vertices) == pytest.approx(carried, abs=1e-5)
    integrator, state = ImplicitSolver(skin, 0.04), State.at_rest(vertices)
    for _ in range(30):
        state = integrator.step(state, anchors=carried)
    assert state.positions == pytest.approx(carried, abs=5e-5)


# ---- refusals -------------------------------------------------------------------------------------------------


def test_rk2_refuses_more_substeps_than_its_limit() -> None:
    skin = Skin.from_mesh(*dome(), tissue())
    with pytest.raises(SolverError, match="implicit"):
        Rk2Solver(skin, 0.04, substep_limit=10)
    with pytest.raises(SolverError, match="unstable"):
        Rk2Solver(skin, 0.04, substeps=2)


def test_an_equilibrium_that_is_not_reached_says_so() -> None:
    skin = Skin.from_mesh(*dome(), tissue())
    load = np.zeros_like(skin.rest)
    load[40] = [0.0, 0.0, 0.5]
    with pytest.raises(SolverError) as caught:
        equilibrium(skin, load, max_iterations=2, tolerance=1e-12)
    assert caught.value.residual is not None
    assert caught.value.residual > 1e-12


def test_skin_without_anchor_has_no_equilibrium() -> None:
    with pytest.raises(SolverError, match="anchor"):
        EquilibriumSolver(Skin.from_mesh(*dome(), tissue(), anchor=0.0))


@pytest.mark.parametrize("solver", SOLVERS)
def test_bad_loads_are_named(solver: Any) -> None:
    vertices, quads = dome(4)
    integrator = solver(Skin.from_mesh(vertices, quads, tissue(), bending=0.0), 0.001)
    with pytest.raises(ParameterError, match="force"):
        integrator.step(State.at_rest(vertices), np.full_like(vertices, np.nan))
    with pytest.raises(ParameterError, match="force"):
        integrator.step(State.at_rest(vertices), np.zeros((2, 3)))
    with pytest.raises(ParameterError, match="step"):
        solver(integrator.skin, 0.0)


def test_where_the_search_ends_early_a_residual_that_nobody_sees_is_enough() -> None:
    """A tolerance beyond double precision cannot be met."""
    skin = Skin.from_mesh(*dome(), tissue())
    load = np.zeros_like(skin.rest)
    load[len(load) // 2] = 0.0, 0.0, 0.02
    with pytest.raises(SolverError, match="no equilibrium"):
        EquilibriumSolver(skin, tolerance=1e-22).solve(load)
    near = EquilibriumSolver(skin, tolerance=1e-22, unseen=1e-9).solve(load)
    exact = EquilibriumSolver(skin, tolerance=1e-10).solve(load)
    np.testing.assert_allclose(near.positions, exact.positions, atol=1e-8)
    with pytest.raises(SolverError, match="no equilibrium"):
        EquilibriumSolver(skin, tolerance=1e-22, unseen=1e-9, max_iterations=2).solve(load)


def test_forces_beyond_all_numbers_have_no_equilibrium_that_nobody_sees() -> None:
    """A residual that is no number is not below one that is unseen."""
    skin = Skin.from_mesh(*dome(), tissue())
    load = 1e308 * np.sign(np.random.default_rng(1).normal(size=skin.rest.shape))
    with np.errstate(all="ignore"), pytest.raises(SolverError, match="no equilibrium"):
        EquilibriumSolver(skin, unseen=1e-3).solve(load)
