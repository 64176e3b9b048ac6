"""A head with shape keys as other people name and limit them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import bpy
import numpy as np
from risorius import api
from risorius.progress import run
from risorius.scene import mesh as meshes
from risorius.scene.bake.baking import BakeResult
from risorius.scene.bake.target import Target
from risorius.scene.bake.timing import ClipTiming
from risorius.scene.companions import Companion
from risorius.scene.rig import key_rig
from risorius.scene.rig.baking import Onto, bake_expression_onto

#: Key -> FAPs that make its shape, FAP units; names as several makers write them.
SHAPES: Mapping[str, Mapping[int, float]] = {
    "Grin.L": {12: 250.0, 6: 120.0},
    "Grin.R": {13: 250.0, 7: 120.0},
    "jawOpen": {3: 500.0},
    "Fcl_BRW_Surprised": dict.fromkeys(range(31, 37), 250.0),
    'eye "wide"': {19: -300.0, 20: -300.0},
    "lip up": {4: -200.0, 8: -150.0, 9: -150.0},
}
TIMING = ClipTiming(onset=0.2, apex=0.4, offset=0.2, start=1.0, fps=25.0)
#: A frame in the apex of that timing.
APEX = 10


def effects(face: api.Face) -> dict[str, np.ndarray]:
    """Key -> (V, 3) what it adds to the default head, metres."""
    made = {}
    for name, faps in SHAPES.items():
        asked = np.full(68, np.nan)
        for number, value in faps.items():
            asked[number - 1] = value
        made[name] = face.pose(asked, drive="exact").positions - face.vertices
    return made


def add_keys(obj: Any, changes: Mapping[str, np.ndarray], rows: Any = slice(None)) -> Any:
    """The shape keys of an object, made of changes (V, 3) of its mesh, all at 0."""
    if obj.data.shape_keys is None:
        obj.shape_key_add(name="Basis")
    rest = meshes.rest_vertices(obj.data)
    for name, change in changes.items():
        key = obj.shape_key_add(name=name, from_mix=False)
        key.value = 0.0
        meshes.write_key_vertices(key, rest + change[rows])
    return obj.data.shape_keys


def bake(
    obj: Any,
    word: str = "joy",
    *,
    clip: str = "",
    start: float = 1.0,
    companions: tuple[Companion, ...] = (),
    above: bool = True,
) -> BakeResult:
    """Bake a word onto the keys of a face."""
    profile = api.expression(word)
    timing = ClipTiming(onset=0.2, apex=0.4, offset=0.2, start=start, fps=25.0)
    work = bake_expression_onto(
        Target(obj, companions),
        profile.frame(),
        key_rig,
        clip=clip or word,
        timing=timing,
        onto=Onto(above=above),
        emotion=profile.weights,
    )
    return run(work)


def values(keys: Any, frame: int) -> dict[str, float]:
    """Key -> value at a frame, of all but the Basis."""
    bpy.context.scene.frame_set(frame)
    return {key.name: key.value for key in keys.key_blocks[1:]}
