"""What is in the file only while work goes on, such as the scene of a render: marked, and taken away where it is left.

A save, an autosave or an undo step between two steps of such work has it, too. Nothing of that may stay for ever.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeVar

import bpy

from .blender_types import Datablock, Scene

#: The mark, a custom property.
MARK = "risorius_passing"
#: Where there may be marked ones; the users of a datablock before what it uses.
WHERE = ("objects", "meshes", "armatures", "lattices", "cameras", "lights", "worlds")

Made = TypeVar("Made", bound=Datablock)


def passing(made: Made) -> Made:
    """Mark what will be removed again; returns it."""
    made[MARK] = True
    return made


def passing_scene(name: str) -> Scene:
    """A new scene that will be removed again."""
    scene: Scene = bpy.data.scenes.new(name)
    return passing(scene)


def remove_left() -> None:
    """Take all that is marked out of the file: whoever has made it is gone, or begins anew."""
    left = [made for kind in WHERE for made in _marked(getattr(bpy.data, kind))]
    keys = [made.shape_keys for made in left if isinstance(made, bpy.types.Mesh) and made.shape_keys is not None]
    scenes = _marked(bpy.data.scenes)
    if len(scenes) == len(bpy.data.scenes):
        scenes = scenes[1:]  # a file cannot do without
    for scene in scenes:
        bpy.data.scenes.remove(scene)
    bpy.data.batch_remove([*left, *keys])


def _marked(datablocks: Iterable[Datablock]) -> list[Datablock]:
    """Those of the file itself that are marked."""
    return [made for made in datablocks if made.library is None and MARK in made]
