"""Playback of clips that are not baked: what a frame costs while the timeline plays, with the skin's inertia.

Four overlapping emotions lie on the timeline; nothing is baked. Two plays: the first while the motion is still being
worked out between the frames, the second once it is known. A frame is everything from the scene's new frame to the
mesh that Blender draws; the steps between frames hold the next frame up where they are long. Processor time.
Needs a Python that has bpy.
"""

from __future__ import annotations

import argparse
import time
from typing import Any

import bpy
import numpy as np
import risorius
from places import shared_folder
from risorius.operators.preview import live
from risorius.progress import run
from risorius.scene.bake.target import Target
from risorius.scene.jobs.inputs import Input
from risorius.scene.jobs.subjects import subject
from risorius.scene.live.live_face import LiveFace

WORDS = ("joy", "anger", "surprise", "sadness")
#: Frames per second, and from where to where the timeline plays.
FPS, FRAMES = 25, range(1, 151)
#: Seconds of each frame that are spent on the motion.
BETWEEN = live.BETWEEN_FRAMES


def lay_out(head: Any) -> None:
    """Four clips that overlap, and nothing baked."""
    scene = bpy.context.scene
    scene.render.fps = FPS
    for number, word in enumerate(WORDS):
        head.risorius.emotion.word = word
        scene.frame_set(FRAMES[0] + 30 * number)
        bpy.ops.risorius.add_clip()


def shown(head: Any, face: LiveFace, number: int) -> float:
    """Processor seconds of a frame of the timeline."""
    begin = time.process_time()
    bpy.context.scene.frame_set(number)
    live.play_or_rest(head, face, bpy.context.scene)
    bpy.context.view_layer.update()
    return time.process_time() - begin


def worked(face: LiveFace) -> list[float]:
    """Processor seconds of the steps between two frames."""
    steps = list[float]()
    while face.has_more and sum(steps) < BETWEEN:
        begin = time.process_time()
        face.go_on()
        steps.append(time.process_time() - begin)
    return steps


def told(title: str, seconds: list[float]) -> str:
    """A line of figures."""
    each = 1e3 * np.array(seconds or [0.0])
    return (
        f"  {title:<26}{np.median(each):7.1f} ms median, {np.percentile(each, 95):7.1f} at 95 %, {each.max():7.1f} most"
    )


def measure(name: str, asked: Input) -> None:
    """Print the times of one head."""
    target: Target = run(subject(asked)).target
    head = target.obj
    bpy.context.view_layer.objects.active = head
    lay_out(head)
    face = LiveFace(target)
    run(face.prepare())
    first, steps = list[float](), list[float]()
    for number in FRAMES:
        first.append(shown(head, face, number))
        steps += worked(face)
    while face.has_more:
        begin = time.process_time()
        face.go_on()
        steps.append(time.process_time() - begin)
    again = [shown(head, face, number) for number in FRAMES]
    print(
        f"{name}: {len(head.data.vertices)} vertices, {len(FRAMES)} frames, {1e3 / FPS:.0f} ms each at {FPS} per second"
    )
    print(told("a frame, first play", first))
    print(told("a step between frames", steps))
    print(told("a frame, second play", again), flush=True)


def main(argv: list[str]) -> None:
    """Measure."""
    parser = argparse.ArgumentParser(prog="bench_speed.py playback", description=__doc__)
    parser.parse_args(argv)
    risorius.register()
    shared = shared_folder() / "heads"
    measure("default head", Input(None, None))
    if (shared / "ict.npz").is_file():
        measure("ict", Input(shared / "ict.npz", shared / "ict.fp.json"))
    risorius.unregister()
