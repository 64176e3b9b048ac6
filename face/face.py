"""One face: a neutral mesh with feature points that can be measured, posed and simulated."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Floats, Ints
from ..errors import ModelError, ParameterError
from ..mpeg4 import ARCHETYPES, FAP_COUNT, Cue
from ..physics import mesh
from .anatomy import Anatomy, Mesh
from .frame import Fapu, fapu, head_frame
from .measure import features, measure
from .muscle_fields import PlacedMuscle
from .parts import Part
from .points import FeaturePoints, PointSource, bind_points, check_sides
from .pose import Pose, Poser
from .segmentation import derive_parts
from .simulate import Simulation, cue_moments, stream_moments
from .template import TEMPLATE_POINTS
from .wishes import Drive


@dataclass(frozen=True)
class Clip:
    """A simulated clip: positions (T, V, 3) in the face's coordinates, frames per second."""

    positions: Floats
    fps: float


class Face:
    """One face. Make it with `from_arrays`; nothing in it changes afterwards."""

    def __init__(self, vertices: Floats, face_mesh: Mesh) -> None:
        self._vertices = vertices
        self.anatomy = Anatomy(face_mesh)

    @classmethod
    def from_arrays(
        cls,
        vertices: ArrayLike,
        polygons: Sequence[Sequence[int]] | ArrayLike,
        points: Mapping[str, PointSource],
        parts: ArrayLike | None = None,
    ) -> Face:
        """A face from a neutral mesh.

        Parameters
        ----------
        vertices : (V, 3) metres, any orientation and scale.
        polygons : (F, 3|4) ints, or a sequence of index sequences (three corners or more).
        points : feature point -> vertex index, or position (3,) on the surface (bound by barycentric weights). 3.5 and
            3.6 may be left out; they are then placed in the middle of each eye's opening.
        parts : (V,) numbers of `Part`, derived from connected pieces when None.

        Raises
        ------
        ModelError : names what the mesh or the points lack, and the remedy.
        """
        array = _checked_vertices(vertices)
        faces = _checked_polygons(polygons, len(array))
        sources, triangles = _with_pupils(points, array), mesh.triangulate(faces)
        skin = None if parts is None else np.asarray(parts) == Part.SKIN
        bound = bind_points(
            sources, array, triangles, skin if skin is not None and skin.shape == (len(array),) else None
        )
        positions = bound.positions()
        frame = head_frame(positions)
        landmarks = {name: frame.to_head(position) for name, position in positions.items()}
        check_sides(landmarks)
        units = fapu(positions, frame)
        head = frame.to_head(array)
        given = _parts(parts, head, faces, landmarks, bound)
        if parts is None:
            bound = bind_points(sources, array, triangles, given == Part.SKIN)
        face_mesh = Mesh(head, faces, given, bound, landmarks, frame, units)
        return cls(array, face_mesh)

    @property
    def vertices(self) -> Floats:
        """(V, 3) the neutral mesh as given."""
        return self._vertices

    @property
    def polygons(self) -> Sequence[Ints]:
        """Vertex indices of each polygon."""
        return self.anatomy.mesh.polygons

    @property
    def points(self) -> FeaturePoints:
        """Feature points bound to the mesh."""
        return self.anatomy.mesh.points

    @property
    def parts(self) -> Ints:
        """(V,) numbers of `Part`."""
        return self.anatomy.mesh.parts

    @property
    def units(self) -> Fapu:
        """FAP units in metres."""
        return self.anatomy.mesh.units

    @property
    def muscles(self) -> Mapping[str, PlacedMuscle]:
        """The placed muscles by name ("zygomaticus_major_l")."""
        return {muscle.name: muscle for muscle in self.anatomy.muscles}

    def measure(self, positions: ArrayLike) -> Floats:
        """(68,) FAPs read off deformed vertices (V, 3); NaN where the face has no such point."""
        return measure(self.anatomy, np.asarray(positions, dtype=np.float64))

    def features(self, positions: ArrayLike) -> Floats:
        """(15,) features of Table 3 of Raouzaiou et al. 2002 read off deformed vertices (V, 3)."""
        return features(self.anatomy, np.asarray(positions, dtype=np.float64))

    @cached_property
    def _poser(self) -> Poser:
        return Poser(self.anatomy)

    def pose(
        self,
        frame: ArrayLike,
        *,
        drive: str | Drive = Drive.NATURAL,
        emotion: Mapping[str, float] | None = None,
        contractions: Mapping[str, float] | None = None,
    ) -> Pose:
        """The equilibrium of the face for one frame of FAPs.

        Parameters
        ----------
        frame : (68,) FAP units, index = FAP number - 1; NaN = the profile is silent: anatomy decides, not zero.
        drive : "natural" (default), "exact", "muscles" or "points"; see `Drive`.
        emotion : archetype -> share, where the word behind the frame is known (`Profile.weights`); natural mode only.
        contractions : muscle name -> 0..1, set by hand.

        Raises
        ------
        ParameterError : a frame of another shape, an unknown drive, muscle or archetype.
        """
        return self._poser.pose(_checked_frame(frame), _checked_drive(drive), _checked_emotion(emotion), contractions)

    def simulation(
        self,
        frames: ArrayLike,
        fps: float = 25.0,
        *,
        drive: str | Drive = Drive.NATURAL,
        emotions: ArrayLike | None = None,
        integrator: str = "implicit",
        substeps: int = 1,
        tissue: str = "default",
    ) -> Iterator[Floats]:
        """Positions (V, 3) frame by frame of the moving face; see `simulate`."""
        checked = np.stack([_checked_frame(frame) for frame in np.asarray(frames, dtype=np.float64)])
        weights = None if emotions is None else np.asarray(emotions, dtype=np.float64)
        if weights is not None and weights.shape != (len(checked), len(ARCHETYPES)):
            raise ParameterError("emotions", f"must have the shape ({len(checked)}, {len(ARCHETYPES)})", weights.shape)
        simulation = Simulation(self._poser, fps=fps, integrator=integrator, substeps=substeps, tissue=tissue)
        return simulation.run(stream_moments(self._poser, checked, _checked_drive(drive), weights))

    def performance(
        self,
        cues: Sequence[Cue],
        fps: float = 25.0,
        *,
        drive: str | Drive = Drive.NATURAL,
        integrator: str = "implicit",
        substeps: int = 1,
        tissue: str = "default",
    ) -> Iterator[Floats]:
        """Positions (V, 3) frame by frame of expressions in time (`sequence` gives their frames).

        In the natural drive each cue is planned at its apex and the plans are blended, so that an apex that is held is
        the pose of its profile. Keywords and errors as `simulate`.
        """
        simulation = Simulation(self._poser, fps=fps, integrator=integrator, substeps=substeps, tissue=tissue)
        return simulation.run(cue_moments(self._poser, cues, fps, _checked_drive(drive)))

    def simulate(
        self,
        frames: ArrayLike,
        fps: float = 25.0,
        *,
        drive: str | Drive = Drive.NATURAL,
        emotions: ArrayLike | None = None,
        integrator: str = "implicit",
        substeps: int = 1,
        tissue: str = "default",
    ) -> Clip:
        """The moving face: frames of FAPs with the skin's inertia and damping.

        Parameters
        ----------
        frames : (T, 68) FAP units; NaN = silent.
        fps : frames per second.
        emotions : (T, 6) strength of each archetype over time (`emotion_weights`), where the words are known.
        integrator : "implicit" (default) or "rk2", the paper's.
        substeps : steps per frame of the implicit integrator; rk2 chooses its own.
        tissue : "default", "young", "aged" or "stiff" (presets/tissue.toml).

        Raises
        ------
        ParameterError, SolverError
        """
        moving = self.simulation(
            frames, fps, drive=drive, emotions=emotions, integrator=integrator, substeps=substeps, tissue=tissue
        )
        return Clip(np.stack(list(moving)), fps)


