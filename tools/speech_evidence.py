"""Write the measured part of docs/speech.md: closures, timing, speed, and how much of feelings and visemes is left.

    .venv/bin/python tools/speech_evidence.py [--heads default ict makehuman]

Speech of other people is said on several heads at several tempos, and everything is read off the meshes. The shared
folder holds the heads and the samples.
"""

from __future__ import annotations

import argparse
import sys
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import risorius.api as api
from faithful.heads import load_face
from places import DOCS, shared_folder
from risorius.arrays import Floats

PAGE = DOCS / "speech.md"
START, END = "<!-- measured -->", "<!-- end of measured -->"
SAMPLES = ("bobby_phones", "mary", "damon_set_test")
TEMPOS = (0.5, 1.0, 2.0)
FPS = 25.0
#: Points of the upper lip's inner edge, and those of the lower lip that they meet.
LIPS = (("2.2", "2.3"), ("2.6", "2.8"), ("2.7", "2.9"))
#: Metres: lips no farther apart are closed; a lower lip no farther below the upper teeth's edge is at the teeth.
CLOSED = 2e-4
#: Columns of what tells visemes apart: FAPs of jaw and lips.
MOUTH = [number - 1 for number in (3, 4, 5, 6, 7, 8, 9, 10, 11, 16, 17)]
JAW, LOWER_LIP, UPPER_LIP, PUSHED = 2, 4, 3, 16


CLOSURES = """\
Three sentences with phones that other people timed (praatIO's samples), at 25 frames per second, read off the meshes.
A closure is reached where the lips are at most 0.2 mm apart, at their middle and beside it, in a frame of the sound;
the lower lip is at the teeth where its edge is at most 0.2 mm below that of the upper incisors. Late: the middle of the
time in which lips are closed against the middle of the sound, mean and farthest; a frame lasts 40 ms. Talkers' jaws
open and close at up to about 200 mm/s in distinct speech (Ostry and Munhall 1985).

| head | tempo | p b m closed | f v at the teeth | late, ms | farthest, ms | jaw, mm/s |
|---|---|---|---|---|---|---|"""
FEELINGS = """\
With feeling, at each emotion's own activation, on {head}: frames in which a rule recognises the emotion while
something is said; sounds whose mouth is nearest to the same viseme of the neutral speech, once what the emotion adds
all the while is taken away; closures.

| emotion | paper rule | robust rule | visemes kept | p b m closed |
|---|---|---|---|---|"""


@dataclass(frozen=True, eq=False)
class Shown:
    """Speech on a face: what was said, positions (T, V, 3), FAPs (T, 68) measured on them."""

    saying: api.Saying
    positions: Floats
    faps: Floats


def at_tempo(utterance: api.Utterance, tempo: float) -> api.Utterance:
    """The same, so many times as fast."""
    sounds = tuple(replace(sound, start=sound.start / tempo, end=sound.end / tempo) for sound in utterance.sounds)
    return replace(utterance, sounds=sounds, duration=utterance.duration / tempo, words=())


def shown(face: api.Face, utterance: api.Utterance, emotion: api.Profile | None = None) -> Shown:
    """Say it on a face."""
    saying = api.say(utterance, emotion=emotion, fps=FPS)
    moved = face.simulation(saying.stream.frames, FPS, emotions=saying.emotions, planned=True, integrator="balance")
    positions = np.array(list(moved))
    return Shown(saying, positions, np.array([face.measure(frame) for frame in positions]))


def place(face: api.Face, positions: Floats, name: str) -> Floats:
    """(T, 3) a feature point over time."""
    point = face.points[name]
    return np.asarray(np.einsum("tkc,k->tc", positions[:, point.vertices], np.asarray(point.weights)))


def gaps(face: api.Face, positions: Floats) -> Floats:
    """(T,) how far the lips are apart where they are farthest apart, metres."""
    apart = [(place(face, positions, upper) - place(face, positions, lower))[:, 2] for upper, lower in LIPS]
    return np.asarray(np.max(apart, axis=0))


def closures(face: api.Face, said: Shown) -> tuple[int, int, list[float]]:
    """How many bilabial closures were asked and reached, and how late in seconds each is closest to closed."""
    gap, asked, reached, late = gaps(face, said.positions), 0, 0, []
    times = np.arange(len(gap)) / FPS
    for sound in said.saying.utterance.sounds:
        if sound.phoneme.viseme != 1:
            continue
        near = np.flatnonzero(np.abs(times - sound.middle) <= max(0.5 * sound.duration, 0.5 / FPS) + 1e-9)
        asked, reached = asked + 1, reached + int(gap[near].min() <= CLOSED)
        around = np.flatnonzero(np.abs(times - sound.middle) <= 0.15)
        shut = around[gap[around] <= max(gap[around].min(), CLOSED)]
        late.append(float(times[shut].mean() - sound.middle))
    return asked, reached, late


