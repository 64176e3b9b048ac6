"""Where paths of the skin are drawn from, after figure 8 of Zhang, Sung, Prakash 2001."""

from __future__ import annotations

import numpy as np

from ...arrays import Ints
from ..face import Face

#: Head space in front of which skin is the face, not the back of the head, metres.
FACE_DEPTH = -75e-3


def sampled_vertices(face: Face, spacing: float) -> Ints:
    """Vertices (k,) of the outer skin no nearer to one another than `spacing`, metres of head space; the face only.

    Each next one is the farthest from all before, so that they lie evenly whatever the mesh.
    """
    skin = face.anatomy.given_skin
    front = np.flatnonzero(skin.positions[:, 2] > FACE_DEPTH)
    chosen: list[int] = []
    far = np.full(len(front), np.inf)
    at = int(np.argmax(skin.positions[front, 2]))
    while far[at] > spacing:
        chosen.append(at)
        away = np.linalg.norm(skin.positions[front] - skin.positions[front[at]], axis=1)
        far = np.minimum(far, away)
        at = int(np.argmax(far))
    return np.asarray(skin.index[front[chosen]])
