"""Which way the face of a mesh looks, where it is and how large: symmetry, coarse search, alignment, score."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ....errors import ModelError
from ....progress import Progress, Work, part_of
from ..surface.cloud import Cloud, Surface, sample
from ..surface.skeleton import net_of
from ..surface.symmetry import symmetry_planes
from ..template.open_mouth import open_template
from ..template.template import FitTemplate
from .align import align
from .boxes import FACE_BOX, HEAD_BOX, box_cloud, lies_in_box
from .head_pose import HeadPose
from .regions import guesses_at_ends
from .score import RELIEF_LIMIT, SCORE_LIMIT, FaceScore, face_score
from .search import Guess, best_guesses, search_plane

#: Points spread over the whole mesh; over the head alone; over the face alone; and those that symmetry is sought with.
WHOLE, HEAD, FACE, SYMMETRY = 100_000, 40_000, 40_000, 2_000
#: Guesses that are aligned, and those of them that are aligned twice.
ALIGNED, FINALISTS = 10, 3
#: Guesses that are aligned of each end of a mesh; from this score on no further end is looked at.
ALIGNED_AT_END, CERTAIN_SCORE = 3, 0.8
#: From this score on it is asked whether the mouth is open, by so many degrees, up to that one, which is no face with
#: any mouth; an open one must score better by this.
GOOD_SCORE, HOPELESS_SCORE, JAW_DEGREES, OPEN_COST = 0.55, 2.6, (7.0, 14.0, 21.0), 0.1
#: Half width and half height of the middle of a face, metres, and the share of it that lies foremost.
FRONT, FOREMOST = (0.05, 0.07), 0.4
#: Poses nearer than a centimetre and about 20 degrees (trace of the turn between them) are one.
SAME_PLACE, SAME_TRACE = 0.01, 2.88


@dataclass(frozen=True)
class Located:
    """A face found in a mesh.

    Attributes
    ----------
    pose : where the template lies, a scale for each axis.
    surface : the mesh's surface with normals outward.
    score : how much it looks like a face.
    template : the template that it looks like: with the mouth closed, or open.
    """

    pose: HeadPose
    surface: Surface
    score: FaceScore
    template: FitTemplate


def locate(surface: Surface, *, refuse: bool = True) -> Work[Located]:
    """Find the face of a mesh; unless `refuse`, the best place however little it looks like a face.

    Raises
    ------
    ModelError : when nothing in the mesh looks like a face; states the score, the limit and the remedy.
    """
    yield Progress(0.0, "Finding planes of symmetry")
    cloud = sample(surface, WHOLE)
    if len(cloud) == 0:
        raise ModelError("no face found: the mesh has no area; feature points need a surface")
    yield Progress(0.0, "Finding planes of symmetry")
    guesses = yield from part_of(_guesses_of_whole(surface, cloud), 0.0, 0.55)
    place = yield from part_of(_best_place(surface, cloud, guesses[:ALIGNED]), 0.55, 0.7)
    if place is None or not place.score.is_face:
        turned = yield from part_of(_place_at_ends(surface, cloud), 0.7, 0.95)
        place = min((other for other in (place, turned) if other), key=lambda other: other.score.value, default=None)
    if place is not None and GOOD_SCORE < place.score.value < HOPELESS_SCORE:
        place = yield from part_of(_opened(place), 0.95, 1.0)
    return accepted(place, refuse=refuse)


def _guesses_of_whole(surface: Surface, cloud: Cloud) -> Work[list[Guess]]:
    """The best guesses about the planes of symmetry of the whole mesh."""
    area = float(surface.twice_areas.sum() / 2.0)
    diagonal = float(np.linalg.norm(np.ptp(cloud.positions, axis=0)))
    planes = symmetry_planes(cloud.positions[:: WHOLE // SYMMETRY])
    guesses: list[Guess] = []
    for number, plane in enumerate(planes):
        yield Progress(0.25 + 0.75 * number / len(planes), "Finding the direction of the face")
        guesses += search_plane(cloud, area, diagonal, plane)
    return best_guesses(guesses)


def _best_place(surface: Surface, cloud: Cloud, guesses: Sequence[Guess]) -> Work[Located | None]:
    """The place among some guesses that looks most like a face."""
    found: list[Located] = []
    for number, guess in enumerate(guesses):
        yield Progress(0.8 * number / len(guesses), "Finding the size of the face")
        found.append(_aligned(surface, cloud, guess.pose))
    found.sort(key=lambda place: place.score.value)
    best: list[Located] = []
    for number, place in enumerate(_distinct(found)[:FINALISTS]):
        yield Progress(0.8 + 0.2 * number / FINALISTS, "Comparing the best places")
        best.append(aligned_again(place.surface, place.pose))
    return min(best, key=lambda place: place.score.value, default=None)


def _place_at_ends(surface: Surface, cloud: Cloud) -> Work[Located | None]:
    """The place at an end of the mesh that looks most like a face; the first that surely is one."""
    best: Located | None = None
    net = yield from part_of(net_of(surface), 0.0, 0.1)
    for number, guesses in enumerate(guesses_at_ends(surface, net)):
        done, then = (0.1 + 0.9 * count / (count + 2) for count in (number, number + 1))
        yield Progress(done, "Searching for a turned head")
        place = yield from part_of(_best_place(surface, cloud, guesses[:ALIGNED_AT_END]), done, then)
        best = min((other for other in (best, place) if other), key=lambda other: other.score.value, default=None)
        if best is not None and best.score.is_face and best.score.value < CERTAIN_SCORE:
            break
    return best


def _opened(place: Located) -> Work[Located]:
    """The place with an open mouth, where that looks more like a face."""
    opened: list[Located] = []
    for number, degrees in enumerate(JAW_DEGREES):
        yield Progress(number / len(JAW_DEGREES), "Checking for an open mouth")
        opened.append(aligned_again(place.surface, place.pose, degrees))
    best = min(opened, key=lambda other: other.score.value)
    return best if best.score.value + OPEN_COST < place.score.value else place


def accepted(place: Located | None, *, refuse: bool = True) -> Located:
    """The place, where it looks like a face.

    Raises
    ------
    ModelError : where it does not.
    """
    remedy = (
        "click its feature points 3.7, 3.12, 8.3, 8.4, 9.3 and 2.1 (outer eye corners, lip corners, nose tip, chin)"
    )
    if place is None:
        raise ModelError(f"no face found in the mesh; if it has one, {remedy}")
    score = place.score
    if refuse and not score.is_face:
        raise ModelError(
            f"the mesh does not look like a face: score {score.value:.2f} (at most {SCORE_LIMIT}), agreement of eyes, "
            f"nose and mouth {score.relief:.2f} (at least {RELIEF_LIMIT}); if it has a face, {remedy}"
        )
    return place


def aligned_again(surface: Surface, pose: HeadPose, jaw_degrees: float = 0.0) -> Located:
    """The place near a pose, seen with points spread over the head alone."""
    template = open_template(jaw_degrees)
    pose = align(box_cloud(surface, pose, HEAD_BOX, HEAD), pose, template)
    return Located(pose, surface, scored(surface, pose, template), template)


def scored(surface: Surface, pose: HeadPose, template: FitTemplate) -> FaceScore:
    """How much what lies at a pose looks like a face."""
    return face_score(pose.to_template(box_cloud(surface, pose, FACE_BOX, FACE).positions), template)


def _aligned(surface: Surface, cloud: Cloud, guess: HeadPose) -> Located:
    """One guess aligned; the surface comes out with its normals outward."""
    near = cloud.take(lies_in_box(cloud.positions, guess, HEAD_BOX))
    near = near.take(np.arange(0, len(near), max(1, len(near) // (HEAD // 2))))
    if len(near) < HEAD // 4:
        near = box_cloud(surface, guess, HEAD_BOX, HEAD // 2)
    if looks_backwards(near, guess):
        surface, near = surface.flipped(), Cloud(near.positions, -near.normals, near.triangles)
    template = open_template(0.0)
    pose = align(near, guess, template)
    return Located(pose, surface, scored(surface, pose, template), template)


def looks_backwards(cloud: Cloud, pose: HeadPose) -> bool:
    """Whether the normals of what is seen from the front point away from the viewer."""
    local = pose.to_template(cloud.positions)
    inside = (np.abs(local[:, 0]) < FRONT[0]) & (np.abs(local[:, 2]) < FRONT[1])
    if not inside.any():
        return False
    depth = local[inside, 1]
    front = depth <= np.quantile(depth, FOREMOST)
    return bool(np.median(cloud.normals[inside][front] @ pose.axes[1]) > 0.0)


def _distinct(places: Sequence[Located]) -> list[Located]:
    """Places that differ in position or direction."""
    kept: list[Located] = []
    for place in places:
        for other in kept:
            near = np.linalg.norm(place.pose.origin - other.pose.origin) < SAME_PLACE * other.pose.size
            if near and np.trace(place.pose.axes @ other.pose.axes.T) > SAME_TRACE:
                break
        else:
            kept.append(place)
    return kept
