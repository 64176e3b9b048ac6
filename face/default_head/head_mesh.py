"""The finished default head as plain arrays."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ...arrays import Floats, Ints
from ...errors import ModelError


@dataclass(frozen=True)
class Material:
    """A surface colour.

    Attributes
    ----------
    name : short name, such as "skin".
    colour : base colour, linear RGB, each 0..1.
    roughness : 0 (mirror) .. 1 (chalk).
    metallic : 0 (skin) .. 1 (metal); highlights of a metal have its colour, so that a black one has none.
    """

    name: str
    colour: tuple[float, float, float]
    roughness: float
    metallic: float = 0.0


@dataclass(frozen=True, eq=False)
class HeadMesh:
    """A head: skin first, then eyeballs, teeth, tongue and brows; quads throughout, outward winding.

    +X is the subject's left, the face looks along -Y, +Z is up.

    Attributes
    ----------
    vertices : (V, 3) float64, metres.
    polygons : (F,) tuples of four vertex indices.
    parts : (V,) int64 of `face.parts.Part`; lids, lips, mouth bag are SKIN, brows are OTHER.
    materials : what `material_index` counts.
    material_index : (F,) int64.
    points : feature point ("8.4") -> a vertex index, or a position (3,) in metres. Left is the subject's left.
        7.1 is a position inside the head, 11.5 is 11.4 (the head is bald), 3.5 and 3.6 are vertices of the eyeballs.
    groups : name -> vertex indices; loops are in order (see `assembly`).
    figures : cage node name ("r03c07", "eyeE2_04.R") -> vertex index.
    mirror : (V,) int64, the vertex on the other side of the midline.
    landmarks : name -> (3,) metres: eyeball centres and the middle of the jaw hinge.
    """

    vertices: Floats
    polygons: tuple[tuple[int, ...], ...]
    parts: Ints
    materials: tuple[Material, ...]
    material_index: Ints
    points: Mapping[str, int | Floats]
    groups: Mapping[str, Ints]
    figures: Mapping[str, int]
    mirror: Ints
    landmarks: Mapping[str, Floats]

    def __post_init__(self) -> None:
        count = len(self.vertices)
        if self.vertices.shape != (count, 3) or not np.isfinite(self.vertices).all():
            raise ModelError("a head's vertices must be finite and of shape (V, 3)")
        if self.parts.shape != (count,) or self.mirror.shape != (count,):
            raise ModelError("a head needs one part and one mirror vertex for every vertex")
        if self.material_index.shape != (len(self.polygons),):
            raise ModelError("a head needs one material index for every polygon")
        if any(not isinstance(point, int) and np.shape(point) != (3,) for point in self.points.values()):
            raise ModelError("a feature point must be a vertex index or a position (3,)")

    def position(self, point: str) -> Floats:
        """Position (3,) of a feature point, metres.

        Raises
        ------
        ModelError : a point this head does not carry.

        Examples
        --------
        >>> api.build_default_head().position("8.3").shape  # the left corner of the mouth
        (3,)
        """
        if point not in self.points:
            raise ModelError(f"the head has no feature point {point!r}; it has {', '.join(sorted(self.points))}")
        place = self.points[point]
        return np.array(self.vertices[place] if isinstance(place, int) else place, dtype=np.float64)
