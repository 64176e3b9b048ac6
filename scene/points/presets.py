"""Topologies that a user has saved: feature points for every mesh with the same polygons, in any file.

They are tables (`face.fit.topologies`) in the extension's own user folder, which outlives updates of the extension.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ...errors import FormatError, SceneError
from ...files import safe_stem
from .. import mesh as meshes
from ..blender_types import Object
from .bound import followed
from .kept import read_kept

if TYPE_CHECKING:
    from ...face.fit.topologies import Topology, TopologyPoint

FOLDER = "topologies"
#: The package, as Blender names the extension.
PACKAGE = __package__.rpartition(".")[0]


def preset_folder(*, create: bool = False) -> Path:
    """Where users' topologies are; outside an extension, in the user's data files.

    Raises
    ------
    SceneError : it cannot be created.
    """
    try:
        return Path(bpy.utils.extension_path_user(PACKAGE, path=FOLDER, create=create))
    except ValueError:
        return Path(bpy.utils.user_resource("DATAFILES", path=f"risorius/{FOLDER}", create=create))
    except OSError as problem:
        raise SceneError(
            "Topology", f"its folder cannot be created ({problem}): free disk space or allow writing"
        ) from problem


def preset_paths() -> list[Path]:
    """The files of users' topologies, by name."""
    return sorted(preset_folder().glob("*.toml"))


def known_topologies() -> tuple[tuple[Topology, ...], tuple[str, ...]]:
    """All topologies, the user's own before those of Risorius; and what is wrong with those that cannot be read."""
    from ...face.fit.topologies import load_topologies, read_topology

    own, wrong = [], []
    for path in preset_paths():
        try:
            own.append(read_topology(path))
        except FormatError as problem:
            wrong.append(str(problem))
    return (*own, *load_topologies()), tuple(wrong)


def preset_names() -> dict[str, str]:
    """What users' topologies are called, by their files' names without ending. Cheap enough to ask at every redraw."""
    return {path.stem: _name_of(path, path.stat().st_mtime_ns) for path in preset_paths()}


def shipped_names() -> list[str]:
    """What the topologies of Risorius are called."""
    from ...face.fit.topologies import load_topologies

    return [topology.name for topology in load_topologies()]


@lru_cache(maxsize=64)
def _name_of(path: Path, changed: int) -> str:
    """What a topology is called; read again only when its file has changed."""
    from ...face.fit.topologies import read_topology

    try:
        return read_topology(path).name
    except FormatError:
        return f"{path.stem} (cannot be read)"


def save_preset(obj: Object, name: str) -> Path:
    """Save the points of `obj` for every mesh with its polygons; a topology of that name is replaced.

    Raises
    ------
    SceneError : no name; no points that move with the mesh. FormatError : the file cannot be written.
    """
    from ...face.fit.topologies import topology_of, write_topology

    stem = re.sub(r"[^\w-]+", "_", name.strip().casefold()).strip("_")
    if not stem:
        raise SceneError("Topology", "needs a name with letters or digits")
    kept = followed(read_kept(obj), obj.data).kept
    points = {n: _on_vertices(p.vertices, p.weights) for n, p in kept.points.items() if p.is_bound}
    if not points:
        raise SceneError(obj.name, "has no points on its surface: find or click them first")
    polygons = meshes.polygon_sequence(*meshes.polygon_arrays(obj.data))
    topology = topology_of(name.strip(), "saved in Blender", len(obj.data.vertices), polygons, points)
    path = preset_folder(create=True) / f"{safe_stem(stem, 'mine')}.toml"
    write_topology(path, topology)
    return path


def remove_preset(stem: str) -> None:
    """Remove a user's topology by its file's name without ending.

    Raises
    ------
    SceneError : there is none, or it cannot be removed.
    """
    if stem not in {path.stem for path in preset_paths()}:
        raise SceneError("Topology", f"{stem} no longer exists: nothing to remove")
    try:
        (preset_folder() / f"{stem}.toml").unlink()
    except OSError as problem:
        raise SceneError("Topology", f"{stem} cannot be removed ({problem}): allow writing") from problem


def _on_vertices(vertices: Sequence[int], weights: Sequence[float]) -> TopologyPoint:
    """A point as a mean of vertices."""
    from ...face.fit.topologies import TopologyPoint

    shares = np.array(weights, dtype=np.float64)
    return TopologyPoint(np.array(vertices, dtype=np.int64), shares / shares.sum())
