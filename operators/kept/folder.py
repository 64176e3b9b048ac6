"""Where prepared faces are kept: in the folder that Blender gives an extension for files of its own."""

from __future__ import annotations

from contextlib import ExitStack, suppress
from pathlib import Path

import bpy

from ...scene import faces

#: The name by which Blender knows Risorius, as an extension or an add-on.
PACKAGE = __name__.removesuffix(".operators.kept.folder")
#: The folder's name.
NAME = "faces"


def kept_folder() -> Path:
    """Where faces are kept, whether there are any or not."""
    with suppress(ValueError, AttributeError, OSError):  # no extension, an older Blender, a place that is forbidden
        return Path(bpy.utils.extension_path_user(PACKAGE, path=NAME, create=False))
    return Path(bpy.utils.user_resource("DATAFILES", path="risorius")) / NAME


def folder_to_use() -> Path | None:
    """Where faces are to be kept; None where the user does not want that, or Risorius is not enabled as an add-on."""
    addon = bpy.context.preferences.addons.get(PACKAGE)
    wanted = addon is not None and addon.preferences is not None and addon.preferences.keep_faces
    return kept_folder() if wanted else None


def attach(undo: ExitStack) -> None:
    """Keep faces where the user wants that, until undone."""
    faces.keep_where(folder_to_use)
    undo.callback(faces.keep_where, faces.nowhere)
