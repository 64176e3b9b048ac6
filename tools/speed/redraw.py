"""Speed of what the sidebar asks at each redraw, in a file with many objects beside one with few.

Every panel that shows is drawn into a layout that asks each button whether it can work, as Blender does. So a redraw
is polls, reasons for grey buttons and what panels look up. Processor time, medians. The last figure of a line says how
many times longer a redraw takes in the file with many objects.
Needs a Python that has bpy.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import bpy
import numpy as np
import risorius
from risorius.operators.classes import CLASSES
from risorius.operators.sidebar import Sidebar
from risorius.scene.head import add_default_head
from risorius.scene.points.kept import forget_points

FEW = 10


class Layout:
    """Takes everything that a panel draws, and asks operators as Blender does."""

    def __init__(self, polled: list[str]) -> None:
        self.polled = polled

    def operator(self, name: str, **options: Any) -> Any:
        """A button."""
        self.polled.append(name)
        room, _, verb = name.partition(".")
        getattr(getattr(bpy.ops, room), verb).poll()
        return SimpleNamespace()

    def _nested(self, **options: Any) -> Layout:
        """A row, a column, a box."""
        return self

    row = column = box = split = _nested

    def _drawn(self, *what: Any, **options: Any) -> None:
        """A label, a property, a list: nothing is asked."""

    label = prop = prop_search = template_list = progress = menu = popover = _drawn


def redraw() -> list[str]:
    """Draw all panels that show; returns the operators that were asked."""
    context, polled = bpy.context, list[str]()
    for cls in CLASSES:
        if issubclass(cls, Sidebar) and getattr(cls, "poll", lambda _: True)(context):
            panel = SimpleNamespace(layout=Layout(polled))
            for name in vars(cls):
                if name.startswith("_draw_"):
                    setattr(panel, name, getattr(cls, name).__get__(panel))
            cls.draw(panel, context)  # type: ignore[attr-defined]
    return polled


def median(action: Callable[[], object], times: int) -> float:
    """Milliseconds of processor time that it takes."""
    took = []
    for _ in range(times):
        begin = time.process_time()
        action()
        took.append((time.process_time() - begin) * 1e3)
    return float(np.median(took))


def fill(count: int) -> Any:
    """A file with so many objects with meshes of their own, and a head, which is active; returns that."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    for number in range(count):
        mesh = bpy.data.meshes.new(f"Mesh {number}")
        bpy.context.collection.objects.link(bpy.data.objects.new(f"Object {number}", mesh))
    head = add_default_head()
    bpy.context.view_layer.update()
    return head


def share(head: Any) -> None:
    """Let another object have its mesh, too."""
    bpy.context.collection.objects.link(bpy.data.objects.new("Twin", head.data))


#: What the active object is -> how a head becomes that.
CASES: dict[str, Callable[[Any], None]] = {
    "a face": lambda head: None,
    "a face with a shared mesh": share,
    "a mesh without points": forget_points,
}


def main(argv: list[str] | None = None) -> None:
    """Measure."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--objects", type=int, default=5000, help="in the file with many")
    parser.add_argument("--redraws", type=int, default=20, help="of which the median is taken")
    arguments = parser.parse_args(argv)
    risorius.register()
    print(f"Blender {bpy.app.version_string}: a redraw of the sidebar")
    for name, make in CASES.items():
        took = []
        for count in (FEW, arguments.objects):
            make(fill(count))
            polls = len(redraw())
            took.append(median(redraw, arguments.redraws))
        print(f"  {name:<26}{polls} buttons   {took[0]:.2f} ms with {FEW} objects,", end=" ")
        print(f"{took[1]:.2f} ms with {arguments.objects}: {took[1] / took[0]:.1f} times", flush=True)
    risorius.unregister()
