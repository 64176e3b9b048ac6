"""Shape keys that engines know by name (ARKit, visemes) on a face's meshes; from then on they are the user's own."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from ..arrays import Floats
from ..errors import SceneError
from ..progress import Progress, Work, part_of
from .bake.remarks import shown_remarks
from .bake.shape_keys import write_shape
from .bake.target import Target
from .bake.writing import STILL
from .blender_types import Object
from .faces import FaceSource, face_steps
from .mesh import keys_of
from .refusals import own_mesh
from .shape_mix import data_path


@dataclass(frozen=True)
class WrittenKeys:
    """What was written.

    Attributes
    ----------
    keys : by name. replaced : those that the object had before and that were replaced.
    remarks : what the user should know.
    """

    keys: tuple[str, ...]
    replaced: tuple[str, ...]
    remarks: tuple[str, ...] = ()


def write_blendshapes(target: Target, names: str | Path = "arkit", *, replace: bool = False) -> Work[WrittenKeys]:
    """Make the shape keys of a preset of names by posing the face, and write them onto its meshes.

    They are the user's own: no later bake, and no clearing of what was baked, touches them. Every key is on the head's
    mesh; its other objects get those in which they move, driven by the head's.

    Parameters
    ----------
    names : "arkit", another preset of key names, or a TOML file (docs/formats.md).
    replace : write over keys of the same names; without it they are refused.

    Raises
    ------
    SceneError, ModelError, FormatError : nothing has been changed then.
    """
    from ..face.products.blendshapes import arkit_shape_steps
    from ..mpeg4.streams.capture import load_key_names

    wanted = load_key_names(names)
    source = target.source(replacing=wanted if replace else ())
    there = _taken(source, wanted)
    if there and not replace:
        some = ", ".join(there[:3])
        problem = f"already has shape keys with these names ({some}): remove them, or turn on Replace (--replace)"
        raise SceneError(source.head.name, problem)
    yield Progress(0.0, "Reading the face")
    face = yield from part_of(face_steps(source), 0.0, 0.0)
    posed = yield from part_of(arkit_shape_steps(face, wanted), 0.0, 0.97)
    shapes = {name: positions - face.vertices for name, positions in posed.items()}
    yield Progress(0.97, "Writing the shape keys")
    target.refuse_changed(source)
    if target.make_single_user:
        for obj in source.objects:
            own_mesh(obj)
    for piece in source.pieces:
        moving = {
            name: piece.key_positions(moved)
            for name, moved in shapes.items()
            if piece is source.pieces[0] or piece.moves(moved, STILL * face.scale)
        }
        new = _write(piece.obj, moving)
        if piece is not source.pieces[0]:
            _drive(piece.obj, new, source.head)
    missed = (f"{name}: {why}" for name, why in posed.unmet.items())
    return WrittenKeys(tuple(shapes), there, (*shown_remarks(source.head), *missed, *target.remarks()))


def _taken(source: FaceSource, wanted: Mapping[str, object]) -> tuple[str, ...]:
    """Names among those wanted that a mesh of the face has already."""
    blocks = (obj.data.shape_keys.key_blocks for obj in source.objects if obj.data.shape_keys is not None)
    return tuple(sorted({block.name for keys in blocks for block in keys if block.name in wanted}))


def _write(obj: Object, shapes: Mapping[str, Floats]) -> list[str]:
    """Shape keys at rest, positions (V, 3) in the mesh's own coordinates; returns names of those that are new."""
    new: list[str] = []
    for name, positions in shapes.items():
        keys = keys_of(obj)
        new += [] if name in keys.key_blocks else [name]
        block = keys.key_blocks.get(name) or obj.shape_key_add(name=name, from_mix=False)
        block.slider_min, block.slider_max = 0.0, 1.0
        write_shape(keys, block, positions)
    obj.data.update_tag()
    return new


def _drive(obj: Object, names: Iterable[str], head: Object) -> None:
    """Give shape keys of an object the values of the head's keys of the same names, by drivers."""
    keys, heads = keys_of(obj), keys_of(head)
    for name in names:
        driver = keys.key_blocks[name].driver_add("value").driver
        if driver.variables:  # of a key of this name that was deleted
            continue
        driver.type = "AVERAGE"
        variable = driver.variables.new()
        variable.targets[0].id_type, variable.targets[0].id = "KEY", heads
        variable.targets[0].data_path = data_path(name)
