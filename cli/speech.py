"""The verb say: speech with feeling, as a stream, a video or a .blend."""

from __future__ import annotations

import argparse
import contextlib
import sys
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..files import scratch_folder
from ..progress import Work, run
from .films import destination_of, in_blender, labels_of, lines_of, needing_blender
from .options import (
    Verbs,
    add_film,
    add_strength,
    expression_of,
    onto_options,
    refuse_idle,
    scene_options,
    verb,
)
from .progress import ShowProgress, when_slow
from .result import Result, UsageError

if TYPE_CHECKING:
    from ..api import Saying, Utterance

#: Endings of what Blender makes; others are streams.
BLENDER = (".blend", ".mp4")
#: What is set for them alone.
SCENE = (
    "mesh", "points", "object_name", "onto", "symmetric", "smooth", "into_action", "max_keys", "engine", "creases",
)  # fmt: skip


def add_speech_verb(verbs: Verbs) -> None:
    """Add say to the verbs."""
    say = verb(verbs, "say", _say)
    say.add_argument("text", nargs="?", metavar="TEXT", help="what is said, by a voice of eSpeak NG")
    about = "instead: what is said when, by a Praat TextGrid, Rhubarb's JSON, TSV or XML, or a table or JSON of sounds"
    say.add_argument("--timings", type=Path, metavar="FILE", help=about)
    about = (
        "the sound, from the same beginning; alone: the mouth opens as loud as it is. With TEXT: where the voice is "
    )
    say.add_argument("--sound", type=Path, metavar="FILE", help=f"{about}written, as WAV (default: beside a .blend)")
    about = "language of TEXT, as en, de, fr, with a variant: en+f3 (default: en)"
    say.add_argument("--voice", metavar="CODE", help=about)
    say.add_argument("--speed", type=float, help="words per minute of TEXT, 80 to 450 (default: 175)")
    say.add_argument("--pitch", type=float, help="of the voice, 0 to 99 (default: 50)")
    say.add_argument("--tier", metavar="NAME", help="tier of a TextGrid with the sounds (default: found)")
    about = "how sounds are written: ipa, arpabet or xsampa (default: found)"
    say.add_argument("--alphabet", choices=("ipa", "arpabet", "xsampa"), help=about)
    say.add_argument("--emotion", dest="word", metavar="WORD", help="what is felt meanwhile (default: nothing)")
    say.add_argument("--angle", type=float, help="the same as a point of the emotion wheel, in degrees")
    add_strength(say)
    say.add_argument("--seed", type=int, help="draws the way in which the emotion shows, blinks and small motions")
    say.add_argument(
        "--articulation", type=float, default=1.0, help="how distinctly the lips move, 0 to 2 (default: 1)"
    )
    say.add_argument("--jaw", type=float, default=1.0, help="how far the jaw opens, 0 to 2 (default: 1)")
    about = "how far the mouth leans to the emotion while speaking, 0 to 2 (default: 1)"
    say.add_argument("--lean", type=float, default=1.0, help=about)
    say.add_argument("--still", action="store_true", help="no blinks and no small motions of head and eyes")
    say.add_argument("--fps", type=float, help="frames per second (default: those of a .blend, else 25)")
    add_film(say)
    about = "what to write: a stream (.fap, .fba, .json, .csv), a video (.mp4) or a .blend"
    say.add_argument("--out", type=Path, required=True, help=about)


