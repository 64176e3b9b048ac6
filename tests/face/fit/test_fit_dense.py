"""Dense meshes: what is done once for the whole of them is not done again for each place that is looked at."""

from __future__ import annotations

import numpy as np
import pytest
from fit import shapes
from risorius.face.fit.surface.cloud import Surface, sample


def test_parts_of_a_mesh_know_their_areas(monkeypatch: pytest.MonkeyPatch) -> None:
    surface = Surface.from_polygons(*shapes.rock())
    chosen = np.arange(len(surface.triangles)) % 3 == 0
    plain = Surface(surface.vertices, surface.triangles[chosen], surface.normals)
    expected = sample(plain, 50)
    whole = surface.twice_areas
    np.testing.assert_array_equal(surface.part(chosen).twice_areas, np.linalg.norm(plain.cross(), axis=1))
    monkeypatch.setattr(Surface, "cross", None)
    seen = sample(surface.part(chosen), 50)
    np.testing.assert_array_equal(seen.positions, expected.positions)
    np.testing.assert_array_equal(surface.part(chosen).part(chosen[chosen]).twice_areas, whole[chosen])
