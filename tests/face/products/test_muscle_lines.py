"""Lines of muscles and places of paths: on the face, even, alike on both sides, and moving with the skin."""

from __future__ import annotations

import numpy as np
import risorius.api as api
from risorius.face.products.muscle_lines import muscle_lines
from risorius.face.products.trajectories import sampled_vertices

MIRROR = np.array([-1.0, 1.0, 1.0])


def test_every_muscle_has_lines_within_the_face_and_alike_on_both_sides(face: api.Face) -> None:
    lines = muscle_lines(face)
    assert set(lines) == set(face.muscles)
    low, high = face.vertices.min(axis=0) - 5e-3, face.vertices.max(axis=0) + 5e-3
    for name, muscle in lines.items():
        assert (muscle.strands >= low).all(), name
        assert (muscle.strands <= high).all(), name
        if name.endswith("_l"):
            other = lines[name[:-2] + "_r"].strands * MIRROR
            distances = [np.linalg.norm(strand - muscle.strands, axis=2).max(axis=1).min() for strand in other]
            assert max(distances) < 1.5e-3, name


def test_a_strand_is_fast_at_the_bone_and_goes_with_the_skin_at_its_end(face: api.Face) -> None:
    muscle = muscle_lines(face)["zygomaticus_major_l"]
    joy = api.expression("joy")
    moved = face.pose(joy.frame(), emotion=joy.weights).positions - face.vertices
    strand, after = muscle.strands[0], muscle.moved(moved)[0]
    np.testing.assert_allclose(after[0], strand[0])
    np.testing.assert_allclose(after[-1] - strand[-1], moved[muscle.vertices[0]])
    length = [np.linalg.norm(line[-1] - line[0]) for line in (strand, after)]
    assert length[1] < length[0] - 2e-3  # a smile shortens it


def test_paths_begin_evenly_spread_over_the_face(face: api.Face) -> None:
    vertices = sampled_vertices(face, 7e-3)
    places = face.vertices[vertices]
    away = np.linalg.norm(places[:, None] - places[None], axis=2)
    np.fill_diagonal(away, np.inf)
    assert 200 < len(vertices) < 1500
    assert away.min() > 0.9 * 7e-3
