"""The neutral mesh of a face, checked and turned into head space: what everything else of a face is built from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ...arrays import Floats, Ints
from ...polygons import PolygonTable
from .fap_units import Fapu
from .head_frame import HeadFrame
from .points import FeaturePoints
from .weld import Weld

#: The part of a vertex that another one stands for: it belongs to nothing, and goes where that one goes.
COPY = -1


@dataclass(frozen=True, eq=False)
class FaceMesh:
    """The neutral mesh of a face in head space.

    Attributes
    ----------
    positions : (V, 3) metres. polygons : seams welded. parts : (V,) numbers of `Part`, or `COPY`.
    seams : which vertices are one.
    points : bound feature points (their positions in the face's own coordinates).
    landmarks : feature point -> (3,) in head space.
    head_frame, units : where the head is, and its FAP units.
    """

    positions: Floats
    polygons: PolygonTable
    parts: Ints
    points: FeaturePoints
    landmarks: Mapping[str, Floats]
    head_frame: HeadFrame
    units: Fapu
    seams: Weld

    def with_copies(self, vertices: Ints) -> Ints:
        """Some vertices (n,) and their copies."""
        return np.flatnonzero(np.isin(self.seams.leads, vertices)) if len(self.seams.copies) else vertices
