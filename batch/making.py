"""One job, by the jobs of scene: what its row says as the parameters of a clip."""

from __future__ import annotations

import math
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from ..progress import Work
from .jobs import Job
from .values import linear_colour, pixels

if TYPE_CHECKING:
    from ..api import Liveliness, Profile, Saying, Utterance
    from ..scene.jobs.clip import Clip, Look, MadeClip
    from ..scene.jobs.shown import ShownAt

#: Outputs in which something is pictured, and those of them that are drawn.
PICTURED, DRAWN = {"still", "film", "blend", "labels"}, {"still", "film", "blend"}
#: Columns of the camera, and all of the picture.
CAMERA = ("size", "yaw", "pitch", "roll", "lens", "distance")
PICTURE = (*CAMERA, "engine", "samples", "light", "light_yaw", "ambient", "background")
#: Frames per second where nothing says so.
FPS = 25.0


def ready_blender(heads: Path) -> None:
    """Load Blender, and keep prepared heads in a folder.

    Raises
    ------
    ModuleNotFoundError : there is no Blender around.
    """
    from ..scene.jobs.clip import keep_heads

    keep_heads(heads)


def make(job: Job, folder: Path, scratch: Path) -> Work[MadeClip]:
    """Make a job in `folder`; `scratch` is for what is not kept.

    Raises
    ------
    RisoriusError : it cannot be made; names the thing and the remedy.
    """
    from ..scene.jobs.clip import make_clip

    return (yield from make_clip(folder, clip_of(job, scratch)))


def clip_of(job: Job, scratch: Path) -> Clip:
    """A job as a clip; a voice is written into `scratch`."""
    from ..scene.jobs.clip import Clip
    from ..scene.jobs.inputs import Input

    fps, sound = job.maybe("fps"), None
    if job.text("text"):
        shown, sound = _speech(job, scratch)
    elif "fap" in job.inputs:
        shown, own = _stream(job)
        fps = own if fps is None else fps
    else:
        shown = _expression(job)
    creases, skin = job.values["creases"], job.text("skin")
    return Clip(
        name=job.text("emotion") or job.id,
        face=Input.of(
            job.inputs.get("head"), job.inputs.get("points"), job.text("object") or None, FPS if fps is None else fps
        ),
        shown=shown,
        outputs=job.outputs,
        look=_look(job),
        sound=sound,
        skin=linear_colour(skin) if skin else None,
        still_at=job.maybe("still_at"),
        creases=creases if isinstance(creases, bool) else None,
        drive=job.text("drive"),
        max_keys=job.whole("max_keys"),
        label_pictures=job.whole("label_pictures") or 0,
        licence=job.text("licence"),
        facts={"row": job.said()},
        remarks=unheeded(job),
    )


def unheeded(job: Job) -> tuple[str, ...]:
    """What the row says that does not show in what it asks for, for people."""
    outputs, idle = set(job.outputs), dict[str, str]()
    if not outputs & PICTURED:
        idle |= dict.fromkeys(PICTURE, "where nothing is pictured")
    elif not outputs & DRAWN:
        idle |= dict.fromkeys(set(PICTURE) - set(CAMERA), "where nothing is drawn")
    elif job.text("engine") != "CYCLES":
        idle["samples"] = "in engines other than Cycles"
        if job.text("engine") == "WORKBENCH" and "blend" not in outputs:
            idle |= dict.fromkeys(("ambient", "creases"), "in Workbench")
    if not outputs & {"film", "blend", "glb"}:
        idle["max_keys"] = "where nothing moves"
    said = [name for name in job.said() if name in idle]
    return tuple(f"{name} says nothing {idle[name]}" for name in said)


def _expression(job: Job) -> ShownAt:
    """An emotion that comes and goes."""
    from .. import api
    from ..scene.jobs.shown import expressions

    timing = api.load_timings()[job.text("timing")]
    seconds = {name: job.maybe(name) for name in ("onset", "apex", "offset")}
    onset, apex, offset = (getattr(timing, name) if value is None else value for name, value in seconds.items())
    cue = api.Cue(
        _profile(job),
        start=job.number("before"),
        onset=onset,
        apex=apex,
        offset=offset,
        peak=timing.peak,
        ramp=timing.ramp,
    )
    return expressions([cue], liveliness=_liveliness(job), tissue=job.text("tissue"), rest=job.number("after"))


def _profile(job: Job) -> Profile:
    """What is felt, drawn by the seed where there is one."""
    from .. import api

    said = job.text("variant")
    variant = int(said) if said.isdigit() else said or None
    activation, angle = job.maybe("activation"), job.maybe("angle")
    if angle is not None:
        profile = api.expression(angle=angle, activation=activation, variants=variant)
    else:
        profile = api.expression(job.text("emotion"), activation=activation, variants=variant)
    seed = job.whole("seed")
    return profile if seed is None else api.drawn_within(profile, api.Drawn(job.number("variation"), seed))


def _liveliness(job: Job) -> Liveliness:
    """Blinks and small motions, drawn by the seed."""
    from .. import api

    seed, amount = job.whole("seed") or 0, job.number("liveliness")
    usual = {"blinks": api.Liveliness.usual(0).blinks.amount * amount, "head_motion": amount, "eye_motion": amount}
    given = {name: job.maybe(name) for name in usual}
    blinks, head, eyes = (api.Drawn(usual[name] if value is None else value, seed) for name, value in given.items())
    return api.Liveliness(blinks=blinks, head=head, eyes=eyes)


def _stream(job: Job) -> tuple[ShownAt, float]:
    """A stream of FAPs or a recording, and its own rate."""
    from .. import api
    from ..scene.jobs.shown import stream

    read = api.read_stream(job.inputs["fap"])
    return stream(read), read.fps


def _speech(job: Job, scratch: Path) -> tuple[ShownAt, Path]:
    """A text spoken by a voice, and its sound."""
    from .. import api
    from ..scene.jobs.shown import speech

    voiced = api.speak(
        job.text("text"), voice=job.text("voice"), speed=job.number("speed"), pitch=job.number("voice_pitch")
    )
    sound = scratch / "voice.wav"
    voiced.write(sound)
    return speech(partial(_said, voiced.utterance, job)), sound


def _said(utterance: Utterance, job: Job, fps: float) -> Saying:
    """What is said at a frame rate."""
    from .. import api

    felt = _profile(job) if job.text("emotion") or job.maybe("angle") is not None else None
    alive = _liveliness(job)
    return api.say(
        utterance,
        emotion=felt,
        fps=fps,
        articulation=job.number("articulation"),
        jaw=job.number("jaw"),
        lean=job.number("lean"),
        liveliness=alive if alive.any else None,
        seed=job.whole("seed"),
    )


def _look(job: Job) -> Look:
    """How it is pictured."""
    from ..scene.jobs.clip import Engine, Lighting, Look

    width, height = pixels(job.text("size"))
    return Look(
        engine=Engine(job.text("engine")),
        width=width,
        height=height,
        yaw=math.radians(job.number("yaw")),
        pitch=math.radians(job.number("pitch")),
        roll=math.radians(job.number("roll")),
        lens=job.number("lens"),
        distance=job.maybe("distance"),
        backdrop=linear_colour(job.text("background")),
        lighting=Lighting(
            job.number("light"), math.radians(job.number("light_yaw")), job.number("ambient"), stays=True
        ),
        samples=job.whole("samples") if job.text("engine") == "CYCLES" else None,
    )
