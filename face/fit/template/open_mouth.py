"""The template with its mouth open, for heads whose mouth is."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import spsolve

from ....arrays import Floats
from ...default_head.cage import EAR_RINGS
from ..surface.cloud import Surface
from .template import FitTemplate, fit_template, front_cloud, front_of

#: Nodes this far above the plane from the hinge to the lips stay, metres; those this far below it belong to the chin.
SKULL_SIDE, CHIN_SIDE = 8e-3, 28e-3
#: The chin's half width, and how far back it reaches; below this the neck begins; metres of the template.
CHIN_WIDTH, CHIN_BACK, NECK = 28e-3, -70e-3, -118e-3
#: Share of the jaw's turn at the mouth's corners.
CORNER_SHARE = 0.5


@lru_cache(maxsize=4)
def open_template(degrees: float) -> FitTemplate:
    """The template with its jaw turned about the hinge."""
    template = fit_template()
    if degrees == 0.0:
        return template
    skin = template.skin
    angle = np.radians(degrees) * _jaw_shares(template)
    rest = skin.vertices - template.hinge
    cosine, sine = np.cos(angle), np.sin(angle)
    turned = np.column_stack(
        [rest[:, 0], cosine * rest[:, 1] - sine * rest[:, 2], sine * rest[:, 1] + cosine * rest[:, 2]]
    )
    vertices = turned + template.hinge
    surface = Surface.from_polygons(vertices, skin.quads)
    opened = replace(skin, vertices=vertices)
    return replace(
        template,
        skin=opened,
        surface=surface,
        front=front_of(surface, template.exterior),
        cloud=front_cloud(opened, template.eyeball),
        jaw_degrees=degrees,
    )


def _jaw_shares(template: FitTemplate) -> Floats:
    """(V,) how much of the jaw's turn each vertex of the skin takes: smooth between jaw and skull."""
    skin = template.skin
    count = len(skin.cage.names)
    x, y, z = skin.vertices[:count].T
    lips = skin.vertices[template.rings["mouth"].margin]
    way = np.array([lips[:, 1].min(), lips[:, 2].mean()]) - template.hinge[1:]
    below = ((z - template.hinge[2]) * way[0] - (y - template.hinge[1]) * way[1]) / np.linalg.norm(way)
    shares = np.full(count, np.nan)
    shares[(below < -SKULL_SIDE) | (z < NECK) | (y > 0.0)] = 0.0
    shares[(below > CHIN_SIDE) & (np.abs(x) < CHIN_WIDTH) & (y < CHIN_BACK) & (z > NECK)] = 1.0
    for name, number in skin.node_index.items():
        if name.startswith("mou") and "BC" not in name and number < count:
            place = int(name.removesuffix(".R").split("_")[1])
            shares[number] = CORNER_SHARE if place == 5 else float(place > 5)
        elif name.startswith(tuple(f"ear{ring}" for ring in EAR_RINGS)):
            shares[number] = 0.0
    free, fixed = np.flatnonzero(np.isnan(shares)), np.flatnonzero(~np.isnan(shares))
    rows = sparse.csr_array(template.laplacian)[free]
    shares[free] = spsolve(sparse.csc_array(rows[:, free]), -(rows[:, fixed] @ shares[fixed]))
    return np.asarray(skin.cage_matrix @ shares, dtype=np.float64)
