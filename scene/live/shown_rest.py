"""How a resting mesh shows under modifiers that make more vertices of it, as a Subdivision Surface does.

Such a modifier moves even the vertices that it keeps, so what a posed face shows cannot be compared with the mesh
itself. The resting mesh is put through the same modifiers once, in a scene of its own that is taken away at once.
"""

from __future__ import annotations

import bpy
import numpy as np

from ...arrays import Floats
from ...errors import SceneError
from ..attributes import write_floats
from ..blender_types import Object
from ..mesh import mesh_vertices, remove_all_keys, rest_vertices

#: Modifiers that keep the mesh's own vertices, first and in their order, and add others to them.
ADDING = {"SUBSURF", "MULTIRES", "MIRROR", "SOLIDIFY"}
#: A vertex that is kept lies at most this share of the mesh's size from where it was.
NEAR = 0.05


def shown_rest(obj: Object, count: int) -> Floats:
    """(`count`, 3) vertices of the resting mesh as modifiers show it; the mesh's own come first.

    Raises
    ------
    SceneError : the modifiers do not keep the mesh's own vertices; names what to switch off.
    """
    rest = rest_vertices(obj.data)
    found = _through(obj, rest)
    size = float(np.linalg.norm(np.ptp(rest, axis=0)))
    kept = len(found) == count and count >= len(rest)
    if not kept or np.linalg.norm(found[: len(rest)] - rest, axis=1).max() > NEAR * size:
        raise SceneError(
            obj.name,
            f"shows {count} vertices, but its mesh has {len(rest)}, made by its modifiers {_suspects(obj)}: "
            "turn them off in the viewport (monitor icon) to read the face",
        )
    return found


def _suspects(obj: Object) -> str:
    """Modifiers that may make other vertices."""
    moving = {"ARMATURE", "CAST", "CURVE", "DISPLACE", "HOOK", "LATTICE", "MESH_DEFORM", "SHRINKWRAP", "SMOOTH"}
    moving |= {"CORRECTIVE_SMOOTH", "LAPLACIANSMOOTH", "SURFACE_DEFORM", "WARP", "WAVE", *ADDING}
    others = [m for m in obj.modifiers if m.show_viewport and not m.name.startswith("Risorius")]
    return ", ".join(m.name for m in others if m.type not in moving) or ", ".join(m.name for m in others)


def _through(obj: Object, rest: Floats) -> Floats:
    """(n, 3) what the adding modifiers of `obj` make of its resting mesh."""
    scene = bpy.data.scenes.new("Risorius Resting Face")
    for name in ("use_simplify", "simplify_subdivision"):
        setattr(scene.render, name, getattr(bpy.context.scene.render, name))
    copy = obj.copy()
    copy.data = obj.data.copy()
    mesh = copy.data
    try:
        copy.parent = None
        copy.animation_data_clear()
        remove_all_keys(copy)
        write_floats(mesh.vertices, "co", rest)
        for modifier in list(copy.modifiers):
            if modifier.type not in ADDING:
                copy.modifiers.remove(modifier)
        scene.collection.objects.link(copy)
        layer = scene.view_layers[0]
        layer.update()
        return mesh_vertices(copy.evaluated_get(layer.depsgraph).data)
    finally:
        bpy.data.objects.remove(copy)
        bpy.data.meshes.remove(mesh)
        bpy.data.scenes.remove(scene)