def _say(arguments: argparse.Namespace) -> Result:
    """Say something, with feeling, as a voice speaks it or as its sounds were timed (.mp4 and .blend need Blender)."""
    from .. import api

    suffix = arguments.out.suffix.lower()
    if suffix not in (*api.WRITABLE_STREAMS, *BLENDER):
        raise UsageError(f"--out must end in one of {', '.join((*api.WRITABLE_STREAMS, *BLENDER))}")
    if suffix != ".mp4":
        labels_of(arguments)
    if suffix not in BLENDER:
        refuse_idle(arguments, "is for a .blend or .mp4: leave it out with a stream", *SCENE)
    if arguments.word is None and arguments.angle is None:
        refuse_idle(arguments, "needs --emotion or --angle", "activation", "variant", "lean")
    with _heard(arguments) as (utterance, sound):
        for line in utterance.assumed:
            print(f"note: {line}", file=sys.stderr)
        say = partial(_said, utterance, arguments)
        told: dict[str, Any] = {
            "sounds": len(utterance.sounds),
            "words": [word.text for word in utterance.words],
            "seconds": utterance.duration,
            "assumed": list(utterance.assumed),
            "sound": sound if arguments.sound is not None or suffix == ".blend" else None,
        }
        if suffix in BLENDER:
            return _in_blender(arguments, say, sound, told)
        saying = run(say(25.0 if arguments.fps is None else arguments.fps), when_slow())
        stream, more = saying.stream, saying.assumed[len(utterance.assumed) :]
        for line in more:
            print(f"note: {line}", file=sys.stderr)
        told["assumed"] += more
        api.write_stream(arguments.out, stream, progress=when_slow(), decimals=0)
    line = f"wrote {arguments.out}: {len(stream.frames)} frames at {stream.fps:g} per second, {told['sounds']} sounds"
    return Result({**told, "frames": len(stream.frames), "fps": stream.fps, "out": arguments.out}, [line])


@contextlib.contextmanager
def _heard(arguments: argparse.Namespace) -> Iterator[tuple[Utterance, Path | None]]:
    """What is said when, and its sound where there is one; the sound of a text may last only as long as this."""
    from .. import api

    if arguments.text is not None and arguments.timings is not None:
        raise UsageError("give either a text, or --timings with what is said when")
    if arguments.text is None and arguments.timings is None:
        if arguments.sound is None:
            raise UsageError("give a text, or --timings with what is said when, or at least a --sound")
        arguments.timings = arguments.sound
    suffix = arguments.out.suffix.lower()
    if arguments.timings is not None:
        for name in ("voice", "speed", "pitch"):
            if getattr(arguments, name) is not None:
                raise UsageError(f"--{name} needs a text, not --timings")
        if arguments.sound not in (None, arguments.timings) and suffix not in BLENDER:
            raise UsageError("--sound needs --out to end in .blend or .mp4: a stream holds no sound")
        yield api.read_timings(arguments.timings, tier=arguments.tier, alphabet=arguments.alphabet), arguments.sound
        return
    for name in ("tier", "alphabet"):
        if getattr(arguments, name) is not None:
            raise UsageError(f"--{name} needs --timings")
    given = {name: getattr(arguments, name) for name in ("voice", "speed", "pitch")}
    voiced = api.speak(arguments.text, **{name: value for name, value in given.items() if value is not None})
    beside = arguments.out.with_suffix(".wav") if suffix == ".blend" else None
    with scratch_folder() as folder:
        sound = arguments.sound or beside or folder / "voice.wav"
        new = sound == beside and not sound.exists()
        voiced.write(sound)
        try:
            yield voiced.utterance, sound
        except BaseException:  # Ctrl+C, too: without the .blend, nobody has asked for it
            if new:
                sound.unlink(missing_ok=True)
            raise


def _said(utterance: Utterance, arguments: argparse.Namespace, fps: float) -> Work[Saying]:
    """What is said at a frame rate."""
    from .. import api

    felt = expression_of(arguments) if arguments.word is not None or arguments.angle is not None else None
    liveliness = None if arguments.still else api.Liveliness.usual(arguments.seed)
    numbers = {name: getattr(arguments, name) for name in ("articulation", "jaw", "lean", "seed")}
    return api.say_steps(utterance, emotion=felt, fps=fps, liveliness=liveliness, **numbers)


def _in_blender(arguments: argparse.Namespace, say: Any, sound: Path | None, told: dict[str, Any]) -> Result:
    """A video or a .blend."""
    onto, shared = onto_options(arguments), scene_options(arguments)
    with needing_blender():
        from ..scene.jobs.saying import say_file
    shared |= {name: getattr(arguments, name) for name in ("creases", "engine", "fps")} | {"sound": sound}
    shared["labels"] = labels_of(arguments)
    with in_blender():
        made = dict(say_file(arguments.out, say, **shared, destination=destination_of(onto), progress=ShowProgress()))
    return Result({**made, **told}, lines_of(made))
