"""Everything that Blender registers: a folder per feature, each with ops.py, panel.py and props.py."""

from __future__ import annotations

from importlib import import_module
from typing import Any

#: Modules with classes to register, in this order: what others refer to comes first.
_PROPERTIES = (
    "face.props",
    "emotion.props",
    "muscles.props",
    "tissue.props",
    "timeline.props",
    "bake.props",
    "film.props",
    "shapes.props",
    "read.props",
    "points.props",
    "parts.props",
    "wheel.props",
    "preview.props",
    "show.props",
    "props",
)
_OPERATORS = (
    "face.ops",
    "points.ops",
    "points.question",
    "points.look",
    "points.click",
    "points.drag",
    "points.hover",
    "points.joined",
    "points.topologies",
    "parts.ops",
    "emotion.ops",
    "wheel.ops",
    "wheel.pick",
    "muscles.ops",
    "tissue.ops",
    "timeline.ops",
    "timeline.drag",
    "bake.ops",
    "face.six",
    "library.ops",
    "film.ops",
    "shapes.ops",
    "read.ops",
)
#: In the order of work, which is that of the sidebar.
_PANELS = (
    "face.panel",
    "parts.panel",
    "points.panel",
    "points.topologies_panel",
    "emotion.panel",
    "wheel.panel",
    "wheel.gizmo",
    "muscles.panel",
    "tissue.panel",
    "timeline.panel",
    "library.panel",
    "bake.panel",
    "read.panel",
    "film.panel",
)
#: Modules that draw or listen from registration on: attached in this order, detached in the opposite one.
_ATTACHED = (
    "translations",
    "points.overlay",
    "points.drag",
    "parts.overlay",
    "wheel.gizmo",
    "wheel.pick",
    "timeline.linked",
    "timeline.colours",
    "timeline.drawing",
    "timeline.drag",
    "preview.live",
    "show.overlay",
    "read.live",
)

_command: Any = None


def _modules(names: tuple[str, ...]) -> list[Any]:
    """Modules of this package."""
    return [import_module(f".{name}", __package__) for name in names]


def _classes() -> list[type]:
    """All classes, in the order of registration."""
    return [cls for module in _modules((*_PROPERTIES, *_OPERATORS, *_PANELS)) for cls in module.CLASSES]


def register() -> None:
    """Register classes, properties and the command line; all of it or, on an error, nothing."""
    global _command
    import bpy

    from . import props

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
    for attached in _modules(_ATTACHED):
        attached.attach()
    if hasattr(bpy.utils, "register_cli_command"):
        _command = bpy.utils.register_cli_command("risorius", _run_command)


def unregister() -> None:
    """Take everything back, in the opposite order."""
    global _command
    import bpy

    from ..scene.faces import forget_faces
    from . import props

    if _command is not None:
        bpy.utils.unregister_cli_command(_command)
        _command = None
    for attached in reversed(_modules(_ATTACHED)):
        attached.detach()
    props.detach()
    for cls in reversed(_classes()):
        bpy.utils.unregister_class(cls)
    forget_faces()


def _run_command(arguments: list[str]) -> int:
    """``blender --command risorius ...``"""
    from .. import cli

    return int(cli.main(list(arguments)))
