"""Faces that are crooked or unlike the template: parts that lie elsewhere are sought, the pose is made up anew."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from ....arrays import Floats
from ....progress import Progress, Work
from ..template.picture import picture
from ..template.template import FitTemplate
from .boxes import Box, box_cloud
from .flow import Flow, Pass, find_flow
from .head_pose import HeadPose
from .locate import Located

#: Faces that score better than this lie well already.
CROOKED_SCORE = 0.95
#: Points that the face is seen by, and the box that holds them, metres round the template's origin.
POINTS = 70_000
BOX: Box = ((-0.1, -0.2, -0.15), (0.1, 0.06, 0.13))
#: Searches before the pose is made up anew, how often that is done, and searches for what the pose leaves.
FAR, ROUNDS, NEAR = (Pass(8, 2, 0.0), Pass(5, 1, 6.0)), 2, (Pass(5, 1, 8.0), Pass(3, 1, 8.0))
#: Every so many-th front vertex of the template tells the pose.
STRIDE = 8
#: Distance from which a pose's misses count less, metres; how firmly its axes keep one scale.
HALF, ALIKE = 4e-3, 20e-3
#: What is said meanwhile.
TEXT = "Checking for a crooked face"


@dataclass(frozen=True)
class Start:
    """A better place for the template, and how far it is bent there to begin with; None: not at all."""

    place: Located
    flow: Flow | None


def better_start(place: Located) -> Work[Start]:
    """Where a face lies, looked at again where it is unlike the template."""
    yield Progress(0.0, TEXT)
    if place.score.value < CROOKED_SCORE:
        return Start(place, None)
    template = place.template
    chosen = np.flatnonzero(template.front)[::STRIDE]
    model = template.surface.vertices[chosen]
    pose = place.pose
    for number in range(ROUNDS):
        flow = _flow(place, pose, FAR)
        yield Progress((number + 0.5) / (ROUNDS + 1), TEXT)
        pose = pose_of(model, pose.to_mesh(model + flow.at(model)), pose)
        yield Progress((number + 1) / (ROUNDS + 1), TEXT)
    return Start(replace(place, pose=pose), _flow(place, pose, NEAR))


def starting_bend(template: FitTemplate, flow: Flow | None) -> Floats:
    """(C, 3) displacements of the template's cage before the first round."""
    cage = template.skin.vertices[: template.skin.cage_matrix.shape[1]]
    return np.zeros_like(cage) if flow is None else flow.at(cage)


def _flow(place: Located, pose: HeadPose, passes: tuple[Pass, ...]) -> Flow:
    """The flow to what is seen from the front at a pose."""
    seen = picture(pose.to_template(box_cloud(place.surface, pose, BOX, POINTS).positions))
    return find_flow(seen, place.template.jaw_degrees, passes)


def pose_of(model: Floats, places: Floats, near: HeadPose) -> HeadPose:
    """The pose near another that brings template points (N, 3) to places (N, 3) of the mesh; outliers count less."""
    alike = near.with_one_scale()
    own, aims = model * (near.scale / near.size), alike.to_template(places)
    firm = ALIKE * np.sqrt(len(model))

    def misses(figures: Floats) -> Floats:
        turn = Rotation.from_rotvec(figures[:3]).as_matrix()
        away = (own * np.exp(figures[6:])) @ turn + figures[3:6] - aims
        return np.concatenate([away.ravel(), firm * (figures[6:] - figures[6:].mean())])

    best = least_squares(misses, np.zeros(9), loss="soft_l1", f_scale=HALF).x
    found = HeadPose(Rotation.from_rotvec(best[:3]).as_matrix(), best[3:6], np.exp(best[6:]) * near.scale / near.size)
    return found.within(alike)
