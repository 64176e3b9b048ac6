"""How much what is seen from the front looks like a face, and what is refused."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ....arrays import Floats
from ..surface.depth_map import DEPTH_CLIP, depth_map, in_oval, relief
from ..template.open_mouth import open_template
from ..template.template import FitTemplate

#: Mean difference in depth that costs one point.
DEPTH_UNIT = 4e-3
#: From this score on a mesh is refused; beneath it, from this agreement of relief on, it is accepted.
SCORE_LIMIT, RELIEF_LIMIT = 1.6, 0.6
#: Less of the face's oval than this tells nothing.
ENOUGH = 0.3


@dataclass(frozen=True)
class FaceScore:
    """How well a mesh in template coordinates agrees with the template; 0 is perfect.

    Attributes
    ----------
    depth : mean difference in depth over the oval, metres of the template.
    relief : correlation of the finer shape (eyes, nose, mouth), -1 .. 1.
    coverage : share of the oval that the mesh covers.
    """

    depth: float
    relief: float
    coverage: float

    @property
    def value(self) -> float:
        """The gate's figure."""
        return self.depth / DEPTH_UNIT + 2.0 * (1.0 - self.relief) + 2.0 * (1.0 - self.coverage)

    @property
    def is_face(self) -> bool:
        """Whether that is enough to be a face."""
        return self.value <= SCORE_LIMIT and self.relief >= RELIEF_LIMIT


def face_score(positions: Floats, template: FitTemplate) -> FaceScore:
    """The score of points (N, 3) spread over a mesh, in template coordinates, against a template."""
    depth, own = depth_map(positions), _own_depth(template.jaw_degrees)
    oval = in_oval() & np.isfinite(own)
    known = np.isfinite(depth) & np.isfinite(own)
    both = known & oval
    if both.sum() < ENOUGH * oval.sum():
        return FaceScore(DEPTH_CLIP, 0.0, float(both.sum() / oval.sum()))
    difference = (depth - own)[both]
    difference = difference - np.median(difference)
    a, b = relief(depth, known)[both], relief(own, known)[both]
    spread = a.std() * b.std()
    agreement = float(((a - a.mean()) * (b - b.mean())).mean() / spread) if spread > 0.0 else 0.0
    return FaceScore(
        depth=float(np.minimum(np.abs(difference), DEPTH_CLIP).mean()),
        relief=agreement,
        coverage=float(both.sum() / oval.sum()),
    )


@lru_cache(maxsize=4)
def _own_depth(jaw_degrees: float) -> Floats:
    """The template's own depth map."""
    return depth_map(open_template(jaw_degrees).cloud.positions)
