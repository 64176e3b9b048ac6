"""Parts of a face's mesh: told, kept, shown, corrected by a vertex group."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
import pytest
from risorius.face.mesh.parts import Part
from risorius.operators.parts import overlay
from risorius.scene.faces import face_of, read_face
from risorius.scene.mesh import PART_ATTRIBUTE, read_parts
from risorius.scene.points.stored import store_points, stored_points

pytestmark = pytest.mark.smoke


def group(obj: Any, vertices: np.ndarray) -> None:
    obj.vertex_groups.new(name="Lashes").add([int(v) for v in vertices], 1.0, "REPLACE")
    bpy.context.window_manager.risorius.parts.group = "Lashes"


def test_parts_are_told_and_kept_with_the_mesh(head: Any) -> None:
    modelled = read_parts(head.data)
    assert modelled is not None
    assert bpy.ops.risorius.forget_parts() == {"FINISHED"}
    assert read_parts(head.data) is None
    assert not bpy.ops.risorius.forget_parts.poll()
    assert bpy.ops.risorius.find_parts() == {"FINISHED"}
    told = read_parts(head.data)
    assert told is not None
    assert np.mean(told == modelled) > 0.97
    assert bpy.context.window_manager.risorius.parts.show


def test_a_vertex_group_corrects_them_and_the_face_takes_it(head: Any) -> None:
    assert not bpy.ops.risorius.set_part.poll()
    bpy.ops.risorius.forget_parts()
    told = np.asarray(face_of(read_face(head)).parts)
    brows = np.flatnonzero(told == int(Part.OTHER))[:40]
    group(head, brows)
    bpy.context.window_manager.risorius.parts.part = "TONGUE"
    assert bpy.ops.risorius.set_part() == {"FINISHED"}
    kept = read_parts(head.data)
    assert kept is not None
    assert set(np.flatnonzero(kept == int(Part.TONGUE))) == set(brows)
    assert (np.delete(kept, brows) == -1).all()
    parts = np.asarray(face_of(read_face(head)).parts)
    assert (parts[brows] == int(Part.TONGUE)).all()
    assert np.array_equal(np.delete(parts, brows), np.delete(told, brows))


def test_an_empty_or_missing_group_is_refused_with_the_remedy(head: Any) -> None:
    before = read_parts(head.data)
    group(head, np.zeros(0, dtype=int))
    with pytest.raises(RuntimeError, match="no vertices in its vertex group Lashes: assign some"):
        bpy.ops.risorius.set_part()
    assert np.array_equal(before, read_parts(head.data))


def test_parts_that_cannot_be_told_stay_as_they_were(head: Any) -> None:
    before = read_parts(head.data)
    store_points(head, {name: point for name, point in stored_points(head).items() if name != "8.4"})
    with pytest.raises(RuntimeError, match=r"lacks the feature points 8\.4"):
        bpy.ops.risorius.find_parts()
    assert PART_ATTRIBUTE in head.data.attributes
    assert np.array_equal(before, read_parts(head.data))


def test_every_part_has_a_colour_of_its_own_and_the_untold_are_grey() -> None:
    shown = overlay.colours(np.array([*Part, -1]))
    assert len({tuple(row) for row in shown.tolist()}) == len(Part) + 1
    np.testing.assert_allclose(shown[-1, :3], overlay.UNTOLD)
