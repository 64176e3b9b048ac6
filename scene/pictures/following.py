"""Where a face is at each frame, carried by parents, a rig or its own animation; and a camera that goes with it."""

from __future__ import annotations

import numpy as np

from ...arrays import Floats, Ints
from .. import mesh as meshes
from ..blender_types import Depsgraph, Object, Scene
from ..points.kept import as_found
from ..posed import rigid_motion as rigid_motion
from .framing import Framing, framing_of
from .furniture import carry

#: A face that its rig moves by less than this is where it rests: share of the picture's height, radians.
STILL, STRAIGHT = 0.02, 0.035
#: How far the face may go from where it was in the picture before the camera goes with it, share of its height.
FREE = 0.1
#: Vertices that tell how a rig carries the head; the rest of its surface goes alike.
SAMPLE = 400
#: A head whose vertices are farther than this from where one motion takes them all is not carried, but changed.
CHANGED = 0.05


class CarriedFace:
    """The face of an object, wherever it is carried: by a parent, by an armature, by animation.

    What an expression does to it is not followed: of the mesh, the skull over the eyes says where the head is.
    """

    def __init__(self, obj: Object) -> None:
        """Read where it rests."""
        self._obj = obj
        self._rest = meshes.rest_vertices(obj.data, as_found(obj.data))
        self._home = framing_of(obj, world=np.eye(4))
        self._skull = _skull(self._rest, self._home)

    def framing(self, depsgraph: Depsgraph) -> Framing:
        """How to frame it as it is shown."""
        evaluated = self._obj.evaluated_get(depsgraph)
        return framing_of(self._obj, world=meshes.world_matrix(evaluated) @ self._carried(depsgraph))

    def _carried(self, depsgraph: Depsgraph) -> Floats:
        """(4, 4) motion of the head in the object's own coordinates by modifiers and shape keys."""
        shown = meshes.evaluated_vertices(self._obj, depsgraph)
        if len(self._skull) < 3 or len(shown) < len(self._rest):
            return np.eye(4)
        motion = rigid_motion(self._rest[self._skull], shown[self._skull])
        moved = self._rest[self._skull] @ motion[:3, :3].T + motion[:3, 3]
        height = self._home.height
        missed = float(np.sqrt(((moved - shown[self._skull]) ** 2).sum(axis=1).mean()))
        shift = float(np.linalg.norm(motion[:3, :3] @ self._home.centre + motion[:3, 3] - self._home.centre))
        turn = float(np.arccos(np.clip(0.5 * (np.trace(motion[:3, :3]) - 1.0), -1.0, 1.0)))
        stays = shift < STILL * height and turn < STRAIGHT
        return np.eye(4) if stays or missed > CHANGED * height else motion


def _skull(rest: Floats, home: Framing) -> Ints:
    """Indices of some vertices over the middle of the face, or of all around where there are none."""
    away = rest - home.centre
    near = np.linalg.norm(away, axis=1) < 0.8 * home.height
    above = near & (away @ home.up > 0.1 * home.height)
    chosen = np.flatnonzero(above if above.sum() >= 3 else near)
    return chosen[:: max(1, len(chosen) // SAMPLE)]


class FollowingCamera:
    """The portrait camera of a studio: it takes the face as it stands at the first frame, and goes with it from there.

    It keeps its direction, so that a head that turns is seen to turn; and it goes only as far as keeps the face in the
    picture, so that a nod is seen, too.
    """

    def __init__(self, scene: Scene, obj: Object, built_for: Framing) -> None:
        """Take over the furniture of a studio that was built for a framing."""
        self._scene, self._face = scene, CarriedFace(obj)
        self._built_for = built_for
        self._first: Framing | None = None
        self._gone = np.zeros(3)

    def go_to(self, frame: int) -> None:
        """Show a frame, and put camera and lights where they see the face."""
        self._scene.frame_set(frame)
        framing = self._face.framing(self._scene.view_layers[0].depsgraph)
        if self._first is None:
            self._first = framing
            carry(self._scene, _axes(framing) @ np.linalg.inv(_axes(self._built_for)))
            return
        ahead = framing.centre - self._first.centre - self._gone
        distance, free = float(np.linalg.norm(ahead)), FREE * framing.height
        if distance > free:
            step = ahead * (1.0 - free / distance)
            self._gone = self._gone + step
            shift = np.eye(4)
            shift[:3, 3] = step
            carry(self._scene, shift)


def _axes(framing: Framing) -> Floats:
    """(4, 4) axes and centre of a framing."""
    axes = np.eye(4)
    axes[:3, 0], axes[:3, 1], axes[:3, 2] = framing.left, framing.up, framing.forward
    axes[:3, 3] = framing.centre
    return axes
