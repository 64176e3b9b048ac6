"""From a face to a file of shape keys that engines know by name."""

from __future__ import annotations

from pathlib import Path

import bpy

from ...errors import ParameterError, SceneError
from ...progress import Report, run
from ..blendshape_keys import WrittenKeys, write_blendshapes
from ..pictures.film import refuse_unwritable_output
from .files import save
from .inputs import Input
from .subjects import subject

#: Files that are written.
SUFFIXES = (".blend", ".glb")


def blendshape_file(
    out: str | Path,
    *,
    mesh: str | Path | None = None,
    points: str | Path | None = None,
    object_name: str | None = None,
    names: str | Path = "arkit",
    replace: bool = False,
    progress: Report | None = None,
) -> WrittenKeys:
    """Make the shape keys of a face and save it as .blend, or as .glb for engines.

    Parameters
    ----------
    mesh, points, object_name : see `inputs.Input`; by default the default head.
    names, replace : as for `write_blendshapes`.
    progress : called with each step.

    Raises
    ------
    RisoriusError : nothing has been written then.
    """
    path = Path(out)
    if path.suffix.lower() not in SUFFIXES:
        raise ParameterError("out", f"must end in {' or '.join(SUFFIXES)}", str(out))
    refuse_unwritable_output(path)
    face = run(subject(Input.of(mesh, points, object_name)))
    written = run(write_blendshapes(face.target, names, replace=replace), progress)
    if path.suffix.lower() == ".blend":
        save(path)
    else:
        _export_glb(path)
    return written


def _export_glb(path: Path) -> None:
    """Save all objects with their shape keys as morph targets."""
    if not hasattr(bpy.types, "EXPORT_SCENE_OT_gltf"):
        raise SceneError(str(path), "this Blender has no glTF exporter: write a .blend instead")
    try:
        bpy.ops.export_scene.gltf(filepath=str(path.resolve()), export_format="GLB", export_morph=True)
    except RuntimeError as problem:
        raise SceneError(str(path), f"could not be written ({problem}): choose another folder") from problem
