"""A face of several objects is the face that it is in one: each object moves as its part of the whole does."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from risorius.errors import SceneError
from risorius.face.face import Face
from risorius.face.mesh.parts import Part, Told
from risorius.scene.companions import Companion
from risorius.scene.faces import face_of, read_face

from .conftest import FIVE

TOLD = {"Eyes": Told.EYES, "Teeth": Told.TEETH, "Tongue": Part.TONGUE, "Brows": Part.OTHER}


def frame() -> np.ndarray:
    """The jaw and the brows down, the eyes to the left, a lid shut."""
    faps = np.full(68, np.nan)
    faps[[2, 22, 23, 30, 31, 18, 20]] = 500.0, 20000.0, 20000.0, -200.0, -200.0, 600.0, 600.0
    return faps


@pytest.mark.slow
@pytest.mark.parametrize("told", [TOLD, dict.fromkeys(TOLD, Told.ANYTHING)], ids=["told", "by shape"])
def test_every_object_moves_as_in_one_mesh(built_head: Any, character: Callable, told: dict[str, Part | Told]) -> None:
    whole = Face.from_arrays(built_head.vertices, built_head.polygons, built_head.points, built_head.parts)
    moved = whole.pose(frame()).positions - whole.vertices
    made = character()
    source = read_face(made["Face"], companions=[Companion(made[name], what) for name, what in told.items()])
    face = face_of(source)
    displacement = face.pose(frame()).positions - face.vertices
    for piece in source.pieces:
        own = np.isin(built_head.parts, FIVE[piece.obj.name])
        assert np.abs(moved[own]).max() > 5e-4
        np.testing.assert_allclose(displacement[piece.slice], moved[own], atol=2e-5)


def test_the_skin_itself_cannot_be_apart(character: Callable) -> None:
    made = character()
    with pytest.raises(SceneError, match="is told to be the skin"):
        read_face(made["Face"], companions=[Companion(made["Brows"], Part.SKIN)])
