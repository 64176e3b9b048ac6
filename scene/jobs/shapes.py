"""From a face to a file for engines: shape keys that they know by name, or the clips that are baked on it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from ...errors import ParameterError
from ...progress import Report, run
from ..blendshape_keys import WrittenKeys, write_blendshapes
from ..gltf import Exported, export_gltf, write_gltf
from ..pictures.film import refuse_unwritable_output
from ..traces import clear_traces
from .files import save
from .inputs import Input
from .subjects import subject

#: Files that are written.
SUFFIXES = (".blend", ".glb")
GLTF_SUFFIXES = (".glb", ".gltf")


def blendshape_file(
    out: str | Path,
    *,
    mesh: str | Path | None = None,
    points: str | Path | None = None,
    object_name: str | None = None,
    names: str | Path = "arkit",
    replace: bool = False,
    morph_normals: bool = True,
    progress: Report | None = None,
) -> WrittenKeys:
    """Make the shape keys of a face and save it as .blend, or as .glb for engines.

    Parameters
    ----------
    mesh, points, object_name : see `inputs.Input`; by default the default head.
    names, replace : as for `write_blendshapes`.
    morph_normals : as for `gltf.export_gltf`.
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
        keys = [keys for obj in face.target.objects() if (keys := obj.data.shape_keys) is not None]
        clear_traces(keys, written.keys)
        write_gltf(path, written.keys, export_animations=False, export_morph_normal=morph_normals)
    return written


def gltf_file(
    out: str | Path, *, mesh: str | Path, object_name: str | None = None, morph_normals: bool = True
) -> Exported:
    """Export the face of a .blend with all its clips, as the button does.

    Parameters
    ----------
    out : the .glb or .gltf to write.
    mesh, object_name : see `inputs.Input`.
    morph_normals : as for `gltf.export_gltf`.

    Raises
    ------
    RisoriusError : nothing has been written then.
    """
    path = Path(out)
    if path.suffix.lower() not in GLTF_SUFFIXES:
        raise ParameterError("out", f"must end in {' or '.join(GLTF_SUFFIXES)}", str(out))
    refuse_unwritable_output(path)
    face = run(subject(Input.of(mesh, object_name=object_name)))
    exported = export_gltf(face.target.objects(), path, morph_normals=morph_normals)
    return replace(exported, remarks=face.remarks + exported.remarks + face.target.remarks())
