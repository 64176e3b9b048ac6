"""What lies behind the lips: mouth bag and tongue."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from risorius.api import Face
from risorius.face.response import followers
from scipy.spatial import cKDTree

MM = 1e-3


def asked(**values: float) -> np.ndarray:
    """A frame with some FAPs: F12=200."""
    frame = np.full(68, np.nan)
    for name, value in values.items():
        frame[int(name[1:]) - 1] = value
    return frame


def comes_through(face: Face, frame: np.ndarray) -> float:
    """How far the mouth bag comes out through the skin that it lies behind at rest, mm."""
    anatomy = face.anatomy
    rest = anatomy.mesh.positions
    posed = anatomy.mesh.head_frame.to_head(face.pose(frame, drive="exact").positions)
    inner, outer = anatomy.inner_skin.index, anatomy.skin.index
    distance, nearest = cKDTree(rest[outer]).query(rest[inner])
    normals = anatomy.skin.normals[nearest]
    behind = ((rest[outer][nearest] - rest[inner]) * normals).sum(axis=1)
    covered = (behind > 0.9 * distance) & (distance < 7 * MM) & (distance > 2 * MM)
    now = ((posed[outer][nearest] - posed[inner]) * normals).sum(axis=1)[covered]
    return float(-now.min() / MM)


PURSED = asked(F6=-170, F7=-170, F16=498, F17=464, F51=-126, F52=-223, F53=-173, F54=-173)


@pytest.mark.slow
@pytest.mark.parametrize("flesh", [True, False])
def test_the_mouth_bag_stays_behind_pursed_lips(
    shared_head: Callable[[str], Any], monkeypatch: pytest.MonkeyPatch, flesh: bool
) -> None:
    """Its top hangs on the upper lip's edge, a centimetre below: without flesh between, that edge drags it out."""
    if not flesh:
        monkeypatch.setattr(followers, "FLESH", replace(followers.FLESH, length=1.0))
    head = shared_head("makehuman")
    face = Face.from_arrays(head.vertices, head.polygons, head.points, head.parts())
    assert (comes_through(face, PURSED) < 0.0) is flesh


def tongue_top(face: Face, frame: np.ndarray) -> float:
    """Height of the tongue's top over the lower teeth's, both as carried by the mandible, mm."""
    anatomy = face.anatomy
    assert anatomy.tongue is not None
    pose = face.pose(frame, drive="exact")
    posed = anatomy.mesh.head_frame.to_head(pose.positions)
    tongue = anatomy.tongue.index
    top = tongue[np.argmax(anatomy.mesh.positions[tongue, 1])]
    lower = np.setdiff1d(anatomy.jaw_parts, tongue)
    return float((posed[top, 1] - posed[lower, 1].max()) / MM)


def test_a_tongue_of_which_nothing_is_asked_lies_down_as_the_jaw_opens(face: Face) -> None:
    shut, wide = tongue_top(face, asked(F3=0.0)), tongue_top(face, asked(F3=700.0))
    asked_for = tongue_top(face, asked(F3=700.0, F46=0.0))
    assert wide < shut - 2.0
    assert wide < asked_for - 2.0
