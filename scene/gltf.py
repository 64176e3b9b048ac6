"""A face with its clips as glTF: each clip an animation with its own name, over all shape keys, on whole frames from 0.

What is exported is a copy (`laid_out`): the user's objects, actions and NLA tracks stay as they are.
"""

from __future__ import annotations

import json
import shutil
from collections.abc import Collection, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TypedDict

import bpy

from ..errors import SceneError
from ..files import scratch_folder
from .bake import shape_keys
from .blender_types import Object, Scene
from .laid_out import all_clips, laid_out, silent_clips
from .pictures.film import refuse_unwritable_output


@dataclass(frozen=True)
class Size:
    """How large a written file is.

    Attributes
    ----------
    bytes : of the file, with what is beside it.
    full : bytes that it would have if every morph target named every vertex: those that stay are left out.
    """

    bytes: int
    full: int

    @property
    def line(self) -> str:
        """For people."""
        saved = f"; {self.full / 1e6:.1f} MB with every vertex of every shape key" if self.full > self.bytes else ""
        return f"{self.bytes / 1e6:.1f} MB{saved}"


@dataclass(frozen=True)
class Exported:
    """A glTF file, the names of the clips in it, how large it is, and what the user should know."""

    path: Path
    clips: tuple[str, ...]
    size: Size
    remarks: tuple[str, ...] = ()


def export_gltf(objects: Sequence[Object], path: str | Path, *, morph_normals: bool = False) -> Exported:
    """Write the objects of a face, the head first, with every clip that is baked on it.

    Parameters
    ----------
    path : the .glb (one file) or .gltf (with .bin and pictures beside it) to write.
    morph_normals : whether morph targets move the normals, too: folds are shaded right, and the file is larger.

    Raises
    ------
    SceneError : nothing is baked, the file cannot be written, this Blender has no glTF exporter, or its exporter left
        out the face or a clip. A file that was there is kept then.
    """
    path = Path(path)
    head = objects[0]
    clips = all_clips(objects)
    if not clips:
        raise SceneError(head.name, "has no baked expressions to export: bake one first")
    own = set(shape_keys.own_names_of(head.data.shape_keys)) | {name for clip in clips.values() for name in clip.keys}
    blocks = () if head.data.shape_keys is None else head.data.shape_keys.key_blocks
    with laid_out(objects, clips) as scene, _shown(scene) as view, bpy.context.temp_override(**view):
        size = write_gltf(
            path,
            {block.name for block in blocks if block.name in own and not block.mute},
            clips,
            use_active_scene=True,
            use_renderable=True,
            export_animation_mode="NLA_TRACKS",
            export_anim_slide_to_zero=True,
            export_morph_normal=morph_normals,
        )
    silent = ", ".join(silent_clips(head))
    return Exported(
        path, tuple(clips), size, (f"nothing plays these clips, so they are not in the file: {silent}",) * bool(silent)
    )


def write_gltf(path: Path, targets: Collection[str], clips: Collection[str] = (), **options: object) -> Size:
    """Let Blender export the scene, and put what it wrote in place of what was there once all is in it.

    A morph target lists the vertices that it moves wherever that is smaller. One that moves none lists one of them all
    the same: not all engines read a list of nothing.

    Parameters
    ----------
    path : the .glb or .gltf to write.
    targets, clips : names of the morph targets and of the animations that must be in it.
    options : of Blender's exporter.

    Raises
    ------
    SceneError : it cannot be written, this Blender has no glTF exporter, or its exporter left something out.
    """
    if not hasattr(bpy.ops.export_scene, "gltf"):
        raise SceneError("glTF", "this Blender's glTF exporter is off: enable the add-on glTF 2.0 format")
    refuse_unwritable_output(path)
    kind = "GLB" if path.suffix.lower() == ".glb" else "GLTF_SEPARATE"
    with scratch_folder() as folder:
        made = folder / path.name
        try:
            bpy.ops.export_scene.gltf(
                filepath=str(made),
                export_format=kind,
                export_try_sparse_sk=True,
                export_try_omit_sparse_sk=False,
                **options,
            )
        except RuntimeError as problem:
            raise SceneError(str(path), f"could not be exported ({str(problem).strip()[-200:]})") from problem
        document = _document(made)
        _refuse_incomplete(document, path, targets, clips)
        files = [file for file in sorted(made.parent.rglob("*")) if file.is_file()]
        for file in files:
            place = path.parent / file.relative_to(made.parent)
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(file, place)
        written = sum(file.stat().st_size for file in files)
    return Size(written, written + _left_out(document))


class _Listed(TypedDict):
    """Where a sparse accessor lists the numbers or the values of its items."""

    bufferView: int


class _Sparse(TypedDict):
    """The items of an accessor that are not zero."""

    indices: _Listed
    values: _Listed


class _Accessor(TypedDict, total=False):
    """So many items."""

    count: int
    sparse: _Sparse


class _View(TypedDict):
    """Part of a buffer."""

    byteLength: int


class _Extras(TypedDict, total=False):
    """What a mesh is given besides."""

    targetNames: list[str]


class _Mesh(TypedDict, total=False):
    """A mesh."""

    extras: _Extras


class _Animation(TypedDict, total=False):
    """A clip."""

    name: str


class _Document(TypedDict, total=False):
    """What is read of a glTF file."""

    accessors: list[_Accessor]
    bufferViews: list[_View]
    meshes: list[_Mesh]
    animations: list[_Animation]


def _document(path: Path) -> _Document:
    """The JSON of a .gltf or .glb."""
    data = path.read_bytes()
    if data[:4] == b"glTF":
        data = data[20 : 20 + int.from_bytes(data[12:16], "little")]
    found: _Document = json.loads(data)
    return found


def _left_out(document: _Document) -> int:
    """Bytes that a file is spared by accessors that list only what is not zero: vectors of three floats, 12 bytes."""
    spared = 0
    for accessor in document.get("accessors", []):
        if "sparse" in accessor:
            listed = (accessor["sparse"]["indices"], accessor["sparse"]["values"])
            views = (document["bufferViews"][each["bufferView"]] for each in listed)
            spared += 12 * accessor["count"] - sum(view["byteLength"] for view in views)
    return spared


def _refuse_incomplete(document: _Document, path: Path, targets: Collection[str], clips: Collection[str]) -> None:
    """Refuse a file for `path` that holds no mesh, or not every morph target and clip."""
    meshes = document.get("meshes", [])
    if not meshes:
        raise SceneError(str(path), "holds no mesh: Blender's exporter left the face out; export it with File > Export")
    there = {name for mesh in meshes for name in mesh.get("extras", {}).get("targetNames", [])}
    animated = {animation.get("name") for animation in document.get("animations", [])}
    for kind, wanted, found in (("shape keys", targets, there), ("clips", clips, animated)):
        missing = ", ".join(sorted(set(wanted) - found))
        if missing:
            problem = f"lacks the {kind} {missing}: Blender's exporter left them out; export it with File > Export"
            raise SceneError(str(path), problem)


@contextmanager
def _shown(scene: Scene) -> Iterator[dict[str, object]]:
    """What to override so that operators see `scene`: the exporter asks the window, where there is one."""
    window = bpy.context.window
    if window is None:
        yield {"scene": scene, "view_layer": scene.view_layers[0]}
        return
    before = window.scene
    window.scene = scene
    try:
        yield {"window": window, "scene": scene, "view_layer": scene.view_layers[0]}
    finally:
        window.scene = before
