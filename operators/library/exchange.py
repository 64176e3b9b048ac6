"""Between what is chosen for a face and what a preset file holds."""

from __future__ import annotations

import math
from pathlib import Path

import bpy

from ...errors import ParameterError
from ...mpeg4.preset_file import VARIATIONS, Choice, Clip, Preset, PresetKind
from ...mpeg4.timing import Ramp
from ...resources import PRESETS
from ...scene.bake.timing import scene_fps
from ..blender_types import Context, Object, Scene
from ..changes import changed, retimed
from ..emotion.profile import variant_of
from ..emotion.props import DEFAULT_VARIANT, RISORIUS_PG_emotion
from ..muscles.props import by_hand_of
from ..timeline.props import RISORIUS_PG_clip, RISORIUS_PG_timeline
from .spoken import kept_speech, lay_out_speech

#: Presets that come with Risorius.
BUNDLED = PRESETS / "timelines"


def own_folder(*, create: bool = False) -> Path | None:
    """Where the user's presets are, beside Blender's own; None where there is no such folder yet."""
    place = bpy.utils.user_resource("SCRIPTS", path="presets/risorius/faces", create=create)
    return Path(place) if place else None


def preset_files() -> list[Path]:
    """The user's presets, then those that come with Risorius."""
    own = own_folder()
    return [*(sorted(own.glob("*.toml")) if own is not None else ()), *sorted(BUNDLED.glob("*.toml"))]


def expression_of(obj: Object) -> Preset:
    """What the Emotion panel shows, with what is contracted by hand."""
    return Preset(PresetKind.EXPRESSION, choice_of(obj.risorius.emotion), contractions=_rounded(by_hand_of(obj)))


def timeline_of(obj: Object, scene: Scene, path: Path | None = None) -> Preset:
    """All clips and speech, their variation and what is contracted by hand; sounds go beside the preset's path.

    Raises
    ------
    FormatError : a sound cannot be written.
    """
    timeline, strips, fps = obj.risorius.timeline, obj.risorius.speech.strips, scene_fps(scene)
    first = min([clip.start for clip in timeline.clips] + [strip.start for strip in strips])
    speech = tuple(kept_speech(strip, (strip.start - first) / fps, path, n) for n, strip in enumerate(strips, 1))
    clips = tuple(_clip_of(clip, (clip.start - first) / fps) for clip in timeline.clips)
    variation = {
        name: (round(getattr(timeline.variation, name), 6), getattr(timeline.variation, f"{name}_seed"))
        for name in VARIATIONS
        if getattr(timeline.variation, name) > 0.0
    }
    hands = _rounded(by_hand_of(obj))
    return Preset(PresetKind.TIMELINE, clips=clips, contractions=hands, variation=variation, speech=speech)


def choice_of(emotion: RISORIUS_PG_emotion) -> Choice:
    """A chosen emotion."""
    if emotion.by == "WHEEL":
        angle = math.degrees(emotion.angle) % 360.0
        return Choice(round(emotion.activation, 6), angle=round(angle, 4), seed=emotion.seed)
    return Choice(round(emotion.activation, 6), emotion.word, variant=variant_of(emotion), seed=emotion.seed)


def _clip_of(clip: RISORIUS_PG_clip, start: float) -> Clip:
    """A clip that begins at `start` seconds."""
    times = [round(getattr(clip, name), 6) for name in ("onset", "apex", "offset")]
    peak, ramp = round(clip.peak, 6), Ramp(clip.ramp)
    return Clip(choice_of(clip.emotion), start, *times, peak=peak, ramp=ramp, name=clip.name, mute=clip.mute)


def _rounded(contractions: dict[str, float]) -> dict[str, float]:
    """Contractions without the noise of single precision."""
    return {name: round(value, 6) for name, value in contractions.items()}


def load(preset: Preset, obj: Object, context: Context, folder: Path | None = None) -> tuple[str, list[str]]:
    """Give a face what a preset holds: an expression to the Emotion panel, or a timeline from the current frame on.

    `folder` : where sounds are that have no path of their own. Returns what was done, and what could not be, in words.

    Raises
    ------
    ParameterError : it names a muscle that is not known; nothing has been changed then.
    """
    _check_muscles(preset)
    said: list[str] = []
    if preset.emotion is not None:
        choose(obj.risorius.emotion, preset.emotion)
    else:
        _lay_out(preset, obj.risorius.timeline, context.scene)
        said = lay_out_speech(preset.speech, obj, context.scene, folder or Path())
    by_hand = obj.risorius.muscles.by_hand
    by_hand.clear()
    for name, value in preset.contractions.items():
        entry = by_hand.add()
        entry.name, entry.contraction = name, value
    retimed(obj.risorius.timeline, context)
    changed(obj.risorius.emotion, context)
    spoken = f" and {len(preset.speech)} speech" if preset.speech else ""
    what = "expression" if preset.emotion is not None else f"{len(preset.clips)} clips{spoken}"
    return f"{obj.name}: loaded {what}", said


def choose(emotion: RISORIUS_PG_emotion, choice: Choice) -> None:
    """Set a chosen emotion."""
    if choice.word is not None:
        emotion.word = choice.word
        emotion.variant = DEFAULT_VARIANT if choice.variant is None else str(choice.variant)
    emotion.activation, emotion.seed = choice.activation, choice.seed
    if choice.angle is not None:
        emotion.angle = math.radians(choice.angle)
    emotion.by = "WORD" if choice.angle is None else "WHEEL"


def _lay_out(preset: Preset, timeline: RISORIUS_PG_timeline, scene: Scene) -> None:
    """Put a preset's clips in place of those on a timeline."""
    linked, fps = timeline.linked, scene_fps(scene)
    timeline.linked = False
    timeline.clips.clear()
    for held in preset.clips:
        clip = timeline.clips.add()
        choose(clip.emotion, held.emotion)
        clip.name, clip.mute, clip.ramp, clip.peak = held.name, held.mute, held.ramp.value, held.peak
        clip.start = scene.frame_current + round(held.start * fps)
        clip.onset, clip.apex, clip.offset = held.onset, held.apex, held.offset
    for name in VARIATIONS:
        amount, seed = preset.variation.get(name, (0.0, 1))
        setattr(timeline.variation, name, amount)
        setattr(timeline.variation, f"{name}_seed", seed)
    timeline.active, timeline.linked = 0, linked


def _check_muscles(preset: Preset) -> None:
    """Every muscle must be known."""
    if preset.contractions:
        from ...face.contractible import contractibles

        for name in preset.contractions:
            if name not in contractibles():
                raise ParameterError("muscle in the preset", "must be a known muscle", name)
