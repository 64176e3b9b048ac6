"""The outer skin as the paper has it, as biphasic springs with mass and damping; here with bending and ties to bone."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ...arrays import Floats
from ...errors import ParameterError
from ...physics.skin import Skin
from ...physics.tissue import Tissue, as_tissue
from ..figures import Length, Place, read_figures
from ..mechanism import Mechanism
from ..skin.outer import OuterSkin, gaussian
from . import regions


@dataclass(frozen=True, eq=False)
class LooseFigures:
    """Where deep soft tissue hangs loose (presets/anatomy/skin.toml)."""

    radius: Length
    jowl_from_corner: Place


LOOSE = read_figures("skin.loose", LooseFigures)

#: A sheet that bends more easily than this buckles where muscles squeeze it, and stays so, metres.
LEAST_BENDING = 3e-3


def looseness(skin: OuterSkin) -> Floats:
    """(n,) 1 where deep soft tissue hangs loose, over cheek and jowl; 0 where skin lies close on bone.

    Between the cheekbone and the mandible's edge, before the ear: about feature points 5.1 and 5.2, and down to the
    edge of the jaw beside the chin.
    """
    points, loose = skin.points, np.zeros(skin.vertex_count)
    for cheek, corner in (("5.1", "8.3"), ("5.2", "8.4")):
        jowl = points[corner] + LOOSE.jowl_from_corner * np.array([np.sign(points[corner][0]), 1.0, 1.0])
        for centre in (points[cheek], jowl):
            loose = np.maximum(loose, gaussian(skin.positions, centre, LOOSE.radius))
    return loose


def spring_skin(skin: OuterSkin, tissue: str | Tissue = "default") -> Skin:
    """The skin of a face, of a tissue of its own or one named in presets/tissue.toml, held as its regions are.

    Where it hangs loose more tissue moves with it and is less damped.

    Raises
    ------
    ParameterError : an unknown tissue, or one that would buckle.
    """
    figures, loose = as_tissue(tissue), looseness(skin)
    if skin.has(Mechanism.BENDING) and figures.bending_length < LEAST_BENDING:
        rule = f"must be {LEAST_BENDING:g} m or more, or the skin buckles; face.without('bending') leaves bending out"
        raise ParameterError("bending_length", rule, figures.bending_length)
    anchor = regions.anchor(skin, figures)
    depth = figures.depth + (figures.loose_depth - figures.depth) * loose
    ratio = figures.damping_ratio + (figures.loose_damping_ratio - figures.damping_ratio) * loose
    return Skin.from_mesh(
        skin.positions,
        skin.polygons,
        figures if skin.has(Mechanism.BIPHASIC) else replace(figures, stiffening=1.0),
        anchor=anchor,
        bending=regions.bending(skin, figures),
        depth=depth,
        springs=skin.springs,
        damping=2.0 * ratio * np.sqrt(figures.membrane * anchor / (figures.density * depth)),
    )
