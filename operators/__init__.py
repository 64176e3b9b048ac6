"""Everything that Blender registers: a folder per feature, each with ops.py, panel.py and props.py."""

from __future__ import annotations

from typing import Any

_command: Any = None


def _classes() -> list[type]:
    """All classes, in the order of registration: what others refer to comes first."""
    from . import props
    from .bake import ops as bake_ops
    from .bake import panel as bake_panel
    from .bake import props as bake_props
    from .emotion import ops as emotion_ops
    from .emotion import panel as emotion_panel
    from .emotion import props as emotion_props
    from .face import ops as face_ops
    from .face import panel as face_panel
    from .face import props as face_props
    from .face import six
    from .film import ops as film_ops
    from .film import panel as film_panel
    from .film import props as film_props
    from .parts import ops as parts_ops
    from .parts import panel as parts_panel
    from .parts import props as parts_props
    from .points import click, drag, hover, joined, look, question, topologies, topologies_panel
    from .points import ops as points_ops
    from .points import panel as points_panel
    from .points import props as points_props

    modules = (
        *(face_props, emotion_props, bake_props, film_props, points_props, parts_props, props),
        *(face_ops, points_ops, question, look, click, drag, hover, joined, topologies),
        *(parts_ops, emotion_ops, bake_ops, six, film_ops),
        *(face_panel, parts_panel, points_panel, topologies_panel, emotion_panel, bake_panel, film_panel),
    )
    return [cls for module in modules for cls in module.CLASSES]


def register() -> None:
    """Register classes, properties and the command line; all of it or, on an error, nothing."""
    global _command
    import bpy

    from . import props
    from .parts import overlay as parts_overlay
    from .points import drag, overlay

    done: list[type] = []
    try:
        for cls in _classes():
            bpy.utils.register_class(cls)
            done.append(cls)
    except Exception:
        for cls in reversed(done):
            bpy.utils.unregister_class(cls)
        raise
    props.attach()
    for attached in (overlay, drag, parts_overlay):
        attached.attach()
    if hasattr(bpy.utils, "register_cli_command"):
        _command = bpy.utils.register_cli_command("risorius", _run_command)


def unregister() -> None:
    """Take everything back, in the opposite order."""
    global _command
    import bpy

    from ..scene.faces import forget_faces
    from . import props
    from .parts import overlay as parts_overlay
    from .points import drag, overlay

    if _command is not None:
        bpy.utils.unregister_cli_command(_command)
        _command = None
    for attached in (parts_overlay, drag, overlay):
        attached.detach()
    props.detach()
    for cls in reversed(_classes()):
        bpy.utils.unregister_class(cls)
    forget_faces()


def _run_command(arguments: list[str]) -> int:
    """``blender --command risorius ...``"""
    from .. import cli

    return int(cli.main(list(arguments)))
