"""Pictures of a head with shape keys of its own, baked to them."""

from __future__ import annotations

from .heads import FULL
from .session import MIDDLE, PICTURES, QUALITY, Session

#: The shared head with keys that other people drew, its material and points; looked at from the front.
OWN_KEYS = """
import json
import numpy as np
from importlib import import_module
data, drawn = np.load({mesh!r}), np.load({keys!r}, allow_pickle=True)
ends = np.cumsum(data["face_sizes"])
mesh = bpy.data.meshes.new("Amira")
faces = [data["loops"][e - n:e].tolist() for e, n in zip(ends, data["face_sizes"])]
mesh.from_pydata(data["vertices"].tolist(), [], faces)
mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
colours = {{1: (0.9, 0.9, 0.9), 2: (0.9, 0.9, 0.9), 3: (0.95, 0.92, 0.8), 4: (0.75, 0.25, 0.25), 8: (0.95, 0.92, 0.8)}}
for number in range(9):
    material = bpy.data.materials.new(str(number))
    material.diffuse_color = (*colours.get(number, (0.72, 0.5, 0.4)), 1.0)
    mesh.materials.append(material)
mesh.polygons.foreach_set("material_index", [int(data["labels"][face[0]]) for face in faces])
obj = bpy.data.objects.new("Amira", mesh)
bpy.context.scene.collection.objects.link(obj)
obj.shape_key_add(name="Basis")
for name, delta in zip(drawn["names"], drawn["deltas"]):
    key = obj.shape_key_add(name=str(name), from_mix=False)
    key.value = 0.0
    key.data.foreach_set("co", (data["vertices"] + delta).astype(np.float32).ravel())
bpy.context.view_layer.objects.active = obj
obj.select_set(True)
stored = import_module("bl_ext.user_default.risorius.scene.points.stored")
stored.store_points(obj, {{name: int(vertex) for name, vertex in json.load(open({points!r}))["points"].items()}})
bpy.context.window_manager.risorius.preview.show = bpy.context.window_manager.risorius.wheel.show = False
"""

#: A row of small renders of the face, one at each of some frames, as an array in `rows`.
ROW = """
import math
import numpy as np
from importlib import import_module
scene, obj = bpy.context.scene, bpy.data.objects["Amira"]
places = import_module("bl_ext.user_default.risorius.scene.points.stored").stored_points(obj)
left, right, chin = (np.array(obj.data.vertices[places[name]].co) for name in ("3.7", "3.12", "2.1"))
eyes = (left + right) / 2.0
height = float(np.linalg.norm(eyes - chin))
camera = bpy.data.objects.get("Portrait") or bpy.data.objects.new("Portrait", bpy.data.cameras.new("Portrait"))
if camera.name not in scene.collection.objects: scene.collection.objects.link(camera)
camera.data.type, camera.data.ortho_scale = "ORTHO", 2.1 * height
camera.location = (0.0, float(eyes[1]) - 10.0 * height, float(0.62 * eyes[2] + 0.38 * chin[2]))
camera.rotation_euler = (math.pi / 2.0, 0.0, 0.0)
camera.data.clip_end = 100.0 * height
scene.camera, scene.render.engine = camera, "BLENDER_WORKBENCH"
scene.render.resolution_x = scene.render.resolution_y = 200
scene.render.filepath, scene.render.image_settings.file_format = {tile!r}, "PNG"
scene.display.shading.color_type, scene.display.shading.light = "MATERIAL", "STUDIO"
tiles = []
for frame in {frames!r}:
    scene.frame_set(frame)
    bpy.ops.render.render(write_still=True)
    tile = bpy.data.images.load({tile!r})
    pixels = np.empty(4 * 200 * 200, dtype=np.float32)
    tile.pixels.foreach_get(pixels)
    tiles.append(pixels.reshape(200, 200, 4))
    bpy.data.images.remove(tile)
np.save({row!r}, np.concatenate(tiles, axis=1))
scene.camera = None
"""


def rig(session: Session) -> None:
    """A head with keys of its own, baked to them: the panel, and what the six emotions become beside the muscles'."""
    others = "heads/others/makehuman_arkit/makehuman_arkit_visemes.npz"
    lent = {"mesh": "heads/makehuman.npz", "keys": others, "points": "heads/makehuman.fp.json"}
    session.only_panels("bake")
    session.fresh()
    session.window.ask(OWN_KEYS.format(**{name: str(session.lent(path)) for name, path in lent.items()}))
    session.run("bpy.ops.view3d.view_axis(type='FRONT')\nbpy.ops.view3d.view_selected()")
    session.run("viewport()[1].spaces.active.shading.color_type = 'MATERIAL'")
    rows = []
    for onto in ("NEW", "KEYS"):
        rows.append(str(session.folder / f"row-{onto}.npy"))
        session.window.ask(f"bpy.data.objects['Amira'].risorius.bake.onto = {onto!r}")
        session.run("bpy.ops.risorius.bake_six('INVOKE_DEFAULT')")
        session.window.wait(
            "not any('bake_six' in op.bl_idname for op in bpy.context.window_manager.windows[0].modal_operators)"
        )
        tile = str(session.folder / "tile.png")
        session.window.ask(ROW.format(tile=tile, row=rows[-1], frames=FULL))
        if onto == "NEW":
            session.run("bpy.ops.risorius.clear()")
    session.window.ask(
        "import numpy as np\n"
        f"rows = [np.load(path) for path in {rows!r}]\n"
        "sheet = np.concatenate(rows[::-1], axis=0)\n"
        "picture = bpy.data.images.new('sheet', sheet.shape[1], sheet.shape[0])\n"
        "picture.pixels.foreach_set(np.ascontiguousarray(sheet).ravel())\n"
        f"picture.filepath_raw, picture.file_format = {str(session.folder / 'rig-six.jpg')!r}, 'JPEG'\n"
        f"picture.save(quality={QUALITY})"
    )
    (PICTURES / "rig-six.jpg").write_bytes((session.folder / "rig-six.jpg").read_bytes())
    print("rig-six.jpg", flush=True)
    session.window.ask("bpy.data.objects.remove(bpy.data.objects['Portrait'])")
    session.run(f"bpy.context.scene.frame_set({FULL[1]})")
    session.take("rig", MIDDLE)
