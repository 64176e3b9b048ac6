"""Feature points of any head: known topology, or the template laid onto the mesh."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...arrays import Floats, Ints
from ...errors import ModelError, ParameterError
from ...physics.mesh import Polygons, corners, triangulate, vertex_normals
from ...progress import Progress, Work, part_of, run
from ..mesh.checks import checked_polygons, checked_vertices
from .bending.carry import RIM_POINTS, carry
from .bending.fitted import fit
from .bending.painted_brows import Look
from .bending.target import head_target
from .clicks import (
    FEWEST,
    checked_clicks,
    click_misses,
    click_wishes,
    pose_from_clicks,
    refuse_clicks_off,
)
from .doubt import DOUBTFUL, DOUBTFUL_SCORE
from .locating.align import align
from .locating.boxes import HEAD_BOX, box_cloud
from .locating.crooked import Start, better_start, starting_bend
from .locating.head_pose import HeadPose
from .locating.locate import HEAD, Located, locate, looks_backwards, scored
from .surface.cloud import Surface
from .surface.paint import Paint
from .template.template import FitTemplate, fit_template
from .topologies import Topology, load_topologies, recognise_topology

#: Vertices nearer to each other than this share of the mesh's diagonal are one: exporters split them along seams.
SAME_PLACE = 1e-6
#: Bits that hold how many times that goes into the diagonal.
CELL_BITS = 20
#: Alignment is kept only while it moves no click farther off than this, metres, or by this ratio.
CLICK_DRIFT, CLICK_RATIO = 8e-3, 1.5
#: A click on a corner of eye or mouth that lies this near to the corner that was found means that one, metres.
CLICK_SNAP = 4e-3


@dataclass(frozen=True, eq=False)
class FoundPoints:
    """Feature points found on a mesh.

    Attributes
    ----------
    positions : name -> (3,) on the surface, in the mesh's own coordinates.
    confidence : name -> 0 .. 1; below about 0.5 a point wants to be looked at.
    score : how little the mesh looks like a face: 0 is the template itself, beyond 1.6 it is refused.
    topology : name of the known topology, where the mesh was recognised by it.
    """

    positions: Mapping[str, Floats]
    confidence: Mapping[str, float]
    score: float
    topology: str | None = None

    @property
    def is_doubtful(self) -> bool:
        """Whether the face is so unlike the template that every point wants to be looked at, or a few clicks given."""
        return self.score > DOUBTFUL_SCORE

    @property
    def doubtful(self) -> tuple[str, ...]:
        """Points that want to be looked at, by group and number."""
        unsure = (name for name, confidence in self.confidence.items() if confidence < DOUBTFUL)
        return tuple(sorted(unsure, key=lambda name: [int(part) for part in name.split(".")]))


def find_points(
    vertices: ArrayLike,
    polygons: Polygons,
    clicks: Mapping[str, Sequence[float] | Floats] | None = None,
    *,
    topologies: Sequence[Topology] | None = None,
    paint: Paint | None = None,
    beside: tuple[Floats, Ints] | None = None,
) -> FoundPoints:
    """Find the feature points of a face, whichever way it looks and however large it is.

    Parameters
    ----------
    vertices : (V, 3) a head, a face or a whole body, in any unit, place and direction.
    polygons : its polygons, as for `Face.from_arrays`.
    clicks : name -> (3,) points that are known; four or more also say where the face is.
    topologies : known connectivities; None: those that come with Risorius.
    paint : how bright the mesh is painted; brows that show on it tell where the points of the brows are.
    beside : vertices (B, 3) and triangles (T, 3) of other objects, in the mesh's coordinates: brows may be among them.

    Raises
    ------
    ModelError : where there is no face; states the score, the limit and the remedy. Broken meshes; clicks off the mesh.
    ParameterError : clicks that name no point of the skin, or no place.

    Examples
    --------
    >>> head = api.build_default_head()
    >>> found = api.find_points(head.vertices, head.polygons)
    >>> face = api.Face.from_arrays(head.vertices, head.polygons, found.positions)
    >>> min(found.confidence.values()) > 0.0
    True
    """
    return run(find_points_steps(vertices, polygons, clicks, topologies=topologies, paint=paint, beside=beside))


def find_points_steps(
    vertices: ArrayLike,
    polygons: Polygons,
    clicks: Mapping[str, Sequence[float] | Floats] | None = None,
    *,
    topologies: Sequence[Topology] | None = None,
    paint: Paint | None = None,
    beside: tuple[Floats, Ints] | None = None,
) -> Work[FoundPoints]:
    """`find_points` as a generator: yields `Progress(fraction, text)`, returns the points; close it to cancel.

    Examples
    --------
    >>> head = api.build_default_head()
    >>> steps = api.find_points_steps(head.vertices, head.polygons)
    >>> next(steps).fraction < 1.0  # run it on, or close it
    True
    >>> steps.close()
    """
    yield Progress(0.0, "Reading the mesh")
    places = checked_vertices(vertices)
    faces = _checked_faces(polygons, len(places))
    yield Progress(0.0, "Reading the mesh")
    template = fit_template()
    yield Progress(0.0, "Reading the mesh")
    clicked = checked_clicks(clicks, template)
    refuse_clicks_off(places, clicked)
    known = recognise_topology(len(places), faces, load_topologies() if topologies is None else topologies)
    if known is not None:
        return _known_points(known, places, clicked)
    yield Progress(0.0, "Reading the mesh")
    surface = yield from part_of(_welded(places, faces), 0.0, 0.02)
    if len(clicked) >= FEWEST:
        start = Start(_located_by_clicks(surface, clicked, template), None)
    else:
        located = yield from part_of(locate(surface), 0.02, 0.55)
        start = yield from part_of(better_start(located), 0.55, 0.6)
    return (yield from part_of(_fitted_points(start, clicked, paint, beside), 0.6, 1.0))


@dataclass(frozen=True, eq=False)
class LocatedPoints:
    """Where the template's points come to lie before it is bent: `positions`, and the gate's `score` and `relief`."""

    positions: Mapping[str, Floats]
    score: float
    relief: float


def locate_points(vertices: ArrayLike, polygons: Polygons, *, refuse: bool = True) -> LocatedPoints:
    """Only the first half of `find_points`: where the face is, for tools that measure it.

    Parameters
    ----------
    refuse : whether what does not look like a face raises.

    Raises
    ------
    ModelError : where nothing is found; with `refuse` also what does not look like a face.
    """
    places = checked_vertices(vertices)
    surface = run(_welded(places, _checked_faces(polygons, len(places))))
    located = run(better_start(run(locate(surface, refuse=refuse)))).place
    template = located.template
    positions = located.pose.to_mesh(template.read(template.skin.vertices))
    named = dict(zip(template.names, positions, strict=True))
    return LocatedPoints(named, located.score.value, located.score.relief)


def _checked_faces(polygons: Polygons, vertex_count: int) -> Polygons:
    """Polygons in range; arrays stay arrays."""
    if not (isinstance(polygons, np.ndarray) and polygons.ndim == 2):
        return checked_polygons(polygons, vertex_count)
    if len(polygons) == 0:
        raise ModelError("the mesh has no polygons: the face needs a surface")
    try:
        corners(polygons, vertex_count)
    except ParameterError as error:
        raise ModelError(str(error)) from error
    return polygons


def _known_points(known: Topology, vertices: Floats, clicked: Mapping[str, Floats]) -> FoundPoints:
    """The stored points of a known topology; clicks replace them."""
    positions = known.places(vertices) | dict(clicked)
    return FoundPoints(positions, dict.fromkeys(positions, 1.0), 0.0, known.name)


def _welded(vertices: Floats, polygons: Polygons) -> Work[Surface]:
    """The surface with vertices of one place made one, and triangles without area left out."""
    size = float(np.linalg.norm(np.ptp(vertices, axis=0)))
    if not size > 0.0:
        raise ModelError("no face found: all vertices are in one place")
    cells = np.round((vertices - vertices.min(axis=0)) / (SAME_PLACE * size)).astype(np.int64)
    keys = (cells << np.array([2 * CELL_BITS, CELL_BITS, 0])).sum(axis=1)  # sorts several times faster than rows
    _, first, same = np.unique(keys, return_index=True, return_inverse=True)
    yield Progress(0.3, "Reading the mesh")
    triangles: Ints = first[same][triangulate(polygons)]
    a, b, c = triangles.T
    triangles = triangles[(a != b) & (b != c) & (c != a)]
    if len(triangles) == 0:
        raise ModelError("no face found: the mesh has no area; feature points need a surface")
    yield Progress(0.5, "Reading the mesh")
    return Surface(vertices, triangles, vertex_normals(vertices, triangles))


def _located_by_clicks(surface: Surface, clicked: Mapping[str, Floats], template: FitTemplate) -> Located:
    """The place that the clicks tell, aligned where that does not move it off the clicks."""
    pose = pose_from_clicks(clicked, template)
    cloud = box_cloud(surface, pose, HEAD_BOX, HEAD)
    if len(cloud) == 0:
        raise ModelError("the clicked points are off the mesh: click on its surface")
    if looks_backwards(cloud, pose):
        surface = surface.flipped()
        cloud = box_cloud(surface, pose, HEAD_BOX, HEAD)
    before = click_misses(clicked, pose, template)
    closer = align(cloud, pose, template)
    after = click_misses(clicked, closer, template)
    if all(after[name] < max(CLICK_DRIFT, CLICK_RATIO * before[name]) for name in clicked):
        pose = closer
    return Located(pose, surface, scored(surface, pose, template), template)


def _fitted_points(
    start: Start, clicked: Mapping[str, Floats], paint: Paint | None, beside: tuple[Floats, Ints] | None
) -> Work[FoundPoints]:
    """Bend the template onto the head and carry its points over."""
    located = start.place
    pose, template = located.pose, located.template
    target = yield from part_of(head_target(located.surface, pose), 0.0, 0.2)
    wishes = [click_wishes(clicked, pose, template)] if clicked else []
    fitted = yield from part_of(fit(template, target, wishes, start=starting_bend(template, start.flow)), 0.2, 0.95)
    score = located.score.value
    yield Progress(0.95, "Placing the feature points")
    pieces = _with_beside(located.surface, pose, beside)
    carried = carry(template, target, fitted, score, pieces, _seen(paint, pose))
    positions = {name: pose.to_mesh(place) for name, place in carried.positions.items()}
    confidence = dict(carried.confidence)
    for name, place in clicked.items():
        confidence[name] = 1.0
        if not _means_corner(name, place, positions[name], pose):
            positions[name] = place
    return FoundPoints(positions, confidence, score)


def _with_beside(surface: Surface, pose: HeadPose, beside: tuple[Floats, Ints] | None) -> Surface:
    """A surface and what lies beside it, in template coordinates; normals are left out."""
    vertices, triangles = surface.vertices, surface.triangles
    if beside is not None:
        triangles = np.concatenate([triangles, beside[1] + len(vertices)])
        vertices = np.concatenate([vertices, beside[0]])
    return Surface(pose.to_template(vertices), triangles, np.zeros_like(vertices))


def _seen(paint: Paint | None, pose: HeadPose) -> Look | None:
    """What is painted in a box of the template's coordinates."""
    return None if paint is None else lambda low, high: paint.within(low, high, pose.to_template)


def _means_corner(name: str, click: Floats, found: Floats, pose: HeadPose) -> bool:
    """Whether a click means the corner of eye or mouth that was found beside it."""
    is_corner = name in RIM_POINTS and RIM_POINTS[name][1] in ("left", "right")
    return is_corner and float(np.linalg.norm(click - found)) < CLICK_SNAP * pose.size
