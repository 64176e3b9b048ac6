"""All meshes of a scene as they show at the current frame, and those of a face among them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ...arrays import Bools, Floats, Ints
from ...errors import SceneError
from ...labels.geometry import Shown
from .. import mesh as meshes
from ..attributes import read_floats, read_ints
from ..blender_types import Depsgraph, Mesh, Object, Scene
from ..faces import Piece
from .clear import clear_slots

#: The engine that draws materials by their colours for the viewport, and objects that cameras are not to see.
WORKBENCH = "BLENDER_WORKBENCH"
#: What can be drawn as a mesh.
SOLID = {"MESH", "CURVE", "SURFACE", "FONT", "META"}
#: Modifiers that add vertices behind those of the mesh, which stay the first ones.
ADDING = {"SUBSURF", "MULTIRES", "MIRROR", "SOLIDIFY", "ARRAY", "EDGE_SPLIT", "TRIANGULATE"}


@dataclass(frozen=True, eq=False)
class Stage:
    """A frame of a scene.

    Attributes
    ----------
    local : (V, 3) of the face's vertices in their own objects' coordinates, as they show.
    world : (V, 3) the same in the world, metres. shown : all that shows.
    """

    local: Floats
    world: Floats
    shown: Shown


def stage_of(scene: Scene, pieces: Sequence[Piece], names: list[str] | None = None) -> Stage:
    """What a scene shows at the current frame, evaluated.

    Parameters
    ----------
    names : of objects that earlier frames showed, so that they keep their places in `Shown.objects`; new ones are
        added.

    Raises
    ------
    SceneError : a modifier makes another mesh of the face, so that its vertices cannot be followed.
    """
    depsgraph, metres = scene.view_layers[0].depsgraph, scene.unit_settings.scale_length
    gathered = _Gathered([] if names is None else names)
    workbench = scene.render.engine == WORKBENCH
    places: dict[str, tuple[Floats, Floats]] = {}
    by_name = {piece.obj.name: piece for piece in pieces}
    for obj, mesh, world in _solids(depsgraph, workbench=workbench):
        local = meshes.mesh_vertices(mesh)
        there = (local @ world[:3, :3].T + world[:3, 3]) * metres
        source = np.full(len(local), -1, dtype=np.int64)
        piece = by_name.get(obj.name)
        if piece is not None and obj.name not in places:
            own = _own(piece, len(local))
            source = piece.first + _sources(local, own)
            places[obj.name] = local[:own], there[:own]
        inverse = np.asarray(np.linalg.inv(world[:3, :3]))
        gathered.add(obj.name, there, mesh, inverse, source, clear_slots(obj, workbench=workbench))
    missing = [name for name in by_name if name not in places]
    if missing:
        raise SceneError(missing[0], "does not show in this scene: turn on its camera icon in the Outliner")
    local, world = (np.concatenate([places[piece.obj.name][i] for piece in pieces]) for i in (0, 1))
    return Stage(local, world, gathered.shown())


def _solids(depsgraph: Depsgraph, *, workbench: bool) -> Iterator[tuple[Object, Mesh, Floats]]:
    """Each object that renders, its mesh as it shows and its matrix; instances one by one."""
    for instance in depsgraph.object_instances:
        shown = instance.object
        if shown.type not in SOLID or shown.hide_render or not (instance.show_self or instance.is_instance):
            continue
        if not (workbench or shown.visible_camera):
            continue
        world = np.array([tuple(row) for row in instance.matrix_world], dtype=np.float64)
        if shown.type == "MESH":
            yield shown, shown.data, world
            continue
        mesh = shown.to_mesh()
        if mesh is not None:
            yield shown, mesh, world
        shown.to_mesh_clear()


def _own(piece: Piece, count: int) -> int:
    """How many of the first vertices that show are those of the mesh itself."""
    own = len(piece.mix)
    acting = [modifier for modifier in piece.obj.modifiers if modifier.show_viewport]
    if count < own or (count > own and not any(modifier.type in ADDING for modifier in acting)):
        names = ", ".join(modifier.name for modifier in acting)
        raise SceneError(
            piece.obj.name,
            f"shows {count} vertices instead of its own {own}, so its landmarks cannot be followed: apply or turn off "
            f"the modifier that changes them ({names})",
        )
    return own


def _sources(local: Floats, own: int) -> Ints:
    """(V',) which of the first `own` vertices each one is, or is nearest to."""
    numbers = np.arange(len(local))
    if len(local) > own:
        numbers[own:] = cKDTree(local[:own]).query(local[own:])[1]
    return numbers


class _Gathered:
    """Meshes one after another."""

    def __init__(self, names: list[str]) -> None:
        self._count, self._names = 0, names
        self._vertices, self._triangles = list[Floats](), list[Ints]()
        self._normals, self._owners, self._sources = list[Floats](), list[Ints](), list[Ints]()

    def add(self, name: str, vertices: Floats, mesh: Mesh, inverse: Floats, source: Ints, clear: Bools) -> None:
        """Take in a mesh; `inverse` (3, 3) of its turn and scale in the world, `clear` (n,) materials left out."""
        mesh.calc_loop_triangles()
        slots = np.minimum(read_ints(mesh.loop_triangles, "material_index"), len(clear) - 1)
        solid = ~clear[slots]
        corners = read_ints(mesh.loop_triangles, "loops", 3)[solid]
        normals = read_floats(mesh.corner_normals, "vector", 3) @ inverse
        length = np.linalg.norm(normals, axis=1, keepdims=True)
        if name not in self._names:
            self._names.append(name)
        self._vertices.append(vertices)
        self._triangles.append(meshes.triangle_corners(mesh)[solid] + self._count)
        self._normals.append((normals / np.where(length > 0.0, length, 1.0))[corners])
        self._owners.append(np.full(len(corners), self._names.index(name), dtype=np.int64))
        self._sources.append(source)
        self._count += len(vertices)

    def shown(self) -> Shown:
        """All of them."""
        return Shown(
            np.concatenate(self._vertices),
            np.concatenate(self._triangles),
            np.concatenate(self._normals),
            np.concatenate(self._owners),
            tuple(self._names),
            np.concatenate(self._sources),
        )
