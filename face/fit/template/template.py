"""The template that is laid onto a mesh: a skin like the default head's, its feature points and its loops."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy import sparse

from ....arrays import Bools, Floats, Ints
from ....physics.mesh import Sparse
from ....resources import PRESETS
from ...default_head.cage import EYE_RIM, MOUTH_RIM, Region, ring_name
from ...default_head.eyes import build_eyeball
from ...default_head.figures import EyeballFigures, read_figures
from ...default_head.points import skin_points
from ...default_head.skin import HeadSkin, build_skin
from ...mesh.parts import Part
from ...mesh.points import closest_on_triangles
from ..surface.cloud import Cloud, Surface, first_hits, sample

#: The figures of the template; those of the default head, which is made to be looked at, are its own.
TEMPLATE_FIGURES = PRESETS / "heads" / "template.toml"

#: What cannot be seen from outside follows the rest.
HIDDEN = (Region.LID_RIM, Region.UNDER_LID, Region.MOUTH_BAG, Region.NOSTRIL, Region.NOSTRIL_DEPTH)
#: Shortest edge that a cage edge counts as, metres; and the length for which an edge's weight is 1.
SHORT_EDGE, UNIT_EDGE = 1.5e-3, 1e-3
CLOUD_SIZE = 60_000
#: The face proper, seen from the front, lies before this.
FACE_FRONT = -45e-3


@dataclass(frozen=True, eq=False)
class Ring:
    """A closed line of cage nodes round an opening, and one farther out on the skin.

    Attributes
    ----------
    margin : (N,) cage nodes along the opening; 0 is the first corner.
    outside : (N,) cage nodes farther out.
    second_corner : place of the other corner in `margin`; nodes between the corners are the upper edge.
    """

    margin: Ints
    outside: Ints
    second_corner: int


@dataclass(frozen=True, eq=False)
class FitTemplate:
    """A head as something to lay onto a mesh; metres, x left, y back, z up.

    Attributes
    ----------
    skin : its skin; `skin.cage_matrix` (V, C) carries cage displacements to the skin.
    cage_mirror : (C,) the node on the other side.
    laplacian : (C, C) differences along the cage's edges, stronger along short ones.
    surface : its skin as a triangulated surface.
    exterior : (V,) which skin vertices can be seen.
    front : (V,) which of them belong to the face seen from the front.
    names : feature points on the skin, in the order of `points`.
    points : (P, V) weights that read them off the skin.
    twins : feature point -> the one on the other side; points of the middle have none.
    cloud : the visible head, eyeballs included, as points seen from the front.
    rings : "eye_l", "eye_r", "mouth".
    hinge : (3,) the middle of the jaw's hinge.
    eyeball : the left eyeball, as part of the cloud.
    jaw_degrees : how far its jaw is open.
    """

    skin: HeadSkin
    cage_mirror: Ints
    laplacian: Sparse
    surface: Surface
    exterior: Bools
    front: Bools
    names: tuple[str, ...]
    points: Sparse
    twins: Mapping[str, str]
    cloud: Cloud
    rings: Mapping[str, Ring]
    hinge: Floats
    eyeball: EyeballFigures
    jaw_degrees: float = 0.0

    def read(self, values: Floats, names: Sequence[str] | None = None) -> Floats:
        """(P, k) values at the feature points, or at some of them, of values (V, k) of the skin."""
        rows = self.points if names is None else self.points[[self.names.index(name) for name in names]]
        return np.asarray(rows @ values, dtype=np.float64)


@lru_cache(maxsize=1)
def fit_template() -> FitTemplate:
    """The template, built once."""
    figures = read_figures(TEMPLATE_FIGURES)
    skin = build_skin(figures)
    surface = Surface.from_polygons(skin.vertices, skin.quads)
    exterior = ~_hidden(skin)
    places = skin_points(figures, skin)
    return FitTemplate(
        skin=skin,
        cage_mirror=np.asarray(skin.cage.mirror),
        laplacian=_laplacian(skin),
        surface=surface,
        exterior=exterior,
        front=front_of(surface, exterior),
        names=tuple(places),
        points=_point_rows(places, surface),
        twins={**figures.point_pairs, **{right: left for left, right in figures.point_pairs.items()}},
        cloud=front_cloud(skin, figures.eyeball),
        hinge=figures.condyle,
        eyeball=figures.eyeball,
        rings=_rings(skin),
    )


def front_of(surface: Surface, exterior: Bools) -> Bools:
    """(V,) which visible vertices belong to the face seen from the front."""
    x, y, z = surface.vertices.T
    seen = first_hits(y, x, z, pixel=4e-3, tolerance=4e-3)
    front: Bools = exterior & (y < FACE_FRONT) & (surface.normals[:, 1] < -0.1) & seen
    return front


def _hidden(skin: HeadSkin) -> Bools:
    """(V,) vertices that only belong to hidden regions, or lie inside the lips."""
    hidden = np.ones(len(skin.vertices), dtype=bool)
    shown = np.array([region not in HIDDEN for region in skin.regions])
    hidden[np.unique(skin.quads[shown])] = False
    inner = [skin.node_index[ring_name("mouM0", k)] for k in range(len(MOUTH_RIM))]
    inner += [int(skin.mirror[node]) for node in inner]
    hidden[np.unique(skin.quads[np.isin(skin.quads, inner).any(axis=1)])] = True
    margin = [skin.node_index[ring_name("mouM1", k)] for k in range(len(MOUTH_RIM))]
    hidden[margin + [int(skin.mirror[node]) for node in margin]] = False
    return hidden


def _laplacian(skin: HeadSkin) -> Sparse:
    """(C, C) sum over a node's edges of its difference to the neighbour over the edge's length."""
    count = len(skin.cage.names)
    ends = skin.cage_edges.ends
    length = np.linalg.norm(skin.vertices[ends[:, 0]] - skin.vertices[ends[:, 1]], axis=1)
    weight = UNIT_EDGE / np.maximum(length, SHORT_EDGE)
    across = sparse.coo_array((weight, (ends[:, 0], ends[:, 1])), shape=(count, count)).tocsr()
    across = across + across.T
    return sparse.csr_array(sparse.diags_array(np.asarray(across.sum(axis=1)).ravel()) - across)


def _point_rows(places: Mapping[str, int | Floats], surface: Surface) -> Sparse:
    """(P, V) a row of weights for each point."""
    rows, columns, values = [], [], []
    corners = surface.vertices[surface.triangles]
    for row, place in enumerate(places.values()):
        if isinstance(place, int):
            found, weights = np.array([place]), np.ones(1)
        else:
            every, distance = closest_on_triangles(place, corners)
            nearest = int(distance.argmin())
            found, weights = surface.triangles[nearest], every[nearest]
        rows += [row] * len(found)
        columns += found.tolist()
        values += weights.tolist()
    return sparse.csr_array((values, (rows, columns)), shape=(len(places), len(surface.vertices)))


def front_cloud(skin: HeadSkin, eyeball: EyeballFigures) -> Cloud:
    """Skin and eyeballs of the template as points seen from the front, without the mouth's inside."""
    left = build_eyeball(eyeball)
    balls = left, left.mirrored(Part.EYEBALL_R)
    first = np.cumsum([len(skin.vertices), *(len(ball.vertices) for ball in balls)])
    vertices = np.concatenate([skin.vertices, *(ball.vertices for ball in balls)])
    quads = np.concatenate([skin.quads, *(ball.quads + start for ball, start in zip(balls, first, strict=False))])
    cloud = sample(Surface.from_polygons(vertices, quads), CLOUD_SIZE)
    p = cloud.positions
    bag = np.zeros(len(quads), dtype=bool)
    bag[: len(skin.regions)] = [region is Region.MOUTH_BAG for region in skin.regions]
    seen = first_hits(p[:, 1], p[:, 0], p[:, 2], pixel=3e-3, tolerance=3e-3)
    return cloud.take(seen & ~bag[cloud.triangles // 2])  # quads have two triangles each


def _rings(skin: HeadSkin) -> dict[str, Ring]:
    """The lid margins and the line where the lips meet, with rings outside them."""
    index = {name: i for i, name in enumerate(skin.cage.names)}
    mirror = skin.cage.mirror
    lash, orbit = (np.array([index[ring_name(f"eye{r}", k)] for k in range(len(EYE_RIM))]) for r in ("E2", "E4"))
    inner, outer = (np.array([index[ring_name(f"mou{r}", k)] for k in range(len(MOUTH_RIM))]) for r in ("M1", "M4"))
    whole = [_from_right_corner(half, mirror) for half in (inner, outer)]
    return {
        "eye_l": Ring(lash, orbit, 8),
        "eye_r": Ring(mirror[lash], mirror[orbit], 8),
        "mouth": Ring(whole[0], whole[1], len(MOUTH_RIM) - 1),
    }


def _from_right_corner(half: Ints, mirror: Ints) -> Ints:
    """A closed line from its left half: right corner, upper edge, left corner, lower edge."""
    corner = len(half) // 2
    upper, lower = half[:corner], half[corner + 1 :]
    ring: Ints = np.concatenate(
        [mirror[half[corner:0:-1]], upper, half[corner : corner + 1], lower, mirror[lower[-2::-1]]]
    )
    return ring