def _checked_vertices(vertices: ArrayLike) -> Floats:
    """(V, 3) float64, finite, not empty."""
    array = np.array(vertices, dtype=np.float64)
    if array.ndim != 2 or array.shape[1] != 3:
        raise ModelError(f"vertices must have the shape (V, 3), but have {array.shape}")
    if len(array) == 0:
        raise ModelError("the mesh is empty: it has no vertices")
    wrong = np.flatnonzero(~np.isfinite(array).all(axis=1))
    if len(wrong):
        raise ModelError(
            f"{len(wrong)} vertices are NaN or infinite, the first is vertex {wrong[0]}: mend the mesh or delete them"
        )
    return array


def _checked_polygons(polygons: Sequence[Sequence[int]] | ArrayLike, vertex_count: int) -> list[Ints]:
    """Polygons as index arrays, in range."""
    faces = [np.asarray(polygon, dtype=np.int64) for polygon in polygons]  # type: ignore[union-attr]
    if not faces:
        raise ModelError("the mesh has no polygons: the face needs a surface")
    for number, polygon in enumerate(faces):
        if polygon.ndim != 1 or len(polygon) < 3:
            raise ModelError(f"polygon {number} needs at least three corners")
        if polygon.min() < 0 or polygon.max() >= vertex_count:
            raise ModelError(f"polygon {number} names vertex {polygon.max()}, but the mesh has {vertex_count} vertices")
    return faces


