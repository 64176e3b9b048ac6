"""The file that a face comes from, and the meshes in it.

A .blend is opened, so that all that is in it stays: scenes, collections, frame rate, unit scale, animation. Anything
else is read into an empty file.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import bpy

from ...errors import FormatError
from .. import mesh as meshes
from ..blender_types import Object
from .files import empty_file, open_file

#: Frames per second where neither the user nor the input says so.
FPS = 25.0


@dataclass(frozen=True)
class Input:
    """Whose face a job is asked to take.

    Attributes
    ----------
    mesh : .npz, .obj, .blend, .glb or .gltf; None: the default head.
    points : JSON file of its feature points; None: those stored in a .blend, or found on the mesh.
    object_name : which object of the file bears the face; None: the one that looks most like a face.
    fps : frames per second; None: those of a .blend, else 25.
    """

    mesh: Path | None = None
    points: Path | None = None
    object_name: str | None = None
    fps: float | None = None

    @classmethod
    def of(
        cls,
        mesh: str | Path | None = None,
        points: str | Path | None = None,
        object_name: str | None = None,
        fps: float | None = None,
    ) -> Input:
        """From paths as text."""
        mesh, points = (None if path is None else Path(path) for path in (mesh, points))
        return cls(mesh, points, object_name, fps)

    @property
    def is_scene(self) -> bool:
        """Whether it is a .blend, whose scene is the user's."""
        return self.mesh is not None and self.mesh.suffix.lower() == ".blend"


def open_input(asked: Input) -> None:
    """Open a .blend, or an empty file for anything else.

    Raises
    ------
    FormatError, SceneError, ParameterError : a file that cannot be opened, a Blender with a window, a wrong rate.
    """
    if asked.mesh is not None and asked.is_scene:
        open_file(asked.mesh, asked.fps)
    else:
        empty_file(FPS if asked.fps is None else asked.fps)


def meshes_of(path: Path) -> list[Object]:
    """The meshes of an input that is open (a .blend) or that is read now into the open file: at least one.

    Raises
    ------
    FormatError : a file that cannot be read, or no mesh in it.
    """
    suffix = path.suffix.lower()
    if suffix in (".npz", ".obj"):
        return [_from_arrays(path)]
    if suffix == ".blend":
        found = [obj for obj in bpy.context.scene.objects if obj.type == "MESH"]
        found = found or [obj for obj in bpy.data.objects if obj.type == "MESH"]
    elif suffix in (".glb", ".gltf"):
        found = _from_gltf(path)
    else:
        raise FormatError(path, "is not a .npz, .obj, .blend, .glb or .gltf file: export the mesh as one of these")
    solid = [obj for obj in found if len(obj.data.polygons)]
    if not solid:
        raise FormatError(path, "contains no mesh with polygons: export the mesh of the face into it")
    return solid


def named_mesh(path: Path, found: list[Object], name: str) -> Object:
    """The mesh of that name among those found, or anywhere in a .blend.

    Raises
    ------
    FormatError : there is none; names those that are there.
    """
    everywhere = [obj for obj in bpy.data.objects if obj.type == "MESH" and len(obj.data.polygons)]
    candidates = everywhere if path.suffix.lower() == ".blend" else found
    for obj in candidates:
        if obj.name == name:
            return obj
    names = ", ".join(sorted(obj.name for obj in candidates))
    raise FormatError(path, f"has no mesh named {name}: name one of {names}")


def _from_arrays(path: Path) -> Object:
    """A mesh that is read without Blender, vertex for vertex."""
    from ...face.mesh.files import read_mesh

    stored = read_mesh(path)
    obj: Object = bpy.data.objects.new(
        path.stem, meshes.new_mesh(path.stem, stored.vertices, *meshes.flatten_polygons(stored.polygons))
    )
    bpy.context.collection.objects.link(obj)
    return obj


def _from_gltf(path: Path) -> list[Object]:
    """The meshes of a glTF file."""
    if not os.path.isfile(path):
        raise FormatError(path, "does not exist: check the path")
    before = set(bpy.data.objects)
    try:
        bpy.ops.import_scene.gltf(filepath=str(path))
    except (RuntimeError, AttributeError) as problem:
        told = [line for line in str(problem).splitlines() if line.strip()] or ["Blender does not say why"]
        reason = told[-1].strip().removeprefix("Error: ")
        raise FormatError(path, f"cannot be imported ({reason}): export it again") from problem
    return [obj for obj in bpy.data.objects if obj not in before and obj.type == "MESH"]
