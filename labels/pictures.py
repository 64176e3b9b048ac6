"""Pictures of what each pixel is: area of the face, object, depth, normal."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..arrays import Floats
from .areas import Areas
from .geometry import Shown
from .png import Pixels
from .raster import Drawn
from .view import View

#: A pixel of depth is a whole number of these: 65535 of them are 6.5 m. A scene that is deeper takes ten times as much.
DEPTH_STEP, MOST = 1e-4, 65535
#: A normal's components from -1 to 1 are 0 to this.
FULL = 65535.0


def depth_step(depth: Floats) -> float:
    """Metres that 1 in a picture of depth stands for: 0.1 mm, or a power of ten more where that is not enough."""
    there = depth[np.isfinite(depth)]
    most = float(there.max()) if len(there) else 0.0
    step = DEPTH_STEP
    while most > MOST * step:
        step *= 10.0
    return step


def pictures_of(view: View, shown: Shown, drawn: Drawn, areas: Areas) -> Iterator[tuple[str, Pixels]]:
    """Name and figures (height, width) or (height, width, 3) of each picture."""
    yield "areas", areas.of(shown, drawn).astype(np.uint8)
    yield "objects", np.where(drawn.there, shown.owner[drawn.triangle] + 1, 0).astype(np.uint16)
    depth = np.where(drawn.there, drawn.depth, 0.0) / depth_step(drawn.depth)
    yield "depth", np.rint(depth).astype(np.uint16)
    normals = np.where(drawn.there[..., None], (normals_of(view, shown, drawn) + 1.0) / 2.0 * FULL, 0.0)
    yield "normals", np.rint(normals).astype(np.uint16)


def normals_of(view: View, shown: Shown, drawn: Drawn) -> Floats:
    """(height, width, 3) unit normals as shaded, in the camera's axes, on the side that is seen; 0 where nothing is."""
    normals = np.zeros((*drawn.triangle.shape, 3))
    which = drawn.triangle[drawn.there]
    shaded = np.einsum("pk,pki->pi", drawn.shares[drawn.there], shown.normals[which]) @ view.rotation.T
    a, b, c = (view.before(shown.vertices)[shown.triangles[which, k]] for k in range(3))
    away = (np.cross(b - a, c - a) * view.toward(a)).sum(axis=1) > 0.0
    shaded[away] *= -1.0
    length = np.linalg.norm(shaded, axis=1, keepdims=True)
    normals[drawn.there] = shaded / np.where(length > 0.0, length, 1.0)
    return normals
