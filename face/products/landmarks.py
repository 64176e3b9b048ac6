"""Landmarks of other conventions on any head: MediaPipe's 478, and the 68 of iBUG.

Where MediaPipe sees its landmarks was measured on neutral heads, as places on the template face (presets/capture). A
face's own feature points carry them over; then they are bound to its skin, those of lids and lips to its margins,
those of irises to its eyeballs. So they move with it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy import sparse

from ...arrays import Floats, Ints
from ...mpeg4.streams.capture import CAPTURE_PRESETS
from ...physics import mesh
from ...physics.mesh import Sparse
from ...tables import TomlTable, read_csv, read_toml
from ..face import Face
from ..mesh.own_lip import own_lips
from ..mesh.parts import Part
from ..mesh.points import BoundPoint, bound_places
from ..mesh.template import MM, TemplateWarp

COUNT = 478
#: Directions of the border of an iris from the pupil: to the subject's left, up, right, down.
AROUND = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))


@dataclass(frozen=True, eq=False)
class Landmarks:
    """Landmarks of one face.

    Attributes
    ----------
    matrix : (478, V) reads MediaPipe's landmarks off the face's vertices; a row of nothing where it has no such one:
        irises of a face without eyeballs.
    ibug68 : (68,) which of them are those of iBUG. parts : (68,) part of the face of each of these ("jaw").
    lip_border : which of them run round the vermilion, from the right corner over the upper lip.
    """

    matrix: Sparse
    ibug68: Ints
    parts: Sequence[str]
    lip_border: Ints


def face_landmarks(face: Face) -> Landmarks:
    """MediaPipe's 478 landmarks, and iBUG's 68 among them, bound to a face.

    Examples
    --------
    >>> face = api.default_face()
    >>> marks = api.face_landmarks(face)
    >>> places = marks.matrix @ face.pose(api.expression("joy").frame()).positions
    >>> places.shape, places[marks.ibug68].shape
    ((478, 3), (68, 3))
    """
    bound = _on_skin(face) | _on_margins(face) | _on_irises(face)
    rows = [(number, vertex, weight) for number, each in bound.items() for vertex, weight in _held(each)]
    row, column, weight = zip(*rows, strict=True)
    matrix = sparse.csr_array((weight, (row, column)), shape=(COUNT, len(face.vertices)))
    of_ibug = _sets().table("ibug68")
    numbers = {part: [int(number) for number in of_ibug.numbers(part)] for part in of_ibug}
    return Landmarks(
        matrix,
        np.array([number for each in numbers.values() for number in each]),
        [part for part, each in numbers.items() for _ in each],
        np.array(_sets().table("lips").numbers("border"), dtype=np.int64),
    )


@lru_cache(maxsize=1)
def _sets() -> TomlTable:
    """Which landmarks are what."""
    return read_toml(CAPTURE_PRESETS / "landmark_sets.toml")


@lru_cache(maxsize=1)
def template_places() -> Mapping[int, Floats]:
    """Landmark -> (3,) on the template face in head space, metres."""
    rows = read_csv(CAPTURE_PRESETS / "mediapipe_places.csv", "landmark", "left_mm", "up_mm", "forward_mm", "off_mm")
    return {
        row.integer("landmark"): MM * np.array([row.number(f"{axis}_mm") for axis in ("left", "up", "forward")])
        for row in rows
    }


def _held(point: BoundPoint) -> list[tuple[int, float]]:
    return list(zip(point.vertices.tolist(), point.weights.tolist(), strict=True))


def _on_skin(face: Face) -> dict[int, BoundPoint]:
    """All landmarks of the face, bound to the skin that shows, those of a lip to that lip."""
    frame, skin = face.anatomy.mesh.head_frame, face.anatomy.given_skin
    points = {name: frame.to_head(point.position) for name, point in face.points.items()}
    places = TemplateWarp(points)(np.array(list(template_places().values())))
    warped = dict(zip(template_places(), places, strict=True))
    shown = skin.polygons[: len(skin.polygons) - skin.web]
    vertices, triangles = face.anatomy.mesh.positions, skin.index[mesh.triangulate(shown)]
    found = bound_places(warped, vertices, triangles)
    nearest = face.points.nearest
    size = float(np.linalg.norm(points["8.3"] - points["8.4"]))
    sides = own_lips(vertices, triangles, nearest["8.1"], nearest["8.2"], size)
    for own, name in zip(sides, ("upper", "lower"), strict=True):
        numbers = [int(number) for number in _sets().table("lips").numbers(name)]
        lip = triangles[own[triangles].all(axis=1)]
        if len(lip):
            found |= bound_places({number: warped[number] for number in numbers}, vertices, lip)
    return found


def _on_margins(face: Face) -> dict[int, BoundPoint]:
    """Landmarks of lids and of where the lips meet, on the margins, at the shares of their way that they have."""
    skin = face.anatomy.given_skin
    openings = {"mouth": skin.mouth, **skin.eyes}
    found: dict[int, BoundPoint] = {}
    for name in (margins := _sets().table("margins")):
        opening, _, arc = name.partition("_")
        numbers = [int(number) for number in margins.numbers(name)]
        along = _shares(np.array([template_places()[number] for number in numbers]))
        path: Ints = openings[opening].upper if arc == "upper" else openings[opening].lower[::-1]  # which leads back
        ways = _shares(skin.positions[path])
        for number, share in zip(numbers, along.tolist(), strict=True):
            step = min(max(int(np.searchsorted(ways, share, side="right")) - 1, 0), len(path) - 2)
            part = (share - ways[step]) / max(ways[step + 1] - ways[step], np.finfo(float).tiny)
            weights = np.array([1.0 - part, part])
            ends = path[step : step + 2]
            found[number] = BoundPoint(str(number), weights @ skin.positions[ends], skin.index[ends], weights)
    return found


def _shares(places: Floats) -> Floats:
    """(n,) shares of the way along places (n, 3), from 0 to 1."""
    ways = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(places, axis=0), axis=1)))
    shares: Floats = ways / ways[-1] if ways[-1] > 0.0 else np.linspace(0.0, 1.0, len(places))
    return shares


def _on_irises(face: Face) -> dict[int, BoundPoint]:
    """Landmarks of pupils and irises, on the eyeballs that there are."""
    found: dict[int, BoundPoint] = {}
    triangles = mesh.triangulate(face.polygons)
    left, up, _ = face.axes
    for ball in face.eyeballs:
        side = "l" if face.parts[ball.vertices[0]] == Part.EYEBALL_L else "r"
        own = triangles[np.isin(triangles, ball.vertices).all(axis=1)]
        across = left - ball.gaze * (left @ ball.gaze)
        across /= np.linalg.norm(across)
        above = np.cross(ball.gaze, across)
        above *= np.sign(above @ up) or 1.0
        ways = [x * across + y * above for x, y in AROUND]
        border = [np.cos(ball.iris) * ball.gaze + np.sin(ball.iris) * way for way in ways]
        radius = float(np.linalg.norm(face.vertices[ball.vertices] - ball.centre, axis=1).max())
        numbers = [int(number) for number in _sets().table("irises").numbers(side)]
        places = [ball.centre + radius * way for way in (ball.gaze, *border)]
        found |= bound_places(dict(zip(numbers, places, strict=True)), face.vertices, own)
    return found
