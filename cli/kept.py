"""Prepared faces of the command line: out of the user's cache folder, and kept there for the next time.

RISORIUS_CACHE names another folder, or is "off". A Blender in which the extension is enabled has a folder and a setting
of its own, which count there.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ..api import Face

VARIABLE, OFF = "RISORIUS_CACHE", "off"

#: Permissions by which others could put files into a folder.
BY_OTHERS = 0o022


def kept_folder() -> Path | None:
    """Where prepared faces are kept; None where that is turned off, there is no such place, or
    others can write there."""
    told = os.environ.get(VARIABLE, "")
    if told.lower() == OFF:
        return None
    try:
        folder = Path(told).expanduser() if told else _cache() / "risorius" / "faces"
    except RuntimeError:  # nobody of that name, or no home
        return None
    with suppress(OSError):
        if os.name == "posix" and folder.exists():
            state = folder.stat()
            return folder if state.st_uid == os.getuid() and not state.st_mode & BY_OTHERS else None
    return folder


def _cache() -> Path:
    """The folder that this system has for what can be worked out again."""
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Caches"
    if os.name == "nt":
        return Path(os.environ.get("LOCALAPPDATA") or Path.home() / "AppData" / "Local")
    told = Path(os.environ.get("XDG_CACHE_HOME", ""))
    return told if told.is_absolute() else Path.home() / ".cache"


@contextmanager
def kept_face(*given: Any) -> Iterator[Face]:
    """A face of the arguments of `Face.from_arrays`, of the default head without any; kept at the end if it was posed.

    Raises
    ------
    ModelError : as `Face.from_arrays`.
    """
    from .. import api

    folder = kept_folder()
    if folder is None:
        yield api.Face.from_arrays(*given) if given else api.default_face()
        return
    if not given:
        head = api.build_default_head()
        given = (head.vertices, head.polygons, head.points, head.parts)
    faces = api.KeptFaces(folder)
    face = faces.face(*given)
    yield face
    faces.keep_posed(face)
    _tell(faces.entries.trouble)


@contextmanager
def kept_by_jobs() -> Iterator[None]:
    """Around a job in Blender: its faces come out of the folder, and those that it posed are kept there at its end."""
    from ..scene.jobs.kept import kept_in

    with kept_in(kept_folder) as troubles:
        yield
    for trouble in troubles:
        _tell(trouble)


def _tell(trouble: str) -> None:
    """Say why a face could not be kept; nothing depends on that."""
    if trouble:
        print(f"risorius: the prepared face was not kept: {trouble}", file=sys.stderr)
