"""Whether an object of a face is still as it was read, to be asked just before something is written on it."""

from __future__ import annotations

from dataclasses import dataclass
from hashlib import blake2b

import bpy
import numpy as np

from ..arrays import Floats
from ..errors import SceneError
from .blender_types import Datablock, Object
from .fingerprint import STRETCHED, uid_of
from .mesh import basis_vertices, polygon_arrays, world_matrix
from .refusals import refuse_unreadable


@dataclass(frozen=True, eq=False)
class AsRead:
    """What an object was when its face was read; the values of shape keys and where it stands are no part of that.

    Attributes
    ----------
    mesh : the number of its mesh. digest : of its vertices without shape keys, and its polygons.
    stretch : (3,) how far it is scaled, metres per unit of the mesh, along three axes of its own.
    """

    mesh: int
    digest: bytes
    stretch: Floats

    @classmethod
    def of(cls, obj: Object) -> AsRead:
        """It now."""
        digest = blake2b(basis_vertices(obj.data).astype(np.float32).tobytes(), digest_size=16)
        digest.update(repr(len(obj.data.vertices)).encode())  # of a Basis there may still be as many as before
        for numbers in polygon_arrays(obj.data):
            digest.update(numbers.astype(np.int32).tobytes())
        unit = bpy.context.scene.unit_settings.scale_length
        stretch = np.linalg.svd(world_matrix(obj)[:3, :3], compute_uv=False) * unit
        return cls(uid_of(obj.data), digest.digest(), np.asarray(stretch))

    def refuse_changed(self, obj: Object, *, same_mesh: bool = False) -> None:
        """Refuse an object that was edited since; `same_mesh` : a copy of its mesh is another one.

        Raises
        ------
        SceneError : it cannot be read any more; its mesh or its scale is another one.
        """
        refuse_unreadable(obj)
        now = AsRead.of(obj)
        off = np.abs(now.stretch - self.stretch).max(initial=0.0)
        is_same = now.digest == self.digest and off <= STRETCHED * self.stretch.max(initial=0.0)
        if not is_same or (same_mesh and now.mesh != self.mesh):
            problem = "was changed while its face was computed: do it again; nothing has been written"
            raise SceneError(obj.name, problem)


def is_there(datablock: Datablock) -> bool:
    """Whether Blender still has a datablock; anything else asked of one that is gone fails."""
    try:
        return bool(datablock.name)
    except ReferenceError:
        return False
