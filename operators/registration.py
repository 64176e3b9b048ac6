"""All that Blender is given, step by step; each step leaves on a stack how it is taken back.

Blender keeps classes, properties, handlers, keys and menu entries until each is taken out again. So whoever puts
something in says at once how it is taken out, and `unregister` is that stack, unwound. A registration that fails on
the way unwinds it, too, and leaves Blender as it was.
"""

from __future__ import annotations

import atexit
from contextlib import ExitStack

import bpy

from ..scene.faces import forget_faces
from . import held, left_over, props, saved_by, translations
from .classes import CLASSES
from .followers import loaded as followers_loaded
from .kept import folder as kept_folder
from .parts import overlay as parts_overlay
from .points import drag as points_drag
from .points import hover as points_hover
from .points import overlay as points_overlay
from .preview import events as preview_events
from .read import live as read_live
from .show import overlay as show_overlay
from .timeline import colours as timeline_colours
from .timeline import drag as timeline_drag
from .timeline import drawing as timeline_drawing
from .timeline import linked as timeline_linked
from .wheel import gizmo as wheel_gizmo
from .wheel import pick as wheel_pick

#: Who draws, listens or adds to Blender's own menus and tools from registration on.
ATTACHED = (
    props.attach,
    translations.attach,
    saved_by.attach,
    left_over.attach,
    kept_folder.attach,
    followers_loaded.attach,
    points_overlay.attach,
    points_drag.attach,
    points_hover.attach,
    parts_overlay.attach,
    wheel_gizmo.attach,
    wheel_pick.attach,
    timeline_linked.attach,
    timeline_colours.attach,
    timeline_drawing.attach,
    timeline_drag.attach,
    preview_events.attach,
    show_overlay.attach,
    read_live.attach,
    held.attach,
)

#: How all of it is taken back; empty while nothing is registered.
_registered = ExitStack()


def register() -> None:
    """Give Blender everything. On an error all that it has been given by then is taken back, and the error goes on."""
    global _registered
    with ExitStack() as undo:
        undo.callback(forget_faces)
        for cls in CLASSES:
            bpy.utils.register_class(cls)
            undo.callback(bpy.utils.unregister_class, cls)
        for attach in ATTACHED:
            attach(undo)
        command = bpy.utils.register_cli_command("risorius", run_command)
        undo.callback(bpy.utils.unregister_cli_command, command)
        if not bpy.app.binary_path:  # Blender as a module
            # Python, ending, would take Blender apart under what is registered, and crash or hang. The program Blender
            # has taken its classes back by itself by then.
            atexit.register(unregister)
            undo.callback(atexit.unregister, unregister)
        _registered = undo.pop_all()


def unregister() -> None:
    """Take everything back, the last first."""
    _registered.close()


def run_command(arguments: list[str]) -> int:
    """``blender --command risorius ...``"""
    from .. import cli

    return int(cli.main(list(arguments)))
