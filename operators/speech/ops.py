"""The operator that lets a face speak."""

from __future__ import annotations

import tempfile
from pathlib import Path

import bpy

from ...errors import FormatError, RisoriusError
from ...progress import Progress, Work, part_of
from ...scene.bake.baking import BakeResult
from ...scene.bake.motion import FapMotion
from ...scene.bake.timing import scene_fps
from ...scene.points.found import Finding
from ...scene.sounds import add_sound
from ...speech.utterance import Utterance
from ..active import active_object
from ..bake.destination import bake_reason
from ..bake.ops import BakeOperator
from ..bake.work import stream_work
from ..blender_classes import Operator
from ..blender_types import Context, Scene
from ..emotion.performance import Performance, performance_of
from .props import RISORIUS_PG_speech

#: The share of finding out what is said in the whole.
READING = 0.1
#: Letters of a text that name its clip.
NAMED = 24


class RISORIUS_OT_speak(BakeOperator, Operator):
    """Bake what is said, with feeling, starting at the current frame; its sound goes to the sequencer"""

    bl_idname = "risorius.speak"
    bl_label = "Speak"
    bl_options = {"REGISTER", "UNDO"}
    title = "Baking the speech"

    _said: tuple[str, ...] = ()
    _sound: Path | None = None
    _voice: bytes | None = None
    _start: int = 1

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only where it can be baked, and something is said."""
        reason = bake_reason(context.object)
        if reason is not None:
            return reason
        chosen = active_object(context).risorius.speech
        if chosen.source == "TEXT":
            return None if chosen.text.strip() else "Nothing is said yet: write a text"
        return None if chosen.timings else "Nothing is said yet: choose a file of timings"

    def show_apex(self, context: Context) -> None:
        """Stay at the frame: it is where the speech begins."""

    def baking(self, context: Context) -> Work[BakeResult]:
        """Find out what is said when, then bake it from the current frame on."""
        from ... import api

        obj, scene = active_object(context), context.scene
        chosen, fps = obj.risorius.speech, scene_fps(scene)
        yield Progress(0.0, "Speaking the text" if chosen.source == "TEXT" else "Reading the timings")
        utterance = self._utterance(chosen)
        performance = performance_of(obj, scene)
        feels, clips = bool(chosen.with_feeling), bool(obj.risorius.timeline.clips)
        saying = api.say(
            utterance,
            emotion=performance.wanted[0].profile if feels and not clips else None,
            cues=performance.cues if feels and clips else (),
            begin=(scene.frame_current - performance.first_frame) / performance.fps if clips else 0.0,
            fps=fps,
            articulation=float(chosen.articulation),
            jaw=float(chosen.jaw),
            lean=float(chosen.lean),
            liveliness=performance.liveliness,
            seed=performance.cues[0].seed if feels and not clips else None,
        )
        said = _unshown(performance) if chosen.with_feeling else []
        self._said, self._start = (*utterance.assumed, *said), int(scene.frame_current)
        motion = FapMotion(saying.stream.frames, saying.emotions, planned=True)
        work = stream_work(obj, scene, motion, clip=_clip_name(chosen), start=float(self._start))
        return (yield from part_of(work, READING, 1.0))

    def _utterance(self, chosen: RISORIUS_PG_speech) -> Utterance:
        """What is said when, and its sound."""
        from ... import api

        self._sound = self._voice = None
        if chosen.source == "TEXT":
            voiced = api.speak(chosen.text, voice=chosen.voice, speed=int(chosen.speed), pitch=int(chosen.pitch))
            self._voice = voiced.wav()
            return voiced.utterance
        if chosen.sound:
            self._sound = Path(bpy.path.abspath(chosen.sound))
            if not self._sound.is_file():
                raise FormatError(self._sound, "does not exist: check the path of the sound")
        utterance: Utterance = api.read_timings(bpy.path.abspath(chosen.timings), tier=chosen.tier.strip() or None)
        return utterance

    def finish(self, context: Context, result: BakeResult | Finding) -> str:
        """Put the sound where it belongs, and say what was assumed."""
        if not isinstance(result, Finding):
            for line in self._said:
                self.report({"WARNING"}, line)
            try:
                self._add_sound(context.scene, result.clip)
            except RisoriusError as refusal:
                self.report({"WARNING"}, f"Without sound: {refusal}")
        return super().finish(context, result)

    def _add_sound(self, scene: Scene, clip: str) -> None:
        """The file's sound as it is; a voice's packed into the .blend, since it has no file."""
        if self._sound is not None:
            add_sound(scene, self._sound, frame=self._start)
        elif self._voice is not None:
            with tempfile.TemporaryDirectory(prefix="risorius-", ignore_cleanup_errors=True) as folder:
                path = Path(folder) / f"{clip}.wav"
                path.write_bytes(self._voice)
                add_sound(scene, path, frame=self._start, packed=True)


def _unshown(performance: Performance) -> list[str]:
    """What of the feelings speech does not show."""
    if any(wanted.contractions for wanted in performance.wanted):
        return ["Muscles set by hand do not show while the face speaks"]
    return []


def _clip_name(chosen: RISORIUS_PG_speech) -> str:
    """A name by what is said."""
    if chosen.source != "TEXT":
        return Path(bpy.path.abspath(chosen.timings)).stem
    words = " ".join(chosen.text.split())
    return words if len(words) <= NAMED else f"{words[: NAMED - 1].rsplit(' ', 1)[0]}..."
