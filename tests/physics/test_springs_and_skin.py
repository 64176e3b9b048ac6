"""Springs and skin: laws, gradients, rigid motion, momentum, what the figures mean."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from risorius.errors import FormatError, ParameterError
from risorius.physics import elastic, mesh
from risorius.physics.skin import Skin
from risorius.physics.springs import SpringLaw, SpringNetwork, spring_energy, spring_tension
from risorius.physics.tissue import PRESET, load_tissues, tissue, tissues


def dome(count: int = 12, size: float = 0.1) -> tuple[Any, Any]:
    """A shallow cap of quads, 10 cm across."""
    x, y = np.meshgrid(np.linspace(-0.5, 0.5, count + 1), np.linspace(-0.5, 0.5, count + 1))
    vertices = size * np.stack([x.ravel(), y.ravel(), 0.4 * (1 - 2 * x**2 - 2 * y**2).ravel()], axis=1)
    corner = (np.arange(count)[:, None] * (count + 1) + np.arange(count)).ravel()
    return vertices, np.stack([corner, corner + 1, corner + count + 2, corner + count + 1], axis=1)


def rotation(axis: Any, angle: float) -> Any:
    """Rodrigues' matrix."""
    x, y, z = np.asarray(axis) / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


FIGURES = {"stiffness_low": 2.0, "stiffness_high": 8.0, "threshold": 0.15}


def test_continuous_law_has_two_slopes_and_no_jump() -> None:
    tension = spring_tension(np.array([-0.1, 0.0, 0.15, 0.25]), **FIGURES)
    assert tension == pytest.approx([-0.2, 0.0, 0.3, 0.3 + 0.8])
    below, above = spring_tension(np.array([0.15 - 1e-9, 0.15 + 1e-9]), **FIGURES)
    assert above - below < 1e-7


def test_printed_law_is_equation_3() -> None:
    tension = spring_tension(np.array([-0.1, 0.15, 0.15 + 1e-9, 0.25]), **FIGURES, law="printed")
    assert tension == pytest.approx([-0.2, 0.3, 1.2, 2.0])


@pytest.mark.parametrize("law", list(SpringLaw))
def test_spring_energy_is_the_integral_of_tension(law: SpringLaw) -> None:
    strain = np.linspace(0, 0.4, 40001)
    tension = spring_tension(strain, **FIGURES, law=law)
    whole = float(((tension[1:] + tension[:-1]) / 2 * np.diff(strain)).sum())
    assert spring_energy(0.4, **FIGURES, law=law) == pytest.approx(whole, rel=1e-4)
    assert spring_energy(-0.2, **FIGURES, law=law) == pytest.approx(0.04)


def test_unknown_law_is_named() -> None:
    with pytest.raises(ParameterError, match="law"):
        spring_tension(0.1, **FIGURES, law="cubic")


def network(**changes: Any) -> SpringNetwork:
    return SpringNetwork.from_polygons(*dome(), **({"stiffness": 18.0, "stiffening": 4.0, "threshold": 0.15} | changes))


def strained(skin_rest: Any, scale: float = 0.01) -> Any:
    """Positions far enough from rest that springs are on both sides of the threshold."""
    return skin_rest + scale * np.random.default_rng(3).normal(size=skin_rest.shape)


def test_spring_force_against_a_loop_over_springs() -> None:
    springs = network()
    x = strained(dome()[0], 0.002)
    expected = np.zeros_like(x)
    for i, j, rest, low, high, limit in zip(
        springs.i,
        springs.j,
        springs.rest_length,
        springs.stiffness_low,
        springs.stiffness_high,
        springs.threshold,
        strict=True,
    ):
        r = np.linalg.norm(x[j] - x[i])
        stretch = r - rest
        pull = low * stretch if stretch <= limit * rest else low * limit * rest + high * (stretch - limit * rest)
        expected[i] += pull * (x[j] - x[i]) / r
        expected[j] -= pull * (x[j] - x[i]) / r
    assert springs.force(x) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("law", list(SpringLaw))
@pytest.mark.parametrize("bending", [0.0, 0.0117**2])
def test_force_is_the_negative_gradient_of_energy(law: SpringLaw, bending: float) -> None:
    vertices, quads = dome()
    skin = Skin.from_mesh(vertices, quads, tissue(), bending=bending, law=law)
    x, anchors = strained(vertices), vertices + 0.003
    strain = np.linalg.norm(skin.springs.incidence @ x, axis=1) / skin.springs.rest_length - 1
    assert 0.1 < (strain > skin.springs.threshold).mean() < 0.9
    force = skin.force(x, anchors)
    rng, step = np.random.default_rng(4), 1e-8
    for _ in range(5):
        heading = rng.normal(size=x.shape)
        slope = (skin.energy(x + step * heading, anchors) - skin.energy(x - step * heading, anchors)) / (2 * step)
        assert -float(np.vdot(force, heading)) == pytest.approx(slope, rel=1e-5)


def test_rigid_motion_leaves_no_spring_force() -> None:
    vertices, _ = dome()
    turned = vertices @ rotation([1, 2, -1], 2.1).T + [0.3, -0.2, 1.0]
    springs = network()
    scale = np.abs(springs.force(strained(vertices, 0.001))).max()
    assert np.abs(springs.force(turned)).max() < 1e-12 * scale
    assert springs.energy(turned) < 1e-20


def test_skin_carried_with_its_bone_bears_no_force() -> None:
    vertices, quads = dome()
    skin = Skin.from_mesh(vertices, quads, tissue())
    turned = vertices @ rotation([1, 0, 0], 0.4).T + [0.0, 0.01, 0.0]
    assert np.abs(skin.force(turned, turned)).max() < 1e-10 * np.abs(skin.force(turned)).max()