def _with_pupils(points: Mapping[str, PointSource], vertices: Floats) -> dict[str, PointSource]:
    """Points with 3.5 and 3.6 placed, where they are missing, as the template's pupils lie between lids and corners."""
    complete = dict(points)
    for pupil, around in (("3.5", ("3.1", "3.3", "3.7", "3.11")), ("3.6", ("3.2", "3.4", "3.8", "3.12"))):
        if pupil in complete or any(name not in complete for name in around):
            continue
        places = [_place(complete[name], vertices) for name in around]
        if any(place is None for place in places):
            continue
        template = [TEMPLATE_POINTS[name] for name in around]
        weights, *_ = np.linalg.lstsq(
            np.vstack([np.transpose(template), 0.01 * np.ones(4)]), np.append(TEMPLATE_POINTS[pupil], 0.01), rcond=None
        )
        complete[pupil] = np.transpose(places) @ (weights / weights.sum())
    return complete


def _place(source: PointSource, vertices: Floats) -> Floats | None:
    """Position of a point source, or None where it names no vertex (binding reports it)."""
    if isinstance(source, int | np.integer):
        return vertices[int(source)] if 0 <= int(source) < len(vertices) else None
    return np.asarray(source, dtype=np.float64)


def _parts(
    parts: ArrayLike | None,
    head: Floats,
    polygons: Sequence[Ints],
    landmarks: Mapping[str, Floats],
    points: FeaturePoints,
) -> Ints:
    """Given parts, checked, or derived ones."""
    nose = int(points["9.3"].vertices[0]) if points["9.3"].is_bound else -1
    if nose < 0:
        raise ModelError(
            "feature point 9.3 (nose tip) does not lie on the mesh: give a vertex or a point on the surface"
        )
    if parts is None:
        return derive_parts(head, polygons, landmarks, nose)
    array = np.array(parts, dtype=np.int64)
    if array.shape != (len(head),):
        raise ModelError(f"parts must have one number per vertex ({len(head)}), but have the shape {array.shape}")
    if not np.isin(array, [int(p) for p in Part]).all():
        raise ModelError(f"parts must be numbers of Part (0 to {max(Part)})")
    if not (array == Part.SKIN).any():
        raise ModelError("the face has no skin: parts marks no vertex as skin (0)")
    return array


def _checked_frame(frame: ArrayLike) -> Floats:
    """(68,) float64 with FAPs 1 and 2 expanded; infinite values refused."""
    array = np.array(frame, dtype=np.float64)
    if array.shape != (FAP_COUNT,):
        raise ParameterError("frame", f"must have {FAP_COUNT} values, index = FAP number - 1", array.shape)
    if np.isinf(array).any():
        number = int(np.flatnonzero(np.isinf(array))[0]) + 1
        raise ParameterError(f"FAP {number}", "must be finite, or NaN where silent", float(array[number - 1]))
    return array


def _checked_drive(drive: str | Drive) -> Drive:
    """The drive of a name."""
    try:
        return Drive(drive)
    except ValueError:
        raise ParameterError("drive", f"must be one of {', '.join(Drive)}", drive) from None


def _checked_emotion(emotion: Mapping[str, float] | None) -> Mapping[str, float] | None:
    """Archetype shares with known names."""
    if emotion is None:
        return None
    names = [str(name) for name in ARCHETYPES]
    for name in emotion:
        if str(name) not in names:
            raise ParameterError("emotion", f"must name archetypes ({', '.join(names)})", name)
    return {str(name): float(share) for name, share in emotion.items()}
