"""The default head's mouth from within: darker towards the throat, with room for the tongue."""

from __future__ import annotations

import numpy as np
import pytest
from risorius.face.default_head import HeadMesh, build_default_head
from risorius.face.mesh.parts import Part

#: Behind this nothing pale may be seen between open lips, metres: the second molars end here.
MOLARS = -69e-3


@pytest.fixture(scope="module")
def head() -> HeadMesh:
    return build_default_head()


def bag_quads(head: HeadMesh) -> np.ndarray:
    bag = np.isin(np.array(head.polygons), head.groups["mouth_bag"]).all(axis=1)
    return np.flatnonzero(bag)


def brightness(head: HeadMesh) -> np.ndarray:
    """Largest of red, green and blue of every quad of the mouth bag."""
    return np.array([max(head.materials[m].colour) for m in head.material_index[bag_quads(head)]])


def test_the_mouth_gets_darker_inwards_until_nothing_is_seen(head: HeadMesh) -> None:
    depth = head.vertices[np.array(head.polygons)[bag_quads(head)], 1].mean(axis=1)
    shown = brightness(head)
    levels = sorted(set(shown), reverse=True)
    assert len(levels) >= 4
    places = [depth[shown == level].mean() for level in levels]
    assert places == sorted(places)
    assert shown[depth > MOLARS].max() < 0.05


def test_the_tongue_lies_within_the_mouth(head: HeadMesh) -> None:
    """Nowhere does its back reach through the roof of the bag above it."""
    tongue = head.vertices[head.parts == Part.TONGUE]
    top = tongue[np.argmax(tongue[:, 2])]
    roof = head.vertices[head.groups["mouth_bag"]]
    above = roof[(np.abs(roof[:, :2] - top[:2]) < 12e-3).all(axis=1) & (roof[:, 2] > -0.034)]
    assert len(above) > 0
    assert top[2] < above[:, 2].min()
