"""A face placed by a few points that somebody clicked."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from scipy import sparse

from ...arrays import Floats
from ...errors import ModelError, ParameterError
from ...mpeg4 import FEATURE_POINTS
from .bending.bend import Wishes
from .locating.head_pose import HeadPose
from .template.template import FitTemplate

#: The fewest points that tell where a face lies, and the set that is asked for.
FEWEST = 4
ASKED = ("3.7", "3.12", "8.3", "8.4", "9.3", "2.1")
#: Clicks are refused when they miss the template by more on average than this, metres of the template.
FARTHEST = 25e-3
#: How far a click may be outside of the box round a mesh, as a share of its diagonal.
SLIP = 0.05
#: Spread of the points across their main direction, as a share of that along it, below which they lie on one line.
THIN = 0.1


def checked_clicks(clicks: Mapping[str, object] | None, template: FitTemplate) -> dict[str, Floats]:
    """Clicks as positions (3,).

    Raises
    ------
    ParameterError : a name that is no feature point of the skin, or a position that is not three finite numbers.
    """
    checked: dict[str, Floats] = {}
    for name, place in (clicks or {}).items():
        if name not in template.names:
            known = "is not on the skin" if name in FEATURE_POINTS else "is not a feature point"
            raise ParameterError(
                "clicks", f"must name points of the skin such as {', '.join(ASKED)}; {name} {known}", name
            )
        checked[name] = click_place(name, place)
    return checked


def click_place(name: str, place: object) -> Floats:
    """(3,) where a point was clicked.

    Raises
    ------
    ParameterError : it is not three finite numbers.
    """
    try:
        position = np.array(place, dtype=np.float64)
    except (TypeError, ValueError):
        position = np.zeros(0)
    if position.shape != (3,) or not np.isfinite(position).all():
        given = place.tolist() if isinstance(place, np.ndarray) else place
        raise ParameterError(f"clicks {name}", "must be three finite coordinates", given)
    return position


def refuse_clicks_off(vertices: Floats, clicks: Mapping[str, Floats]) -> None:
    """Refuse clicks that are not on the mesh of vertices (V, 3): outside of the box round it, by more than a slip.

    Raises
    ------
    ModelError : names the click.
    """
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    slip = SLIP * float(np.linalg.norm(high - low))
    for name, place in clicks.items():
        if not float(np.abs(place - np.clip(place, low, high)).max()) <= slip:
            raise ModelError(f"the clicked point {name} is off the mesh: click on its surface")


def pose_from_clicks(clicks: Mapping[str, Floats], template: FitTemplate) -> HeadPose:
    """The similarity that best lays the template's points on the clicks (Umeyama 1991).

    Raises
    ------
    ModelError : clicks on one line, or that form no face (left and right swapped, or a wrong name).
    """
    names = list(clicks)
    source = template.read(template.skin.vertices, names)
    target = np.array([clicks[name] for name in names])
    a, b = source - source.mean(axis=0), target - target.mean(axis=0)
    spread = np.linalg.svd(b, compute_uv=False)
    if not spread[1] > THIN * spread[0]:
        raise ModelError(f"the clicked points are on one line or in one place; click {', '.join(ASKED)}")
    u, values, vt = np.linalg.svd(b.T @ a)
    flip = np.diag([1.0, 1.0, float(np.sign(np.linalg.det(u @ vt)))])
    rotation = u @ flip @ vt
    size = float((values * np.diag(flip)).sum() / (a * a).sum())
    pose = HeadPose(rotation.T, target.mean(axis=0) - size * source.mean(axis=0) @ rotation.T, np.full(3, size))
    misses = click_misses(clicks, pose, template)
    mean = float(np.mean(list(misses.values())))
    if mean > FARTHEST:
        worst = max(misses, key=lambda name: misses[name])
        raise ModelError(
            f"the clicked points do not form a face: they differ from one by {1e3 * mean:.0f} mm on average, {worst} "
            f"most; click again (left is the subject's left, the viewer's right)"
        )
    return pose


def click_misses(clicks: Mapping[str, Floats], pose: HeadPose, template: FitTemplate) -> dict[str, float]:
    """Distance of each click from the template's point, metres of the template."""
    names = list(clicks)
    away = pose.to_mesh(template.read(template.skin.vertices, names)) - np.array([clicks[name] for name in names])
    return dict(zip(names, (np.linalg.norm(away, axis=1) / pose.size).tolist(), strict=True))


def click_wishes(clicks: Mapping[str, Floats], pose: HeadPose, template: FitTemplate) -> Wishes:
    """The template's points shall come to the clicks."""
    names = list(clicks)
    rows = template.points[[template.names.index(name) for name in names]]
    places = pose.to_template(np.array([clicks[name] for name in names]))
    return Wishes(sparse.csr_array(rows @ template.skin.cage_matrix), places - rows @ template.skin.vertices)
