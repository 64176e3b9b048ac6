"""What was asked for, as the data card of labels tells it: expressions in time, speech or a stream, with all seeds."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ..bake.motion import CueMotion, FapMotion

if TYPE_CHECKING:
    from ...api import Cue, FapStream, Saying
    from ...labels.felt import Felt


def felt_of(motion: CueMotion | FapMotion, meant: Saying | FapStream | None, fps: float) -> Felt:
    """What a motion at a frame rate is meant to show; `meant` : the speech or the stream that it is."""
    from ...api import Saying
    from ...labels.felt import Felt

    if isinstance(motion, CueMotion):
        return Felt.of_cues(motion.cues, fps)
    count = len(motion.stream)
    if meant is None:
        return Felt.of_faps(count, fps)
    return Felt.of_saying(meant) if isinstance(meant, Saying) else Felt.of_stream(meant, count, fps)


def told_motion(motion: CueMotion | FapMotion, meant: Saying | FapStream | None) -> dict[str, object]:
    """A motion as facts."""
    from ...api import Saying

    if isinstance(motion, CueMotion):
        lively = motion.liveliness
        drawn = {} if lively is None else {name: getattr(lively, name) for name in ("blinks", "head", "eyes")}
        return {
            "kind": "expressions in time",
            "cues": _told_cues(motion.cues),
            "liveliness": {name: {"amount": each.amount, "seed": each.seed} for name, each in drawn.items()},
            "tissue": motion.tissue if isinstance(motion.tissue, str) else repr(motion.tissue),
        }
    told: dict[str, object] = {"frames": len(motion.stream), "inertia": motion.inertia}
    if isinstance(meant, Saying):
        said = " ".join(word.text for word in meant.utterance.words)
        sounds = "".join(sound.phoneme.symbol for sound in meant.utterance.sounds)
        return {
            "kind": "speech",
            "said": said or f"/{sounds}/",
            "articulation": meant.articulation,
            "cues": _told_cues(meant.cues, meant.begin),
            "assumed": list(meant.assumed),
            **told,
        }
    if meant is None:
        return {"kind": "FAPs", **told}
    return {
        "kind": "stream of FAPs",
        "name": meant.name,
        "frames_per_second": meant.fps,
        "visemes": len(meant.visemes),
        "expressions": len(meant.expressions),
        **told,
    }


def _told_cues(cues: Sequence[Cue], begin: float = 0.0) -> list[dict[str, object]]:
    """Expressions and their times, seconds from the first frame."""
    return [
        {
            "word": cue.profile.word or "",
            "angle": cue.profile.angle,
            "activation": cue.profile.activation,
            "start": cue.start - begin,
            "onset": cue.onset,
            "apex": cue.apex,
            "offset": cue.offset,
            "peak": cue.peak,
            "ramp": str(cue.ramp),
            "seed": cue.seed,
        }
        for cue in cues
    ]
