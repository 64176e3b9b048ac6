"""Lips and lids that are one surface: noticed, kept whole, and said."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest
import risorius.api as api
from risorius.api import Face

Build = Callable[..., Any]


@pytest.fixture(scope="module")
def sewn(sewn_head: Build) -> Callable[..., Face]:
    """The face of a head that is sewn at some places, built once."""

    @cache
    def build(*names: str) -> Face:
        head = sewn_head(*names)
        return Face.from_arrays(head.vertices, head.polygons, head.points)

    return build


def longest_stretch(face: Face, positions: np.ndarray, near: np.ndarray, within: float) -> float:
    """The largest growth of an edge near a place, metres."""
    edges = np.concatenate([np.stack([p, np.roll(p, -1)], axis=1) for p in face.polygons])
    edges = edges[np.linalg.norm(face.vertices[edges[:, 0]] - near, axis=1) < within]
    now, before = (np.linalg.norm(each[edges[:, 0]] - each[edges[:, 1]], axis=1) for each in (positions, face.vertices))
    return float((now - before).max())


@pytest.mark.parametrize("names", [(), ("mouth",), ("l",), ("mouth", "l", "r")])
def test_what_is_sewn_is_noticed(sewn: Callable[..., Face], face: Face, names: tuple[str, ...]) -> None:
    own = sewn(*names) if names else face
    assert own.sewn == frozenset(names)


@pytest.mark.parametrize("name", ["ict", "makehuman", "ict_narrow"])
def test_mouths_with_a_bag_or_a_border_are_not_sewn(any_face: Callable[[str], Face], name: str) -> None:
    assert any_face(name).sewn == frozenset()


@pytest.mark.parametrize("drive", ["natural", "exact", "muscles", "points"])
@pytest.mark.parametrize("word", ["surprise", "fear", "joy"])
def test_sewn_lips_stay_whole(sewn: Callable[..., Face], word: str, drive: str) -> None:
    """No edge grows by more than skin does; a web over an open mouth grows by its whole opening."""
    own, profile = sewn("mouth"), api.expression(word)
    pose = own.pose(profile.frame(), drive=drive, emotion=profile.weights if drive == "natural" else None)
    mouth = (own.points["8.1"].position + own.points["8.2"].position) / 2.0
    assert longest_stretch(own, pose.positions, mouth, 0.03) < 3e-3
    assert np.abs(pose.positions - own.vertices).max() > 4e-3


def test_sewn_lips_stay_whole_in_motion(sewn: Callable[..., Face]) -> None:
    own, profile = sewn("mouth"), api.expression("surprise")
    frames = np.repeat(profile.frame()[None], 4, axis=0) * np.array([0.0, 1.0, 1.0, 1.0])[:, None]
    mouth = (own.points["8.1"].position + own.points["8.2"].position) / 2.0
    for positions in own.simulation(frames):
        assert longest_stretch(own, positions, mouth, 0.03) < 3e-3


def test_a_jaw_that_is_opened_by_hand_does_not_tear_sewn_lips(sewn: Callable[..., Face]) -> None:
    own = sewn("mouth")
    pose = own.pose(np.full(68, np.nan), contractions={"jaw_open": 1.0})
    mouth = (own.points["8.1"].position + own.points["8.2"].position) / 2.0
    assert longest_stretch(own, pose.positions, mouth, 0.03) < 3e-3
    chin = own.points["2.1"]
    dropped = own.vertices[chin.vertices] - pose.positions[chin.vertices]
    assert 3e-3 < float(chin.weights @ dropped[:, 2]) < 12e-3


def test_what_sewn_lips_keep_a_face_from_is_said(sewn: Callable[..., Face], face: Face) -> None:
    frame = np.full(68, np.nan)
    frame[[2, 4]] = 400.0, -600.0
    for own, said in ((sewn("mouth"), True), (face, False)):
        reasons = own.pose(frame).reasons
        assert ("sewn" in reasons.get(3, "")) == said
        assert ("sewn" in reasons.get(5, "")) == said
    frame[[2, 4]] = 0.0, 0.0
    assert not any("sewn" in reason for reason in sewn("mouth").pose(frame).reasons.values())


@pytest.mark.slow
@pytest.mark.parametrize("drive", ["natural", "exact"])
def test_shut_lids_stay_shut(sewn: Callable[..., Face], drive: str) -> None:
    own, frame = sewn("l", "r"), np.full(68, np.nan)
    frame[[18, 19, 20, 21]] = -600.0, -600.0, -300.0, -300.0
    frame[[30, 31, 32, 33]] = 200.0
    pose = own.pose(frame, drive=drive)
    for upper, lower in (("3.1", "3.3"), ("3.2", "3.4")):
        middle = (own.points[upper].position + own.points[lower].position) / 2.0
        assert longest_stretch(own, pose.positions, middle, 0.012) < 2.5e-3  # opened, one grows by 6 mm
    assert "shut" in pose.reasons[19]
    assert "shut" in pose.reasons[22]
