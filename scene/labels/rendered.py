"""A scene as renders show it: what has one setting for the viewport and another for renders is set to the latter."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from ..blender_types import Collection, Object, Scene

#: Modifiers that have a level of their own for renders.
LEVELS = {"SUBSURF": ("levels", "render_levels"), "MULTIRES": ("levels", "render_levels")}


@contextmanager
def as_rendered(scene: Scene) -> Iterator[None]:
    """Show a scene's objects, collections and modifiers as its renders do; afterwards all is set as it was."""
    changed: list[tuple[object, str, object]] = []

    def put(owner: object, name: str, wanted: object) -> None:
        if getattr(owner, name) != wanted:
            changed.append((owner, name, getattr(owner, name)))
            setattr(owner, name, wanted)

    try:
        for collection in _all_below(scene.collection):
            put(collection, "hide_viewport", collection.hide_render)
        for obj in scene.objects:
            put(obj, "hide_viewport", obj.hide_render)
            put(obj, "show_instancer_for_viewport", obj.show_instancer_for_render)
            for modifier in obj.modifiers:
                put(modifier, "show_viewport", modifier.show_render)
                if modifier.type in LEVELS:
                    shown, rendered = LEVELS[modifier.type]
                    put(modifier, shown, getattr(modifier, rendered))
        if changed:
            scene.view_layers[0].update()
        yield
    finally:
        for owner, name, value in reversed(changed):
            setattr(owner, name, value)
        if changed:
            scene.view_layers[0].update()


@contextmanager
def undivided(scene: Scene, objects: Sequence[Object]) -> Iterator[bool]:
    """Show objects without the modifiers that smooth them as they divide them; whether there are any."""
    off = [each for obj in objects for each in obj.modifiers if each.type in LEVELS and each.show_viewport]
    try:
        for modifier in off:
            modifier.show_viewport = False
        if off:
            scene.view_layers[0].update()
        yield bool(off)
    finally:
        for modifier in off:
            modifier.show_viewport = True


def _all_below(collection: Collection) -> Iterator[Collection]:
    """Every collection below another."""
    for child in collection.children:
        yield child
        yield from _all_below(child)
