"""Crooked faces: pictures compared, the pose made up anew, and the points found in the end."""

from __future__ import annotations

import numpy as np
import pytest
import risorius.api as api
from fit import heads
from risorius.face.fit.locating.crooked import FAR, NEAR, pose_of
from risorius.face.fit.locating.flow import find_flow, smooth_field
from risorius.face.fit.locating.head_pose import HeadPose
from risorius.face.fit.template.picture import picture
from risorius.face.fit.template.template import fit_template
from scipy.spatial.transform import Rotation


def crooked(places: np.ndarray) -> np.ndarray:
    """Places (N, 3) of a face pushed aside below and up on one side, metres."""
    x, _, z = places.T
    aside = 0.14 * z + 8e-3 * np.sin(z / 0.05)
    return np.asarray(places + np.column_stack([aside, 0.05 * z, 0.12 * x + 4e-3]))


def test_the_flow_finds_a_crooked_template() -> None:
    template = fit_template()
    seen = picture(crooked(template.cloud.positions))
    names = ["3.7", "3.12", "9.3", "8.3", "8.4", "2.1", "4.1", "4.2", "5.1", "5.2"]
    face = template.read(template.skin.vertices, names)
    flow = find_flow(seen, 0.0, FAR + NEAR)
    off = 1000.0 * np.linalg.norm(face + flow.at(face) - crooked(face), axis=1)
    before = 1000.0 * np.linalg.norm(face - crooked(face), axis=1)
    assert before.max() > 15.0
    assert off.max() < 6.0
    assert np.median(off) < 2.5


def test_a_smooth_field_is_a_quadratic_and_bridges_what_is_unknown() -> None:
    z, x = np.indices((40, 28)) / 20.0
    truth = 1.0 + 2.0 * x - z + 0.5 * x * z - 0.3 * z**2
    weight = np.ones(truth.shape)
    weight[5:15, 4:12] = 0.0
    values = np.where(weight > 0.0, truth, 99.0)
    np.testing.assert_allclose(smooth_field(values, weight, 3.0), truth, atol=0.05)


def test_a_pose_is_made_of_places() -> None:
    model = np.random.default_rng(2).normal(scale=0.05, size=(200, 3))
    near = HeadPose(np.eye(3), np.array([3.0, -2.0, 1.0]), np.full(3, 100.0))
    turn = Rotation.from_euler("xyz", [12.0, -7.0, 15.0], degrees=True).as_matrix()
    true = HeadPose(turn @ near.axes, near.origin + 1.5, np.full(3, 108.0))
    places = true.to_mesh(model)
    places[:20] += 5.0
    found = pose_of(model, places, near)
    np.testing.assert_allclose(found.axes, true.axes, atol=0.02)
    np.testing.assert_allclose(found.scale, true.scale, rtol=0.03)
    np.testing.assert_allclose(found.origin, true.origin, atol=0.2)


@pytest.mark.slow
def test_points_of_a_head_that_is_bent_by_centimetres() -> None:
    head = heads.bent_default_head(23)
    found = api.find_points(head.vertices, head.polygons, topologies=())
    names = [name for name in found.positions if name in head.points and not name.startswith(("10.", "11."))]
    errors = [1000.0 * np.linalg.norm(found.positions[name] - head.points[name]) for name in names]
    assert np.median(errors) < 2.2
    assert np.quantile(errors, 0.95) < 9.0
