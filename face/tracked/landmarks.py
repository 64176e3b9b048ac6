"""From tracked points to FAPs: the head's pose taken out, a neutral face chosen, FAPs in that person's own units.

For any tracker that gives feature points in three dimensions: files of landmarks (`mediapipe_landmarks`), or video.
Points come as (T, P, 3) to the subject's left, up and forward as a camera before the face sees them, at any scale and
place.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...arrays import Bools, Floats, Ints
from ...errors import ModelError, ParameterError
from ...mpeg4 import ANGLE_UNIT, FAP_COUNT, FAPS
from ...mpeg4.streams.capture.rotation import head_faps
from ..mesh.fap_units import Fapu, fapu, unit_length
from ..mesh.template import TEMPLATE_POINTS

#: The face's usual shape is that which so large a share of the frames comes closest to, of so many that are compared;
#: the neutral face is the mean of the share that comes closest of all.
USUAL_SHARE, NEUTRAL_SHARE, COMPARED = 0.3, 0.1, 400

#: Yaw and pitch FAPs of each pupil, with the corners of its eye.
EYES = {"3.5": (23, 25, ("3.7", "3.11")), "3.6": (24, 26, ("3.8", "3.12"))}

#: The neutral face's units need these.
UNIT_POINTS = ("3.1", "3.3", "9.15", "2.2", "8.3", "8.4")


@dataclass(frozen=True, eq=False)
class Pose3:
    """Similarities from head space to where a face was seen: ``seen = scale * point @ rotation.T + shift``.

    Attributes
    ----------
    rotations : (T, 3, 3). scales : (T,). shifts : (T, 3). NaN where no face was seen.
    """

    rotations: Floats
    scales: Floats
    shifts: Floats

    def undone(self, points: Floats) -> Floats:
        """(T, P, 3) seen points in head space."""
        away = (points - self.shifts[:, None]) / self.scales[:, None, None]
        back: Floats = np.einsum("tij,tpi->tpj", self.rotations, away)
        return back


@dataclass(frozen=True, eq=False)
class LandmarkReading:
    """What tracked points say.

    Attributes
    ----------
    frames : (T, 68) FAP units of this person; NaN where unknown. FAPs 48-50 are the head's turn from its neutral pose.
    neutral : feature point -> (3,) on the neutral face, in head space (metres of the template).
    units : the person's FAP units in head space.
    chosen : frames that the neutral face was taken from.
    pose : where the head was.
    """

    frames: Floats
    neutral: Mapping[str, Floats]
    units: Fapu
    chosen: Ints
    pose: Pose3


def read_points(
    points: Floats,
    names: Sequence[str],
    *,
    stable: Sequence[str],
    eye_radius: float,
    unseen: Sequence[int] = (),
    neutral: tuple[int, int] | None = None,
) -> LandmarkReading:
    """FAPs of tracked feature points.

    Parameters
    ----------
    points : (T, P, 3) to the subject's left, up, forward; NaN where unknown.
    names : the feature point of each ("8.4"); with 3.5 and 3.6, the pupils, the eyes' turn is read too.
    stable : points that expression does not move; they carry the head's pose.
    eye_radius : radius of an eyeball over the distance of the pupils.
    unseen : FAPs that the tracker cannot see.
    neutral : first and last frame with a neutral face; None: the frames about the face's usual shape.

    Raises
    ------
    ParameterError : shapes, or a neutral stretch outside the recording or without a face.
    ModelError : points that the units or the pose need are missing, or no frame shows a face.

    Examples
    --------
    >>> face, names = api.default_face(), list(api.REQUIRED_POINTS)
    >>> still = np.array([face.points[name].position for name in names]) @ face.axes.T
    >>> stable = ["3.7", "3.8", "3.11", "3.12", "9.15"]
    >>> reading = api.read_points(np.stack([still, still]), names, stable=stable, eye_radius=0.2)
    >>> bool(np.nanmax(np.abs(reading.frames)) < 1e-6)  # nothing moves
    True
    """
    points = np.asarray(points, dtype=np.float64)
    if points.ndim != 3 or points.shape[1:] != (len(names), 3):
        raise ParameterError("points", f"must have the shape (T, {len(names)}, 3)", points.shape)
    missing = [name for name in (*stable, *UNIT_POINTS) if name not in names]
    if missing:
        raise ModelError(f"the tracked points lack {', '.join(missing)}")
    place = {name: index for index, name in enumerate(names)}
    carriers = [place[name] for name in stable]
    seen = np.asarray(np.isfinite(points[:, carriers]).all(axis=(1, 2)))
    if not seen.any():
        raise ModelError("no frame shows a whole face")
    rough = fit_poses(np.array([TEMPLATE_POINTS[name] for name in stable]), points[:, carriers], seen)
    seen &= np.isfinite(rough.scales)
    if not seen.any():
        raise ModelError("no frame shows a face: its points lie in one line, or at one place")
    chosen = _neutral_frames(rough.undone(points), seen, neutral)
    rest = _mean_known(rough.undone(points)[chosen])
    pose = fit_poses(rest[carriers], points[:, carriers], seen)
    still = pose.undone(points)
    rest = _mean_known(still[chosen])
    at_rest = _with_pupils({name: rest[index] for name, index in place.items()})
    units = fapu(at_rest, np.eye(3))
    stream = np.full((len(points), FAP_COUNT), np.nan)
    _read_shifts(stream, still - rest, place, units)
    _read_eyes(stream, still, place, eye_radius * units.es0, rest)
    stream[:, 47:50] = head_faps(pose.rotations @ mean_rotation(pose.rotations[chosen]).T)
    stream[:, [number - 1 for number in unseen]] = np.nan
    return LandmarkReading(stream, at_rest, units, chosen, pose)


def shifts_as_faps(shifts: Floats, names: Sequence[str], units: Fapu) -> Floats:
    """(n, 68) FAP units that shifts (n, P, 3) of feature points in head space come to; 0 where they move no FAP."""
    stream = np.zeros((len(shifts), FAP_COUNT))
    _read_shifts(stream, shifts, {name: index for index, name in enumerate(names)}, units)
    return stream


def fit_poses(reference: Floats, points: Floats, seen: Bools) -> Pose3:
    """Similarities from reference points (P, 3) to seen ones (T, P, 3), by least squares; NaN where unseen.

    Source: Umeyama 1991, IEEE PAMI 13(4).
    """
    count = len(points)
    rotations, scales, shifts = np.full((count, 3, 3), np.nan), np.full(count, np.nan), np.full((count, 3), np.nan)
    middle = reference.mean(axis=0)
    away = reference - middle
    for step in np.flatnonzero(seen):
        centre = points[step].mean(axis=0)
        u, size, vt = np.linalg.svd((points[step] - centre).T @ away)
        if size[1] <= 1e-9 * size[0] or size[0] == 0.0:
            continue
        signs = np.array([1.0, 1.0, np.sign(np.linalg.det(u @ vt))])
        rotations[step] = (u * signs) @ vt
        scales[step] = (size * signs).sum() / (away**2).sum()
        shifts[step] = centre - scales[step] * rotations[step] @ middle
    return Pose3(rotations, scales, shifts)


def mean_rotation(rotations: Floats) -> Floats:
    """(3, 3) the rotation nearest to the mean of rotations (n, 3, 3)."""
    u, _, vt = np.linalg.svd(np.nanmean(rotations, axis=0))
    turned: Floats = u @ np.diag([1.0, 1.0, np.sign(np.linalg.det(u @ vt))]) @ vt
    return turned


def usual_frames(shapes: Floats, seen: Bools) -> Ints:
    """Frames about the shape that the face keeps longest.

    Parameters
    ----------
    shapes : (T, P, 3) points without the head's motion. seen : (T,) frames with a face.
    """
    steps = np.flatnonzero(seen)
    steps = steps[:: max(1, len(steps) // COMPARED)]
    flat = np.nan_to_num(shapes[steps]).reshape(len(steps), -1)
    squares = (flat**2).sum(axis=1)
    apart = squares[:, None] + squares - 2.0 * flat @ flat.T
    nearest = np.argsort(apart, axis=1, kind="stable")
    company, closest = (max(1, round(share * len(steps))) for share in (USUAL_SHARE, NEUTRAL_SHARE))
    crowded = np.take_along_axis(apart, nearest[:, :company], axis=1).sum(axis=1)
    return np.asarray(np.sort(steps[nearest[int(crowded.argmin()), :closest]]), dtype=np.int64)


def _neutral_frames(shapes: Floats, seen: Bools, neutral: tuple[int, int] | None) -> Ints:
    """The frames that the neutral face is taken from."""
    if neutral is None:
        return usual_frames(shapes, seen)
    first, last = neutral
    if not 0 <= first <= last < len(shapes):
        raise ParameterError("neutral", f"must be in frames 0..{len(shapes) - 1}, the first before the last", neutral)
    chosen = first + np.flatnonzero(seen[first : last + 1])
    if len(chosen) == 0:
        raise ParameterError("neutral", "must contain a frame with a face", neutral)
    return np.asarray(chosen, dtype=np.int64)


def _mean_known(places: Floats) -> Floats:
    """(P, 3) mean of places (n, P, 3) where they are known; NaN where they never are."""
    known = ~np.isnan(places)
    count = known.sum(axis=0)
    return np.asarray(np.where(count, np.where(known, places, 0.0).sum(axis=0) / np.maximum(count, 1), np.nan))


def _with_pupils(points: dict[str, Floats]) -> dict[str, Floats]:
    """The points, with pupils in the middle between the corners of the eyes where they are not tracked."""
    for pupil, (_, _, corners) in EYES.items():
        if pupil not in points or np.isnan(points[pupil]).any():
            points[pupil] = (points[corners[0]] + points[corners[1]]) / 2.0
    return points


def _read_shifts(stream: Floats, shifts: Floats, place: Mapping[str, int], units: Fapu) -> None:
    """Fill the displacement FAPs of a stream (T, 68) in from shifts (T, P, 3) in head space, in place."""
    for number, fap in FAPS.items():
        direction, point = fap.motion.direction if fap.motion is not None else None, fap.feature_point
        if direction is None or fap.angular or point is None or point not in place or point in EYES:
            continue
        along = np.array([direction[0], direction[2], -direction[1]])
        stream[:, number - 1] = shifts[:, place[point]] @ along / unit_length(fap.unit, units)


def _read_eyes(stream: Floats, still: Floats, place: Mapping[str, int], radius: float, rest: Floats) -> None:
    """Fill the turn of the eyes in from the pupils' places between the corners of the eyes against those at rest."""
    for pupil, (yaw, pitch, corners) in EYES.items():
        if pupil not in place:
            continue
        ends = [place[corner] for corner in corners]
        aside = (still[:, place[pupil]] - still[:, ends].mean(axis=1)) - (rest[place[pupil]] - rest[ends].mean(axis=0))
        turn = np.arcsin(np.clip(aside / radius, -1.0, 1.0)) / ANGLE_UNIT
        stream[:, yaw - 1], stream[:, pitch - 1] = turn[:, 0], -turn[:, 1]
