"""The neutral mesh of a face, checked and turned into head space: what everything else of a face is built from."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from ...arrays import Floats, Ints
from .fap_units import Fapu
from .head_frame import HeadFrame
from .points import FeaturePoints


@dataclass(frozen=True)
class FaceMesh:
    """The neutral mesh of a face in head space.

    Attributes
    ----------
    positions : (V, 3) metres. polygons : vertex index arrays. parts : (V,) numbers of `Part`.
    points : bound feature points (their positions in the face's own coordinates).
    landmarks : feature point -> (3,) in head space.
    head_frame, units : where the head is, and its FAP units.
    """

    positions: Floats
    polygons: Sequence[Ints]
    parts: Ints
    points: FeaturePoints
    landmarks: Mapping[str, Floats]
    head_frame: HeadFrame
    units: Fapu
