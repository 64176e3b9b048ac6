"""Objects that belong to a face besides its head, and where they are in it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import Floats
from ..errors import SceneError
from ..face.mesh.parts import Part, Told
from .blender_types import Object, Scene
from .mesh import metres_matrix, relative_matrix


@dataclass(frozen=True)
class Companion:
    """An object of a face besides the head.

    Attributes
    ----------
    part : what it is: a part (OTHER goes with the skin that it grows out of, SKULL with the head alone), or what it
        holds, where its pieces are to be told apart: both eyes, both rows of teeth, anything.
    """

    obj: Object
    part: Part | Told


def refuse_confused(obj: Object, companions: Sequence[Companion]) -> None:
    """Refuse an object that stands for two parts of a face, or for its skin.

    Raises
    ------
    SceneError : names it.
    """
    seen = {obj}
    for companion in companions:
        if companion.part is Part.SKIN:
            raise SceneError(companion.obj.name, "is told to be the skin, which is the face: join it to the face")
        if companion.obj in seen:
            raise SceneError(companion.obj.name, "is used for two parts of the face: choose it for one of them")
        seen.add(companion.obj)


def placements(obj: Object, companions: Sequence[Companion], scene: Scene | None = None) -> list[Floats]:
    """(4, 4) matrices to metres in the head's axes: from the head's own coordinates, and from each companion's.

    Raises
    ------
    SceneError : an object that is scaled to nothing, or a mirrored head.
    """
    head = np.eye(4)
    head[:3, :3] = metres_matrix(obj, scene)
    return [head, *(head @ relative_matrix(obj, companion.obj) for companion in companions)]
