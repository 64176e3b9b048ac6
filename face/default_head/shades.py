"""Materials that change across the skin: a mouth dark inwards, lips whose red begins softly, lids with a lash line.

Light hardly reaches a throat, and previews cast no shadows; a lash line tells where an eye ends.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...arrays import Floats
from .cage import RIGHT_SUFFIX, Region
from .skin import HeadSkin

#: Ring round the mouth -> how deep it lies: from the border of the red (0) by the gums (4) to cheeks and throat.
MOUTH_DEPTHS = {"mouM3": 0.0, "mouM2": 1.0, "mouM1": 2.0, "mouM0": 3.0, "mouB1": 4.0, "mouB2": 5.0, "mouBC": 6.0}

#: Materials from the border of the lips inwards, and the depth at which each begins.
LIPS = (("lip_border", -1.0), ("lips", 0.27))
BAG = (("mouth", 3.0), ("mouth_inside", 3.8), ("mouth_depth", 4.4), ("throat", 4.9))

#: Materials of the lids' rim from its edge inwards: 0 the lower lid and the inner edge, 1 the upper lid's outer edge.
RIM = (("lid_rim", -1.0), ("lash", 0.55))


def shaded_materials(skin: HeadSkin) -> dict[int, str]:
    """Quad -> its material, for lips, mouth and lids' rims."""
    mouth, lashes = _carried(skin, _mouth_depth), _carried(skin, _lash)
    bands = {Region.LIPS: (mouth, LIPS), Region.MOUTH_BAG: (mouth, BAG), Region.LID_RIM: (lashes, RIM)}
    middle = {region: values[skin.quads].mean(axis=1) for region, (values, _) in bands.items()}
    return {
        quad: _band(float(middle[region][quad]), bands[region][1])
        for quad, region in enumerate(skin.regions)
        if region in bands
    }


def _band(value: float, bands: tuple[tuple[str, float], ...]) -> str:
    """The last material that begins at or below a value, the first where none does."""
    return next((name for name, begins in reversed(bands) if value >= begins), bands[0][0])


def _carried(skin: HeadSkin, of: Callable[[str], float]) -> Floats:
    """(V,) a value of the cage's nodes, by name, carried to the skin."""
    values = np.array([of(name.removesuffix(RIGHT_SUFFIX)) for name in skin.cage.names])
    return np.asarray(skin.cage_matrix @ values, dtype=np.float64)


def _mouth_depth(name: str) -> float:
    """How deep a node lies in the mouth."""
    return MOUTH_DEPTHS.get(name.partition("_")[0], -1.0 if name.startswith("mou") else 0.0)


def _lash(name: str) -> float:
    """1 on the outer edge of the upper lid between the corners."""
    ring, _, place = name.partition("_")
    return 1.0 if ring == "eyeE2" and 1 <= int(place) <= 8 else 0.0
