"""Operators on speech on the timeline: added, copied, removed, and its sound fitted to its length."""

from __future__ import annotations

import bpy
from bpy.props import FloatProperty

from ...errors import RisoriusError, SceneError
from ...scene.bake.timing import scene_fps
from ...scene.sounds import frames_heard, is_missing, remove_sound, scrub_along, tagged
from ..active import active_object, face_reason
from ..annotated import Annotated
from ..base import RisoriusOperator
from ..blender_classes import Operator
from ..blender_types import Context, Object, Scene
from .fitting import fit_sound
from .heard import Heard, heard, nothing_said
from .placing import place_strip
from .sharing import drop_sound, stray_sounds
from .strip_props import STRETCH, RISORIUS_PG_speech_strip, active_strip, edited
from .strips import length_of, title_of_strip

#: Seconds by which a sound may be shorter than what is said in it.
SHORTER = 0.1
#: What is said of a mouth that was recorded.
ONLY_SOUNDS = "on the timeline a recorded mouth is open or closed; Import Recording plays it as it was recorded"
NO_STRIP = "There is no speech on the timeline yet: add some"


class StripOperator(RisoriusOperator):
    """What the operators on the active strip share."""

    needs_scipy = False

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only where there is speech."""
        if context.object is None:
            return "There is no active object"
        return None if chosen_strip(context.object) is not None else NO_STRIP


def chosen_strip(obj: Object) -> RISORIUS_PG_speech_strip | None:
    """The strip of a face that is being edited, or None."""
    return active_strip(obj.risorius.speech.strips, obj.risorius.speech.active)


def strip_of(context: Context) -> RISORIUS_PG_speech_strip:
    """The same, for those who have been told by a poll that there is one.

    Raises
    ------
    SceneError : there is none.
    """
    obj = active_object(context)
    strip = chosen_strip(obj)
    if strip is None:
        raise SceneError(obj.name, NO_STRIP)
    return strip


def add_strip(operator: RisoriusOperator, context: Context, said: Heard) -> str:
    """Put what is said on the timeline, from the current frame on, with its sound; what to tell the user."""
    obj, scene = active_object(context), context.scene
    start, utterance = int(scene.frame_current), said.utterance
    told = [(False, line) for line in utterance.assumed]
    if utterance.mouth is not None:
        told.append((False, f"{said.title}: {ONLY_SOUNDS}"))
    try:
        strip, sound = place_strip(obj, scene, utterance, said.title, start, file=said.file, wav=said.wav)
    except RisoriusError as refusal:
        told.append((False, f"Without sound: {refusal}"))
        strip, sound = place_strip(obj, scene, utterance, said.title, start)
    if sound is not None:
        heard_for = frames_heard(sound) / scene_fps(scene)
        last = utterance.sounds[-1].end
        if heard_for < last - SHORTER:
            lasts = f"{said.title}: the sound lasts {heard_for:.1f} s, but the speech {last:.1f} s"
            told.append((False, f"{lasts}: the mouth goes on without it"))
        told += [(True, line) for line in scrub_along(scene)]
    for is_remark, text in told:
        operator.report({"INFO"} if is_remark else {"WARNING"}, text)
    count = len(strip.words)
    return f"Added {title_of_strip(strip)} at frame {start}: {count} word{'s' * (count != 1)}, {length_of(strip):.1f} s"


class RISORIUS_OT_add_speech(RisoriusOperator, Operator):
    """Put what is said on the timeline, starting at the current frame; its sound goes to the sequencer"""

    bl_idname = "risorius.add_speech"
    bl_label = "Add Speech"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only on a face, and where something is said."""
        return face_reason(context.object) or nothing_said(active_object(context).risorius.speech)

    def run(self, context: Context) -> str:
        """Speak or read it, and add it."""
        return add_strip(self, context, heard(active_object(context).risorius.speech))


class RISORIUS_OT_remove_speech(StripOperator, Operator):
    """Remove the selected speech and its sound from the timeline. Baked animation stays until the next bake"""

    bl_idname = "risorius.remove_speech"
    bl_label = "Remove Speech"
    bl_options = {"REGISTER", "UNDO"}

    def run(self, context: Context) -> str:
        """Remove it; the one after it, or the last, is selected then."""
        speech, strip = active_object(context).risorius.speech, strip_of(context)
        title, place = title_of_strip(strip), int(speech.active)
        drop_sound(strip)
        speech.strips.remove(place)
        speech.active = max(0, min(place, len(speech.strips) - 1))
        edited(speech, context)
        return f"Removed {title}"


class RISORIUS_OT_remove_stray_sounds(RisoriusOperator, Operator):
    """Remove sounds from the sequencer that were added with the speech of a face that is gone"""

    bl_idname = "risorius.remove_stray_sounds"
    bl_label = "Remove Leftover Sounds"
    bl_options = {"REGISTER", "UNDO"}
    needs_scipy = False

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only where there are some."""
        return None if stray_sounds(context.scene) else "No sound of speech is left over"

    def run(self, context: Context) -> str:
        """Remove them."""
        strays = [(tag, str(sound.name)) for tag, sound in stray_sounds(context.scene)]
        for tag, _ in strays:
            remove_sound([context.scene], tag)
        return f"Removed {', '.join(name for _, name in strays)}"


class RISORIUS_OT_fit_speech_sound(StripOperator, Operator):
    """Stretch the sound to the length of the selected speech and keep its pitch, or put a sound back that is gone"""

    bl_idname = "risorius.fit_speech_sound"
    bl_label = "Fit Sound"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only where there is a sound that does not fit."""
        reason = super().refusal(context)
        if reason is not None:
            return reason
        strip = strip_of(context)
        if strip.sound is None:
            return "This speech has no sound"
        return None if sound_is_off(strip) else "The sound fits already"

    def run(self, context: Context) -> str:
        """Fit it."""
        return fitted(context.scene, strip_of(context))


def fitted(scene: Scene, strip: RISORIUS_PG_speech_strip) -> str:
    """Let a strip's sound last as long as what is said; what to tell the user.

    Raises
    ------
    FormatError : the sound cannot be read; it stays as it was then.
    """
    fit_sound(scene, strip)
    return f"The sound lasts {length_of(strip):.1f} s with {title_of_strip(strip)}"


def sound_is_off(strip: RISORIUS_PG_speech_strip) -> bool:
    """Whether a strip's sound is stretched otherwise than what is said, or gone from the sequencer."""
    if strip.sound is None:
        return False
    return abs(strip.fitted - strip.stretch) > 1e-4 or not any(tagged(bpy.data.scenes, strip.tag))


class RISORIUS_OT_stretch_speech(StripOperator, Operator):
    """Let the selected speech last longer or shorter, with its sound, whose pitch is kept"""

    bl_idname = "risorius.stretch_speech"
    bl_label = "Stretch Speech"
    bl_options = {"REGISTER", "UNDO"}

    stretch: Annotated[
        float,
        FloatProperty(
            name="Stretch",
            description="How many times longer the speech lasts than it was recorded",
            default=1.0,
            min=STRETCH[0],
            max=STRETCH[1],
        ),
    ]

    def run(self, context: Context) -> str:
        """Stretch both."""
        strip = strip_of(context)
        strip.stretch = self.stretch
        if strip.sound is not None and sound_is_off(strip):
            if is_missing(strip.sound):
                self.report({"WARNING"}, f"{title_of_strip(strip)}: its sound is missing and is not stretched")
            else:
                fitted(context.scene, strip)
        return f"{title_of_strip(strip)} lasts {length_of(strip):.1f} s"
