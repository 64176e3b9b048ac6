"""What is drawn over the face: colours of strain, contraction and time; strands and paths of a live face."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
import pytest
import risorius.api as api
from risorius.operators.active import target_of
from risorius.operators.emotion.profile import wanted_of
from risorius.operators.show import colours
from risorius.scene.live.live_face import STOPS, LiveFace
from risorius.scene.mesh import edge_vertices, rest_vertices


def test_strain_is_how_much_longer_the_edges_are(head: Any) -> None:
    rest, edges = rest_vertices(head.data), edge_vertices(head.data)
    np.testing.assert_allclose(colours.strain(rest, rest, edges), 0.0)
    np.testing.assert_allclose(colours.strain(rest, 1.2 * rest, edges), 0.2, atol=1e-9)
    shades = colours.of_strain(np.array([-0.3, 0.0, 0.3, 9.0]))
    np.testing.assert_allclose(shades[:, 3], [colours.OPACITY, 0.0, colours.OPACITY, colours.OPACITY])
    assert shades[0, 2] > shades[0, 0]
    assert shades[2, 0] > shades[2, 2]


def test_time_goes_from_blue_to_red_and_contraction_too() -> None:
    first, last = colours.of_time(np.array([0.0, 1.0]))
    assert first[2] > 0.8 > 0.1 > first[0]
    assert last[0] > 0.8 > 0.1 > last[2]
    np.testing.assert_allclose(colours.of_contraction(0.0), colours.SLACK)
    np.testing.assert_allclose(colours.of_contraction(2.0), colours.CONTRACTED)


@pytest.mark.slow
def test_a_live_face_traces_paths_and_moves_strands_in_the_meshs_own_coordinates(head: Any) -> None:
    head.scale = (2.0, 2.0, 2.0)
    head.location = (1.0, 2.0, 3.0)
    bpy.context.view_layer.update()
    face, wanted = LiveFace(target_of(head)), wanted_of(head)
    paths = face.paths_to(wanted.faps, drive=wanted.drive, emotion=wanted.profile.weights)
    assert paths.shape[1:] == (STOPS, 3)
    rest = rest_vertices(head.data)
    for start in paths[::50, 0]:
        assert np.linalg.norm(rest - start, axis=1).min() < 1e-6
    ways = np.linalg.norm(np.diff(paths, axis=1), axis=2)
    assert ways.sum(axis=1).max() > 3e-3
    # Each stop is further on: its colour tells when the skin is there.
    assert (ways.sum(axis=0) > 0.5 / (STOPS - 1) * ways.sum()).all()
    strands = face.muscle_strands(rest)
    low, high = rest.min(axis=0) - 5e-3, rest.max(axis=0) + 5e-3
    assert all((lines > low).all() and (lines < high).all() for lines in strands.values())
    moved = face.muscle_strands(rest + np.array([0.0, 0.0, 0.01]))
    ends = moved["zygomaticus_major_l"][:, -1] - strands["zygomaticus_major_l"][:, -1]
    np.testing.assert_allclose(ends, [[0.0, 0.0, 0.01]], atol=1e-9)


def test_the_preview_shows_on_the_object_and_goes_without_a_trace(head: Any) -> None:
    from risorius.scene import mesh as meshes
    from risorius.scene.live import preview

    def state() -> Any:
        return (
            [modifier.name for modifier in head.modifiers],
            sorted(attribute.name for attribute in head.data.attributes),
            sorted(tree.name for tree in bpy.data.node_groups),
            head.data.shape_keys,
        )

    before = state()
    face, wanted = LiveFace(target_of(head)), wanted_of(head)
    pose = face.pose(wanted.faps, drive=wanted.drive, emotion=wanted.profile.weights, exact=True)
    face.show(target_of(head), pose.displacement)
    shown = meshes.evaluated_vertices(head)
    posed = api.default_face().pose(wanted.faps, emotion=wanted.profile.weights)
    np.testing.assert_allclose(shown, posed.positions, atol=2e-6)
    assert not head.modifiers[0].show_render
    preview.rest([head])
    np.testing.assert_allclose(meshes.evaluated_vertices(head), rest_vertices(head.data), atol=1e-7)
    preview.remove_all()
    assert state() == before


def test_the_preview_lies_over_shape_keys_and_under_other_modifiers(head: Any) -> None:
    from risorius.scene import mesh as meshes

    head.shape_key_add(name="Basis")
    head.shape_key_add(name="mine").value = 1.0
    head.data.shape_keys.key_blocks["mine"].data.foreach_set(
        "co", (rest_vertices(head.data) + 0.1).astype(np.float32).ravel()
    )
    lift = head.modifiers.new("lift", "DISPLACE")
    lift.direction, lift.strength, lift.mid_level = "Z", 0.05, 0.0
    face = LiveFace(target_of(head))
    face.show(target_of(head), np.zeros_like(rest_vertices(head.data)))
    expected = rest_vertices(head.data) + np.array([0.0, 0.0, 0.05])
    np.testing.assert_allclose(meshes.evaluated_vertices(head), expected, atol=1e-6)
    assert [modifier.name for modifier in head.modifiers][1] == "lift"
