"""The scene around the face of a job: one of our own is furnished and cut to its frames, a user's stays as it is."""

from __future__ import annotations

import bpy
import numpy as np

from ..pictures.framing import framing_of
from ..pictures.furniture import furnish
from ..pictures.look import Look
from .subjects import Subject


def cover(face: Subject, last: float) -> tuple[str, ...]:
    """Let a scene of our own end with the last frame baked, and show its first.

    Returns
    -------
    Remarks: that a user's scene, whose frames stay, ends before it.
    """
    scene, end = bpy.context.scene, int(np.ceil(last))
    if not face.in_own_scene:
        scene.frame_end = end
        scene.frame_set(scene.frame_start)
        return ()
    if end <= scene.frame_end:
        return ()
    return (f"the scene ends at frame {scene.frame_end}: set End to {end} to play all that was baked",)


def dress(face: Subject, look: Look) -> None:
    """Give a scene of our own a camera, lights, a world and render settings.

    Raises
    ------
    SceneError : the engine is not available.
    """
    if not face.in_own_scene:
        furnish(bpy.context.scene, framing_of(face.obj), look)
