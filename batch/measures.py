"""How long jobs take: by figures at first, by what was measured in a set as soon as there is something."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field

from .jobs import Job
from .making import FPS
from .values import pixels

#: Seconds on one core of a desktop computer without a graphics card, as docs/batch.md tells them: Blender's start, the
#: preparation of a head, a pose, a motion, a second of it, a picture, and what 512 x 512 pixels of it take more.
START, HEAD, POSE, MOTION, MOVED = 1.2, 3.0, 1.9, 2.0, 1.0
PICTURE, DRAWN = 0.23, {"WORKBENCH": 0.06, "EEVEE": 60.0, "CYCLES": 5.0}
#: A still is drawn finer; pixels of the picture that is measured.
FINE, MEASURED = 3.0, 512 * 512
#: Seconds of a stream of FAPs whose length nobody has looked at; of speech, what comes before and after it.
STREAM, AROUND = 10.0, 1.0
#: Rays per pixel for which Cycles is measured.
SAMPLES = 16


def seconds_shown(job: Job) -> float:
    """How long the motion of a job is, seconds; of streams and speech a guess."""
    if "fap" in job.inputs:
        return STREAM
    if job.text("text"):
        return AROUND + 60.0 * len(job.text("text").split()) / job.number("speed")
    from .. import api

    timing = api.load_timings()[job.text("timing")]
    parts = (job.maybe(name) for name in ("onset", "apex", "offset"))
    usual = (timing.onset, timing.apex, timing.offset)
    lasting = sum(own if given is None else given for given, own in zip(parts, usual, strict=True))
    return job.number("before") + lasting + job.number("after")


def guessed(job: Job) -> float:
    """Seconds that a job takes once its head is prepared, by figures."""
    width, height = pixels(job.text("size"))
    drawn = DRAWN[job.text("engine")] * width * height / MEASURED
    if job.text("engine") == "CYCLES":
        drawn *= (job.whole("samples") or SAMPLES) / SAMPLES
    seconds = seconds_shown(job)
    frames = seconds * (job.maybe("fps") or FPS)
    total = MOTION + MOVED * seconds if {"film", "blend", "glb"} & set(job.outputs) else POSE
    if "film" in job.outputs:
        total += frames * (PICTURE + drawn)
    if "still" in job.outputs:
        total += PICTURE + FINE * drawn
    return total


@dataclass
class Pace:
    """How fast jobs really are in so many processes, as a multiple of what is guessed."""

    processes: int = 1
    guessed: float = 0.0
    taken: float = 0.0
    seen: Counter[str] = field(default_factory=Counter)

    def note(self, job: Job, seconds: float) -> None:
        """A job is done; the first ones of each head, one in each process, prepared it, too."""
        head = job.text("head")
        self.seen[head] += 1
        self.guessed += guessed(job) + (HEAD if self.seen[head] <= self.processes else 0.0)
        self.taken += seconds

    @property
    def ratio(self) -> float:
        """Seconds that pass for one that is guessed."""
        return self.taken / self.guessed if self.guessed > 0.0 else 1.0

    def left(self, jobs: Iterable[Job]) -> float:
        """Seconds until all of these are done."""
        return self.ratio * sum(guessed(job) for job in jobs) / self.processes


def for_people(seconds: float) -> str:
    """A time in words."""
    if seconds < 90.0:
        return f"{seconds:.0f} s"
    minutes = seconds / 60.0
    if minutes < 90.0:
        return f"{minutes:.0f} min"
    hours = minutes / 60.0
    return f"{hours:.1f} h" if hours < 48.0 else f"{hours / 24.0:.1f} days"
