"""Where an object lies about a face, and what its shape tells."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache, cached_property
from typing import TYPE_CHECKING

import numpy as np

from ...arrays import Floats, Ints
from ...face.mesh.parts import Part
from ...polygons import PolygonTable
from ...tables import read_toml
from .. import mesh as meshes
from ..blender_types import Object, Scene
from ..companions import Companion, placements
from ..points.stored import stored_points
from .habits import TABLE
from .kinds import Follows

if TYPE_CHECKING:
    from scipy.spatial import cKDTree

MM = 1e-3
#: So many vertices of an object are looked at where not all are needed.
SAMPLE = 3000
#: An object of more vertices is not told by its shape: no eye and no tooth has as many.
MOST = 200_000

EYE_CORNERS = (("3.7", "3.11"), ("3.8", "3.12"))
_KINDS = {
    Follows.EYES: (Part.EYEBALL_L, Part.EYEBALL_R),
    Follows.TEETH: (Part.TEETH_UPPER, Part.TEETH_LOWER),
    Follows.TONGUE: (Part.TONGUE,),
}


@cache
def _figure(name: str) -> Floats:
    """A figure of [places]: one number or several, lengths in metres."""
    row = read_toml(TABLE).table("places").table(name)
    values = np.atleast_1d(row.numbers("value", None) if name in ("low", "high", "face") else row.number("value"))
    return np.asarray(values * (MM if row.text("unit") == "mm" else 1.0))


@dataclass(frozen=True, eq=False)
class Surroundings:
    """A head, and places about it in head space (`face.mesh.head_frame`), metres.

    Attributes
    ----------
    obj : the head. landmarks : feature point -> (3,). skin : (V, 3) its vertices.
    to_head : (4, 4) from metres in the head's axes to head space.
    """

    obj: Object
    landmarks: Mapping[str, Floats]
    skin: Floats
    to_head: Floats
    scene: Scene | None

    @classmethod
    def of(cls, obj: Object, scene: Scene | None = None) -> Surroundings:
        """Those of a head with feature points.

        Raises
        ------
        SceneError, ModelError : see `placements`; points that are no face's.
        """
        from ...face.mesh.checks import with_pupils
        from ...face.mesh.head_frame import head_frame_of

        to_metres = placements(obj, (), scene)[0]
        rest = meshes.rest_vertices(obj.data)
        vertices = rest @ to_metres[:3, :3].T
        points = {
            name: vertices[place] if isinstance(place, int) else to_metres[:3, :3] @ np.asarray(place)
            for name, place in with_pupils(stored_points(obj), rest).items()
        }
        frame = head_frame_of(points)
        to_head = np.eye(4)
        to_head[:3, :3] = frame.axes / frame.scale
        to_head[:3, 3] = -to_head[:3, :3] @ frame.origin
        landmarks = {name: frame.to_head(place) for name, place in points.items()}
        return cls(obj, landmarks, frame.to_head(vertices), to_head, scene)

    def placed(self, other: Object, places: Floats) -> Floats:
        """(n, 3) places of another object in head space."""
        matrix = self.to_head @ placements(self.obj, (Companion(other, Part.OTHER),), self.scene)[1]
        return np.asarray(places @ matrix[:3, :3].T + matrix[:3, 3])

    def meets(self, other: Object) -> bool:
        """Whether the box of another object meets the head's. Cheap."""
        corners = self.placed(other, np.array([tuple(corner) for corner in other.bound_box]))
        return bool((corners.min(axis=0) < _figure("high")).all() and (corners.max(axis=0) > _figure("low")).all())

    @cached_property
    def near(self) -> cKDTree[None]:
        """The head's vertices, to be searched."""
        from scipy.spatial import cKDTree

        return cKDTree(self.skin)

    def told(self, other: Object, named: Follows | None) -> Follows | None:
        """How another object that meets the head's box follows the face; None where it does not belong to it.

        `named` is what its names say, which is believed where it lies as such a thing does.
        """
        positions = self.placed(other, meshes.rest_vertices(other.data))
        sample = positions[:: max(len(positions) // SAMPLE, 1)]
        within = float(((sample > _figure("low")) & (sample < _figure("high"))).all(axis=1).mean())
        if within < _figure("hair_within" if named is Follows.SKULL else "within"):
            return None
        if named is not None and self._fits(sample, named):
            return named
        return self._by_shape(other, positions, sample)

    def _fits(self, sample: Floats, named: Follows) -> bool:
        """Whether what has some name lies (n, 3) where such a thing does."""
        if named is Follows.SKULL:
            return True
        if named is Follows.SKIN:
            return bool(np.median(self.near.query(sample)[0]) < _figure("skin"))
        eyes = [(self.landmarks[a] + self.landmarks[b]) / 2.0 for a, b in EYE_CORNERS]
        lips = [(self.landmarks["2.2"] + self.landmarks["2.3"]) / 2.0]
        anchors, reach = (eyes, "eyes") if named in (Follows.EYES, Follows.EYE_L, Follows.EYE_R) else (lips, "mouth")
        away = np.min([np.linalg.norm(sample - anchor, axis=1) for anchor in anchors], axis=0)
        return bool(np.median(away) < _figure(reach)) or named is Follows.SEVERAL

    def _by_shape(self, other: Object, positions: Floats, sample: Floats) -> Follows:
        """How what no name tells follows the face: by the parts that its pieces are, else by where it lies."""
        from ...face.mesh.segmentation import derive_parts

        polygons = PolygonTable(*meshes.polygon_arrays(other.data))
        if len(positions) < MOST:
            # Points of a tongue would find one in the gums of an object without.
            landmarks = {name: place for name, place in self.landmarks.items() if not name.startswith("6.")}
            told = _told_by(derive_parts(positions, polygons, landmarks, None))
            if told is not None:
                return told
        below, above, behind = _figure("face")
        in_face = (sample[:, 1] > below) & (sample[:, 1] < above) & (sample[:, 2] > behind)
        on_skin = np.median(self.near.query(sample)[0]) < _figure("on_skin")
        return Follows.SKIN if on_skin and np.median(in_face) else Follows.SKULL


def _told_by(parts: Ints) -> Follows | None:
    """How an object of these parts (V,) follows the face; None where they are mostly not known."""
    shares = {follows: float(np.isin(parts, kinds).mean()) for follows, kinds in _KINDS.items()}
    if sum(shares.values()) < _figure("known"):
        return None
    present = [follows for follows, share in shares.items() if share >= _figure("also")]
    return present[0] if len(present) == 1 else Follows.SEVERAL
