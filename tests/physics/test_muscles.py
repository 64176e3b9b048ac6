"""The three muscles against a scalar transcription of the printed equations, node by node with plain `math`."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from risorius.errors import ParameterError
from risorius.physics.muscles import LinearMuscle, SheetMuscle, SphincterMuscle

Vector = tuple[float, float, float]


def minus(a: Any, b: Any) -> Vector:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def dot(a: Any, b: Any) -> float:
    return float(a[0] * b[0] + a[1] * b[1] + a[2] * b[2])


def norm(a: Any) -> float:
    return math.sqrt(dot(a, a))


def theta(lam: float, delta: float, eta: float) -> float:
    """(12) and (20)."""
    if 0 <= lam <= 1:
        return math.cos((1 - lam**eta) * math.pi / 2)
    if lam <= delta:
        return math.cos((lam**eta - 1) / (delta**eta - 1) * math.pi / 2)
    return 0.0


def linear(x: Any, a: Any, i: Any, radius: float, phi: float, eta: float, alpha: float) -> list[float]:
    """(6)-(13)."""
    to_a = minus(a, x)
    length = norm(to_a)
    if length == 0:
        return [0.0] * 3
    whole = norm(minus(a, i))
    phi_ji = math.acos(max(-1.0, min(1.0, dot(to_a, minus(a, i)) / (length * whole))))
    lam, gamma, delta = length / whole, phi_ji / phi, radius / whole
    if gamma > 1:
        return [0.0] * 3
    size = alpha * theta(lam, delta, eta) * math.cos(phi * gamma) * math.cos(gamma * math.pi / 2)
    return [size * c / length for c in to_a]


def sphincter(p: Any, o: Any, u: Any, v: Any, a: float, b: float, alpha: float) -> list[float]:
    """(14)-(17)."""
    out = minus(p, o)
    x, y = dot(out, u), dot(out, v)
    d = math.sqrt(y * y * a * a + x * x * b * b) / (a * b)
    if d > 1 or norm(out) == 0:
        return [0.0] * 3
    return [-alpha * math.cos((1 - d) * math.pi / 2) * c / norm(out) for c in out]


def sheet(p: Any, a1: Any, a2: Any, i1: Any, i2: Any, length: float, eta: float, alpha: float) -> list[float]:
    """(18)-(22) for parallel lines at a right angle to the fibres."""
    ac = tuple((s + t) / 2 for s, t in zip(a1, a2, strict=True))
    ic = tuple((s + t) / 2 for s, t in zip(i1, i2, strict=True))
    fibre = norm(minus(ac, ic))
    m = tuple(c / fibre for c in minus(ac, ic))
    width = norm(minus(a2, a1))
    w = tuple(c / width for c in minus(a2, a1))
    out = minus(p, ac)
    across = dot(out, w)
    distance = math.sqrt(max(0.0, dot(out, out) - across * across))
    if abs(across) > width / 2 or dot(out, m) > 0:
        return [0.0] * 3
    return [alpha * theta(distance / fibre, length / fibre, eta) * c for c in m]


def frame(rng: np.random.Generator) -> Any:
    """A random right-handed orthonormal frame, rows."""
    return np.linalg.qr(rng.normal(size=(3, 3)))[0].T


@pytest.mark.parametrize("seed", range(5))
def test_linear_muscle_is_equations_6_to_13(seed: int) -> None:
    rng = np.random.default_rng(seed)
    a, i = rng.normal(size=(2, 3)) * 0.05
    radius, phi = np.linalg.norm(a - i) * rng.uniform(1.05, 3), rng.uniform(0.2, math.pi / 2)
    eta, alpha = rng.uniform(0.3, 4), rng.uniform(0.1, 3)
    points = np.concatenate([a + rng.normal(size=(400, 3)) * 0.08, np.linspace(a, i, 20), i + 0.02 * frame(rng)])
    force = LinearMuscle(a, i, radius=radius, angle=phi, exponent=eta, scale=alpha).force(points)
    expected = [linear(x, a, i, radius, phi, eta, alpha) for x in points.tolist()]
    assert np.count_nonzero(np.any(expected, axis=1)) > 15
    assert force == pytest.approx(np.array(expected), abs=1e-6)
    assert force[:400] == pytest.approx(np.array(expected)[:400], abs=1e-12)


@pytest.mark.parametrize("seed", range(5))
def test_sphincter_is_equations_14_to_17(seed: int) -> None:
    rng = np.random.default_rng(seed)
    u, v, _ = frame(rng)
    o, a, b, alpha = rng.normal(size=3), rng.uniform(0.02, 0.04), rng.uniform(0.01, 0.02), rng.uniform(0.1, 3)
    points = o + 0.03 * rng.normal(size=(400, 3))
    force = SphincterMuscle(o, u, v, semi_major=a, semi_minor=b, scale=alpha).force(points)
    expected = np.array([sphincter(x, o, u, v, a, b, alpha) for x in points.tolist()])
    assert 20 < np.count_nonzero(expected.any(axis=1)) < 380
    assert force == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("seed", range(5))
def test_sheet_muscle_is_equations_18_to_22(seed: int) -> None:
    rng = np.random.default_rng(seed)
    along, across, _ = frame(rng)
    middle, fibre, width = rng.normal(size=3), rng.uniform(0.02, 0.05), rng.uniform(0.02, 0.05)
    length, eta, alpha = fibre * rng.uniform(1.1, 2.5), rng.uniform(0.3, 4), rng.uniform(0.1, 3)
    line = middle + np.outer([-0.5, 0.5], across) * width
    points = middle - 0.03 * along + 0.03 * rng.normal(size=(400, 3))
    force = SheetMuscle(line, line - fibre * along, length=length, exponent=eta, scale=alpha).force(points)
    expected = np.array([sheet(x, *line, *(line - fibre * along), length, eta, alpha) for x in points.tolist()])
    assert 20 < np.count_nonzero(expected.any(axis=1)) < 380
    assert force == pytest.approx(expected, abs=1e-12)


def unit_linear(**changes: Any) -> LinearMuscle:
    figures = {"radius": 1.5, "angle": 0.5, "exponent": 2.0, "scale": 3.0} | changes
    return LinearMuscle(np.zeros(3), np.array([1.0, 0, 0]), **figures)


def test_linear_landmarks() -> None:
    """Largest at the insertion, nothing at the attachment, behind it, at the reach, at the largest angle."""
    rim = np.array([math.cos(0.5), math.sin(0.5), 0.0])
    points = np.array([[1.0, 0, 0], [0, 0, 0], [-0.5, 0, 0], [1.5, 0, 0], [1.51, 0, 0], [1e-9, 0, 0]])
    force = unit_linear().force(np.concatenate([points, [rim]]))
    assert force[0] == pytest.approx([-3.0, 0, 0])
    assert np.abs(force[1:]).max() < 1e-12


def test_linear_is_continuous_over_the_insertion_and_at_every_edge() -> None:
    s = np.linspace(-0.2, 1.8, 4001)[:, None]
    for heading in ([1.0, 0, 0], [math.cos(0.3), math.sin(0.3), 0], [math.cos(0.4999), math.sin(0.4999), 0]):
        force = unit_linear().force(s * np.array(heading))
        assert np.abs(np.diff(force, axis=0)).max() < 0.02


def test_sphincter_draws_the_rim_most_and_the_centre_not() -> None:
    muscle = SphincterMuscle(np.zeros(3), np.array([1.0, 0, 0]), np.array([0, 0, 1.0]), semi_major=2, semi_minor=1)
    force = muscle.force(np.array([[0.0, 0, 0], [2, 0, 0], [0, 0, -1], [2.001, 0, 0], [1, 0, 0]]))
    expected = [[0, 0, 0], [-1, 0, 0], [0, 0, 1], [0, 0, 0], [-math.cos(math.pi / 4), 0, 0]]
    assert force == pytest.approx(np.array(expected))


def test_sheet_pulls_all_fibres_the_same_way_within_its_rectangle() -> None:
    top = np.array([[-1.0, 0, 2], [1, 0, 2]])
    muscle = SheetMuscle(top, top - [0, 0, 1], length=1.5, exponent=1.0)
    force = muscle.force(np.array([[-0.9, 0, 1], [0.9, 0, 1], [1.1, 0, 1], [0, 0, 2.1], [0, 0, 2], [0, 0, 0.49]]))
    assert force == pytest.approx(np.array([[0, 0, 1.0], [0, 0, 1.0]] + [[0.0, 0, 0]] * 4))
    assert muscle.width == pytest.approx(2.0)


@pytest.mark.parametrize(
    ("name", "changes"),
    [
        ("radius", {"radius": 1.0}),
        ("radius", {"radius": 0.5}),
        ("radius", {"radius": math.nan}),
        ("angle", {"angle": 0.0}),
        ("angle", {"angle": 2.0}),
        ("exponent", {"exponent": 0.0}),
        ("scale", {"scale": -1.0}),
    ],
)
def test_wrong_linear_figures_are_named(name: str, changes: dict[str, float]) -> None:
    with pytest.raises(ParameterError, match=name):
        unit_linear(**changes)


def test_wrong_places_are_named() -> None:
    x, z = np.array([1.0, 0, 0]), np.array([0, 0, 1.0])
    line = np.array([[-1.0, 0, 2], [1, 0, 2]])
    with pytest.raises(ParameterError, match="insertion"):
        LinearMuscle(x, x, radius=1, angle=1, exponent=1)
    with pytest.raises(ParameterError, match="attachment"):
        LinearMuscle(x * np.nan, x, radius=1, angle=1, exponent=1)
    with pytest.raises(ParameterError, match="major_axis"):
        SphincterMuscle(x, 2 * x, z, semi_major=1, semi_minor=1)
    with pytest.raises(ParameterError, match="minor_axis"):
        SphincterMuscle(x, x, x, semi_major=1, semi_minor=1)
    with pytest.raises(ParameterError, match="length"):
        SheetMuscle(line, line - z, length=1.0, exponent=1)
    with pytest.raises(ParameterError, match="swap"):
        SheetMuscle(line, (line - z)[::-1], length=2.0, exponent=1)
    with pytest.raises(ParameterError, match="along the fibres"):
        SheetMuscle(line, line - 5 * x, length=9.0, exponent=1)
