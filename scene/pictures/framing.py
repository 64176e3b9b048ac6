"""Where the camera and the lights stand to show a face."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays import Floats
from .. import mesh as meshes
from ..blender_types import Object
from ..points.kept import as_found, has_points
from ..points.stored import stored_points

#: Feature points that tell where the face is: pupils or eye corners, mouth corners, chin.
EYES_LEFT, EYES_RIGHT, CHIN = ("3.7", "3.11"), ("3.8", "3.12"), "2.1"


@dataclass(frozen=True, eq=False)
class Framing:
    """A face in the world, in Blender units.

    Attributes
    ----------
    centre : (3,) what the camera looks at.
    left, up, forward : (3,) unit axes of the face.
    height : how much of the vertical is shown.
    """

    centre: Floats
    left: Floats
    up: Floats
    forward: Floats
    height: float

    def point(self, left: float, up: float, forward: float) -> Floats:
        """(3,) position so many picture heights from the centre."""
        offset = left * self.left + up * self.up + forward * self.forward
        position: Floats = self.centre + self.height * offset
        return position


def framing_of(obj: Object, *, world: Floats | None = None) -> Framing:
    """How to frame the face of `obj`: by its feature points, or by its bounding box where it has none.

    Parameters
    ----------
    world : (4, 4) from its own coordinates to the world's; by default where it stands now.
    """
    local = meshes.rest_vertices(obj.data, as_found(obj.data))
    world = meshes.world_matrix(obj) if world is None else world
    vertices = local @ world[:3, :3].T + world[:3, 3]
    points = _world_points(obj, local, world)
    if points is None:
        axes = world[:3, :3] / np.maximum(np.linalg.norm(world[:3, :3], axis=0), 1e-12)
        spread = (vertices @ axes).max(axis=0) - (vertices @ axes).min(axis=0)
        centre = 0.5 * (vertices.max(axis=0) + vertices.min(axis=0))
        return Framing(centre, axes[:, 0], axes[:, 2], -axes[:, 1], 1.15 * float(max(spread[0], spread[2], 1e-6)))
    eye_left = np.mean([points[name] for name in EYES_LEFT], axis=0)
    eye_right = np.mean([points[name] for name in EYES_RIGHT], axis=0)
    eyes, chin = 0.5 * (eye_left + eye_right), points[CHIN]
    left = (eye_left - eye_right) / np.linalg.norm(eye_left - eye_right)
    down = (chin - eyes) - left * float((chin - eyes) @ left)
    forward = np.cross(left, -down)
    forward /= np.linalg.norm(forward)
    forward, up = _level(forward, -down / np.linalg.norm(down), world)
    length = float(np.linalg.norm(chin - eyes))
    heights = (vertices - eyes) @ up
    top = min(float(heights.max()), 1.35 * length)
    bottom = max(float(heights.min()), -1.5 * length)
    centre = eyes + up * 0.5 * (top + bottom)
    return Framing(centre, left, up, np.cross(left, up), 1.08 * (top - bottom))


def _level(forward: Floats, up: Floats, world: Floats) -> tuple[Floats, Floats]:
    """Use the object's own upright where the face nearly has it: a chin lies behind the eyes' plane."""
    upright = world[:3, 2] / max(float(np.linalg.norm(world[:3, 2])), 1e-12)
    if float(up @ upright) < 0.85:
        return forward, up
    level = forward - upright * float(forward @ upright)
    return level / np.linalg.norm(level), upright


def _world_points(obj: Object, local: Floats, world: Floats) -> dict[str, Floats] | None:
    """The framing feature points in the world, or None where one is missing."""
    if not has_points(obj):
        return None
    stored = stored_points(obj, local)
    needed = (*EYES_LEFT, *EYES_RIGHT, CHIN)
    if any(name not in stored for name in needed):
        return None
    found = {}
    for name in needed:
        point = stored[name]
        position = local[point] if isinstance(point, int) else np.asarray(point, dtype=np.float64)
        found[name] = world[:3, :3] @ position + world[:3, 3]
    return found