def at_teeth(face: api.Face, said: Shown) -> tuple[int, int]:
    """How many sounds of lip and teeth were asked, and in how many the lower lip reaches the upper teeth's edge."""
    teeth = np.flatnonzero(face.parts == api.Part.TEETH_UPPER)
    if not len(teeth):
        return 0, 0
    asked = reached = 0
    lip, times = place(face, said.positions, "2.3"), np.arange(len(said.positions)) / FPS
    for sound in said.saying.utterance.sounds:
        if sound.phoneme.viseme != 2:
            continue
        near = np.flatnonzero(np.abs(times - sound.middle) <= max(0.5 * sound.duration, 0.5 / FPS) + 1e-9)
        front = teeth[np.abs(face.vertices[teeth, 0] - lip[0, 0]) < 0.012]
        edge = said.positions[:, front, 2].min(axis=1)
        asked, reached = asked + 1, reached + int((lip[near, 2] >= edge[near] - CLOSED).any())
    return asked, reached


def jaw_speed(face: api.Face, said: Shown) -> float:
    """The fastest jaw, metres per second."""
    unit = face.units.mns0 / 1024.0
    return float(np.abs(np.diff(said.faps[:, JAW])).max() * unit * FPS)


def recognised(said: Shown, word: str, rule: str) -> tuple[int, int]:
    """Frames while something is said, and those in which the emotion is the one recognised."""
    times = np.arange(len(said.faps)) / FPS
    sounds = said.saying.utterance.sounds
    spoken = said.faps[(times >= sounds[0].start) & (times <= sounds[-1].end)]
    right = [str(api.recognise(faps, rule=rule).best) == word for faps in spoken]
    return len(right), sum(right)


def visemes_left(plain: Shown, felt: Shown) -> tuple[int, int]:
    """Sounds, and those whose mouth in an emotion is nearest to the same viseme of the neutral speech."""
    times = [round(s.middle * FPS) for s in plain.saying.utterance.sounds if s.phoneme.own]
    kinds = np.array([s.phoneme.viseme for s in plain.saying.utterance.sounds if s.phoneme.own])
    neutral, with_feeling = plain.faps[times][:, MOUTH], felt.faps[times][:, MOUTH]
    shift = np.median(with_feeling - neutral, axis=0)  # what the emotion adds all the while
    nearest = [int(np.argmin(np.linalg.norm(neutral - row + shift, axis=1))) for row in with_feeling]
    return len(kinds), int((kinds[nearest] == kinds).sum())


def closure_rows(heads: list[str], utterances: list[api.Utterance]) -> list[str]:
    """A row for each head and tempo."""
    rows = []
    for head in heads:
        face = load_face(head)
        for tempo in TEMPOS:
            said = [shown(face, at_tempo(utterance, tempo)) for utterance in utterances]
            found = [closures(face, one) for one in said]
            asked, reached = sum(one[0] for one in found), sum(one[1] for one in found)
            late = np.array([seconds for one in found for seconds in one[2]]) * 1000.0
            teeth = [at_teeth(face, one) for one in said]
            bitten = f"{sum(one[1] for one in teeth)} of {sum(one[0] for one in teeth)}"
            speed = max(jaw_speed(face, one) for one in said) * 1000.0
            timing = f"{np.mean(late):+.0f} | {np.abs(late).max():.0f} | {speed:.0f}"
            rows.append(f"| {head} | {tempo:g} | {reached} of {asked} | {bitten} | {timing} |")
            print(rows[-1], flush=True)
    return rows


def feeling_rows(head: str, utterances: list[api.Utterance]) -> list[str]:
    """A row for each emotion."""
    face, rows = load_face(head), []
    plain = [shown(face, utterance) for utterance in utterances]
    for word in api.ARCHETYPES:
        felt = [shown(face, utterance, api.expression(word)) for utterance in utterances]
        cells = []
        for rule in ("paper", "robust"):
            counts = [recognised(one, word, rule) for one in felt]
            cells.append(f"{sum(c[1] for c in counts) / sum(c[0] for c in counts):.0%}".replace("%", " %"))
        kept = [visemes_left(one, other) for one, other in zip(plain, felt, strict=True)]
        shut = [closures(face, one) for one in felt]
        visemes = f"{sum(k[1] for k in kept)} of {sum(k[0] for k in kept)}"
        rows.append(
            f"| {word} | {cells[0]} | {cells[1]} | {visemes} | {sum(s[1] for s in shut)} of {sum(s[0] for s in shut)} |"
        )
        print(rows[-1], flush=True)
    return rows


def page(closure: list[str], feeling: list[str], head: str) -> str:
    """The measured part."""
    return "\n".join([CLOSURES, *closure, "", FEELINGS.format(head=head), *feeling])


def main(argv: list[str] | None = None) -> int:
    """Measure, and write the page."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--heads", nargs="+", default=["default", "ict", "makehuman"])
    arguments = parser.parse_args(argv)
    folder = shared_folder() / "samples" / "speech" / "textgrid"
    utterances = [api.read_timings(Path(folder) / f"{name}.TextGrid") for name in SAMPLES]
    first = arguments.heads[0]
    measured = page(closure_rows(arguments.heads, utterances), feeling_rows(first, utterances), first)
    text = PAGE.read_text(encoding="utf-8")
    before, after = text.split(START)[0], text.split(END)[1]
    PAGE.write_text(f"{before}{START}\n{measured}\n{END}{after}", encoding="utf-8")
    print(f"wrote {PAGE}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
