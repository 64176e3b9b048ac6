"""Modifiers of ours among those of the user's, whose active one stays active."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from .blender_types import Modifier, NodeTree, Object


def add_first(obj: Object, name: str, tree: NodeTree) -> Modifier:
    """A new modifier of nodes, before all others."""
    with _active_kept(obj):
        modifier = obj.modifiers.new(name, "NODES")
        modifier.node_group = tree
        obj.modifiers.move(len(obj.modifiers) - 1, 0)
    return modifier


def take_away(obj: Object, modifier: Modifier) -> None:
    """Remove a modifier of ours."""
    with _active_kept(obj):
        obj.modifiers.remove(modifier)


@contextmanager
def _active_kept(obj: Object) -> Iterator[None]:
    """Make the modifier active again that was, by its name: adding and removing moves them about."""
    active = obj.modifiers.active
    name = "" if active is None else active.name
    yield
    if name in obj.modifiers:
        obj.modifiers.active = obj.modifiers[name]
