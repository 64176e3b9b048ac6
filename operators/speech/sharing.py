"""Whose a sound on the sequencer is: copies of a face share one until they differ, and a face that goes leaves it."""

from __future__ import annotations

import contextlib
import uuid

import bpy

from ...errors import RisoriusError
from ...scene.blender_types import SequencerStrip
from ...scene.sounds import TAG, copy_sound, marked, remove_sound, tagged
from ..active import all_objects
from ..blender_types import Object, Scene
from .strip_props import RISORIUS_PG_speech_strip


def sharing(strip: RISORIUS_PG_speech_strip) -> list[Object]:
    """The other faces whose speech has the same sound: copies of its face."""
    own = strip.id_data
    if not strip.tag:
        return []
    others = (obj for obj in all_objects() if obj != own)
    return [obj for obj in others if any(other.tag == strip.tag for other in obj.risorius.speech.strips)]


def part_sound(strip: RISORIUS_PG_speech_strip) -> None:
    """Give a strip a sound of its own, before it is moved, muted or stretched, where a copy of its face shares it.

    That of a scene that the copies are not in is its own already. Where the sound is missing, there is none to give.
    """
    others = sharing(strip)
    if not others:
        return
    shared, strip.tag = strip.tag, uuid.uuid4().hex
    theirs = [scene for obj in others for scene in obj.users_scene]
    scenes = list(strip.id_data.users_scene)
    alone = [scene for scene in scenes if scene not in theirs and any(tagged([scene], shared))]
    for _, sound in list(tagged(alone, shared)):
        sound[TAG] = strip.tag
    for scene in [] if alone else scenes[:1]:
        for _, sound in list(tagged([scene], shared)):
            with contextlib.suppress(RisoriusError):  # its file is missing, which the panel says
                copy_sound(scene, sound, tag=strip.tag)


def drop_sound(strip: RISORIUS_PG_speech_strip) -> None:
    """Take a strip's sound away, unless a copy of its face has it, too."""
    if not sharing(strip):
        remove_sound(bpy.data.scenes, strip.tag)


def stray_sounds(scene: Scene) -> list[tuple[str, SequencerStrip]]:
    """The sounds of speech on a scene's sequencer whose face is gone, with their tags."""
    found = list(marked(scene))
    if not found:
        return []
    held = {strip.tag for obj in all_objects() for strip in obj.risorius.speech.strips}
    return [(tag, sound) for tag, sound in found if tag not in held]
