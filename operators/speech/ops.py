"""The operator that lets a face speak."""

from __future__ import annotations

from ...errors import RisoriusError
from ...progress import Progress, Work, part_of
from ...scene.bake.baking import BakeResult
from ...scene.bake.motion import FapMotion
from ...scene.bake.timing import scene_fps
from ...scene.points.found import Finding
from ...scene.sounds import add_sound, add_wav
from ..active import active_object
from ..bake.destination import bake_reason
from ..bake.ops import BakeOperator
from ..bake.work import stream_work, unshown
from ..blender_classes import Operator
from ..blender_types import Context, Scene
from ..emotion.performance import performance_of
from .heard import Heard, heard, nothing_said

#: The shares of finding out what is said in the whole, and of that and what the face does then.
READING, SAYING = 0.1, 0.15


class RISORIUS_OT_speak(BakeOperator, Operator):
    """Bake what is said, with feeling, starting at the current frame; its sound goes to the sequencer"""

    bl_idname = "risorius.speak"
    bl_label = "Speak"
    bl_options = {"REGISTER", "UNDO"}
    title = "Baking the speech"

    _said: tuple[str, ...] = ()
    _heard: Heard | None = None
    _start: int = 1

    @classmethod
    def refusal(cls, context: Context) -> str | None:
        """Only where it can be baked, and something is said."""
        reason = bake_reason(context.object)
        if reason is not None:
            return reason
        return nothing_said(active_object(context).risorius.speech)

    def show_apex(self, context: Context) -> None:
        """Stay at the frame: it is where the speech begins."""

    def baking(self, context: Context) -> Work[BakeResult]:
        """Find out what is said when, then bake it from the current frame on."""
        from ...speech.saying import say_steps

        obj, scene = active_object(context), context.scene
        chosen, fps = obj.risorius.speech, scene_fps(scene)
        yield Progress(0.0, "Speaking the text" if chosen.source == "TEXT" else "Reading the timings")
        self._heard = heard(chosen)
        utterance = self._heard.utterance
        performance = performance_of(obj, scene)
        feels, clips = bool(chosen.with_feeling), bool(obj.risorius.timeline.clips)
        work = say_steps(
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
        saying = yield from part_of(work, READING, SAYING)
        said = unshown(performance) if chosen.with_feeling else ()
        self._said, self._start = (*saying.assumed, *said), int(scene.frame_current)
        motion = FapMotion(saying.stream.frames, saying.emotions, planned=True)
        baking = stream_work(obj, scene, motion, clip=self._heard.title, start=float(self._start))
        return (yield from part_of(baking, SAYING, 1.0))

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
        if self._heard is not None and self._heard.file is not None:
            add_sound(scene, self._heard.file, frame=self._start)
        elif self._heard is not None and self._heard.wav is not None:
            add_wav(scene, self._heard.wav, clip, frame=self._start)
