"""The mouth bag gets darker inwards, band by band: light hardly reaches a throat, and previews cast no shadows."""

from __future__ import annotations

import numpy as np

from ...arrays import Floats
from .cage import Region
from .skin import HeadSkin

#: Cage ring -> how deep it lies: the bag runs from the lips (0) by the gums (1) to the cheeks' end (2) and the throat.
RING_DEPTHS = {"mouB1": 1.0, "mouB2": 2.0, "mouBC": 3.0}

#: Materials of the bag from the lips inwards, and the depth at which each begins.
BANDS = (("mouth", 0.0), ("mouth_inside", 0.8), ("mouth_depth", 1.4), ("throat", 1.9))


def bag_materials(skin: HeadSkin) -> dict[int, str]:
    """Quad of the bag -> its material."""
    depths = _depths(skin)
    quads = [quad for quad, region in enumerate(skin.regions) if region is Region.MOUTH_BAG]
    begins = np.array([depth for _, depth in BANDS])
    bands = np.searchsorted(begins, depths[skin.quads[quads]].mean(axis=1), side="right") - 1
    return {quad: BANDS[max(int(band), 0)][0] for quad, band in zip(quads, bands, strict=True)}


def _depths(skin: HeadSkin) -> Floats:
    """(V,) how deep each vertex lies, carried over from the cage."""
    depths = np.array([RING_DEPTHS.get(name.partition("_")[0], 0.0) for name in skin.cage.names])
    return np.asarray(skin.cage_matrix @ depths, dtype=np.float64)