@pytest.mark.parametrize("law", list(SpringLaw))
def test_springs_conserve_linear_and_angular_momentum(law: SpringLaw) -> None:
    x = strained(dome()[0])
    force = network(law=law).force(x)
    size = np.abs(force).sum()
    assert np.abs(force.sum(axis=0)).max() < 1e-14 * size
    assert np.abs(np.cross(x, force).sum(axis=0)).max() < 1e-14 * size


def test_spring_constants_are_the_laplacian_of_elastic() -> None:
    vertices, quads = dome()
    expected = 18.0 * elastic.laplacian(vertices, quads)
    assert abs(network().laplacian() - expected).max() < 1e-12
    assert abs(network().laplacian(high=True) - 4 * expected).max() < 1e-12


def test_a_sheet_of_springs_has_two_thirds_of_w_as_modulus() -> None:
    """Equilateral triangles stretched one way, free to narrow by Poisson's 1/3: energy = 1/2 (2 w / 3) e^2 A."""
    i, j = np.meshgrid(np.arange(9), np.arange(9), indexing="ij")
    vertices = np.stack([i + 0.5 * j, np.sqrt(0.75) * j, 0.0 * i], axis=2).reshape(-1, 3) * 0.005
    index = np.arange(81).reshape(9, 9)
    a, b, c, d = index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]
    faces = np.concatenate([np.stack([a, b, d], 2).reshape(-1, 3), np.stack([b, c, d], 2).reshape(-1, 3)])
    springs = SpringNetwork.from_polygons(vertices, faces, stiffness=18.0, stiffening=4.0, threshold=0.15)
    area = mesh.polygon_areas(vertices, faces).sum()

    def energy(narrowing: float) -> float:
        return springs.energy(vertices * [1.0 + 1e-4, 1.0 - narrowing * 1e-4, 1.0]) / (0.5 * 1e-8 * area)

    assert energy(1 / 3) == pytest.approx(2 * 18.0 / 3, rel=1e-3)
    assert energy(1 / 3) < min(energy(1 / 3 - 0.05), energy(1 / 3 + 0.05))


def test_tissue_figures_reach_the_skin_by_area() -> None:
    t = tissue()
    for vertices, quads in (dome(), dome(5)):
        skin, area = Skin.from_mesh(vertices, quads, t), mesh.polygon_areas(vertices, quads).sum()
        assert skin.mass.sum() == pytest.approx(t.density * t.depth * area)
        bed = 1.5 * t.youngs_modulus * t.thickness / t.anchor_length**2
        assert skin.anchor.sum() == pytest.approx(bed * area)
        ratio = skin.damping / (2 * np.sqrt(skin.anchor * skin.mass))
        assert ratio == pytest.approx(np.full(len(ratio), t.damping_ratio))


def test_upright_gravity_is_borne_by_the_rest_pose() -> None:
    skin = Skin.from_mesh(*dome(), tissue())
    assert not skin.gravity().any()
    on_the_back = skin.gravity((0, 9.80665, 0))
    assert on_the_back.sum(axis=0) == pytest.approx(skin.mass.sum() * 9.80665 * np.array([0, 1, 1]))
    assert skin.gravity(rest=(0, 0, 0)).sum(axis=0) == pytest.approx([0, 0, -9.80665 * skin.mass.sum()])


def test_nodes_outside_the_skin_stay_with_their_anchor() -> None:
    vertices, quads = dome()
    mask = vertices[:, 0] < 0.02
    skin = Skin.from_mesh(vertices, quads, tissue(), mask=mask)
    x = strained(vertices, 0.002)
    outside = ~mask
    assert skin.force(x)[outside] == pytest.approx(-skin.anchor[outside, None] * (x - vertices)[outside])


def test_a_doubled_vertex_has_no_spring_without_length() -> None:
    """A corner of the dome twice in one polygon: its two vertices have no spring between them, and both have others."""
    vertices, quads = dome()
    doubled, twin = np.concatenate([vertices, vertices[:1]]), len(vertices)
    skin = Skin.from_mesh(doubled, [*quads.tolist(), [0, twin, 1, 14]], tissue())
    joined = set(zip(skin.springs.i.tolist(), skin.springs.j.tolist(), strict=True))
    assert {(0, 1), (1, twin), (14, twin)} <= joined
    assert (0, twin) not in joined
    assert np.isfinite(skin.force(strained(doubled, 0.002))).all()


def test_bundled_tissues_have_units_and_sources() -> None:
    assert list(tissues()) == ["default", "young", "aged", "stiff"]
    assert PRESET.read_text().count("source = ") == PRESET.read_text().count("[figures.") == 13
    assert tissue("aged").membrane > tissue("young").membrane
    with pytest.raises(ParameterError, match="young"):
        tissue("marble")


@pytest.mark.parametrize(
    ("old", "new", "match"),
    [
        ("density = 1.03e3", "densty = 1.03e3", "tissues.default.densty"),
        ("density = 1.03e3\n", "", "tissues.default.density.*missing"),
        ("stiffening = 4.0", "stiffening = 0.5", "tissues.default.stiffening.*1 or more"),
        ("thickness = 1.2e-3", 'thickness = "2 mm"', "tissues.default.thickness.*number"),
        ('unit = "Pa"', 'unit = ""', "figures.youngs_modulus.unit"),
        ("[tissues.default]", "[tissues.default", "TOML"),
    ],
)
def test_a_wrong_tissue_preset_names_file_key_and_rule(tmp_path: Path, old: str, new: str, match: str) -> None:
    text = PRESET.read_text()
    assert old in text
    path = tmp_path / "mine.toml"
    path.write_text(text.replace(old, new, 1))
    with pytest.raises(FormatError, match=f"(?s)mine.toml.*{match}"):
        load_tissues(path)
