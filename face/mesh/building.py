"""The mesh of a face made from what is given, step by step: welded, its points bound, its parts told."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial import cKDTree

from ...arrays import Floats
from ...errors import ModelError
from ...physics.mesh import Polygons, fans
from ...polygons import PolygonTable
from ...progress import Progress, Work, part_of, run
from .checks import checked_axes, checked_parts, known_parts, with_pupils
from .face_mesh import COPY, FaceMesh
from .fap_units import fapu
from .head_frame import head_frame_of
from .parts import Part, Told
from .points import PointSource, bind_points, check_sides
from .sewn import sewn_steps
from .weld import weld_steps


def face_mesh_steps(
    vertices: Floats,
    polygons: PolygonTable,
    points: Mapping[str, PointSource],
    parts: ArrayLike | None,
    axes: ArrayLike | None,
) -> Work[FaceMesh]:
    """The mesh of a face; parameters and errors as for `Face.from_arrays`, vertices and polygons checked."""
    seams = yield from part_of(weld_steps(vertices, polygons), 0.0, 0.5)
    yield Progress(0.5, "Placing the feature points")
    sources, triangles = seams.of_leads(with_pupils(points, vertices)), fans(seams.polygons)[0]
    yield Progress(0.5, "Placing the feature points")
    told = checked_parts(parts, len(vertices))
    may_be_skin = np.isin(told, (Part.SKIN, Told.ANYTHING))
    bound = yield from part_of(bind_points(sources, vertices, triangles, may_be_skin), 0.5, 0.5)
    positions = bound.positions()
    head_frame = head_frame_of(positions, None if axes is None else checked_axes(axes))
    landmarks = {name: head_frame.to_head(position) for name, position in positions.items()}
    check_sides(landmarks)
    units, head = fapu(positions, head_frame.axes), head_frame.to_head(vertices)
    yield Progress(0.5, "Telling skin, eyes and teeth apart")
    given = known_parts(told, head, seams.polygons, landmarks, bound)
    yield Progress(0.5, "Placing the feature points")
    if (told < 0).any():
        bound = yield from part_of(bind_points(sources, vertices, triangles, given == Part.SKIN), 0.5, 1.0)
    given[seams.copies] = COPY
    return FaceMesh(head, seams.polygons, given, bound, landmarks, head_frame, units, seams)


def sewn_among(vertices: Floats, polygons: Polygons, places: Mapping[str, Floats]) -> frozenset[str]:
    """Which openings of a mesh (V, 3) are sewn, by its feature points' places (3,): `Face.sewn` without a face."""
    return run(sewn_among_steps(vertices, polygons, places))


def sewn_among_steps(vertices: Floats, polygons: Polygons, places: Mapping[str, Floats]) -> Work[frozenset[str]]:
    """As `sewn_among`, bit by bit."""
    try:
        frame = head_frame_of({name: np.asarray(place) for name, place in with_pupils(places, vertices).items()})
    except ModelError:
        return frozenset()  # said where the face is made
    points = {name: frame.to_head(place) for name, place in places.items()}
    seams = yield from part_of(weld_steps(vertices, polygons), 0.0, 0.5)
    positions = frame.to_head(vertices)
    used = np.unique(seams.polygons.loops)
    _, near = cKDTree(positions[used]).query(np.array(list(points.values())))
    nearest = dict(zip(points, used[near].tolist(), strict=True))
    return (yield from part_of(sewn_steps(positions, seams.polygons, nearest, points), 0.5, 1.0))
