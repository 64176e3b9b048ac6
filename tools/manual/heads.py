"""Pictures of heads of the user's: points found, parts told apart, what follows a face."""

from __future__ import annotations

import json

from .session import MIDDLE, PICTURES, QUALITY, Session

#: Frames at which the six emotions of the button are full.
FULL = (24, 89, 154, 219, 284, 349)
#: Renders of the active face at some frames, as an array (height, width, 4) in a file.
ROW = """
import numpy as np
from importlib import import_module
pictures = "bl_ext.user_default.risorius.scene.pictures."
look, framing, studio = (import_module(pictures + name) for name in ("look", "framing", "studio"))
seen = look.Look(width=320, height=400, engine=look.Engine.WORKBENCH)
tiles = []
with studio.studio([bpy.context.object], framing.framing_of(bpy.context.object), seen) as scene:
    for frame in {frames!r}:
        tile = bpy.data.images.load(str(studio.render_frame(scene, frame, Path({folder!r}))))
        pixels = np.empty(4 * 320 * 400, dtype=np.float32)
        tile.pixels.foreach_get(pixels)
        tiles.append(pixels.reshape(400, 320, 4))
        bpy.data.images.remove(tile)
sheet = np.ascontiguousarray(np.concatenate(tiles, axis=1))
picture = bpy.data.images.new("sheet", sheet.shape[1], sheet.shape[0])
picture.pixels.foreach_set(sheet.ravel())
picture.filepath_raw, picture.file_format = {out!r}, "JPEG"
picture.save(quality={quality})
"""


def own_head(session: Session) -> None:
    """A head of the user's: points found, parts told apart."""
    mesh = session.lent("heads/makehuman.npz")
    session.only_panels("points", "parts")
    session.fresh()
    session.window.ask(
        "import numpy as np\n"
        f"data = np.load({str(mesh)!r})\n"
        "ends = np.cumsum(data['face_sizes'])\n"
        "faces = [data['loops'][e - n:e].tolist() for e, n in zip(ends, data['face_sizes'])]\n"
        "mesh = bpy.data.meshes.new('My Head')\n"
        "mesh.from_pydata(data['vertices'].tolist(), [], faces)\n"
        "mesh.polygons.foreach_set('use_smooth', [True] * len(mesh.polygons))\n"
        "obj = bpy.data.objects.new('My Head', mesh)\n"
        "bpy.context.scene.collection.objects.link(obj)\n"
        "bpy.context.view_layer.objects.active = obj\n"
        "obj.select_set(True)"
    )
    session.run("bpy.ops.view3d.view_axis(type='FRONT')\nbpy.ops.view3d.view_selected()")
    session.run("bpy.ops.risorius.find_points()")
    session.take("points-found")
    session.run(
        "bpy.ops.risorius.find_parts()\nbpy.context.window_manager.risorius.parts.show = True\n"
        "bpy.context.window_manager.risorius.points.show = False"
    )
    session.take("parts")
    session.run("bpy.context.window_manager.risorius.parts.show = False")


def body(session: Session) -> None:
    """A whole body, Y up, in centimetres, turned by 20 degrees: the six emotions of one press, beside each other."""
    session.fresh()
    session.window.ask(
        "import numpy as np\n"
        f"data = np.load({str(session.lent('heads/makehuman_body.npz'))!r})\n"
        "ends, turn = np.cumsum(data['face_sizes']), np.radians(20.0)\n"
        "faces = [data['loops'][e - n:e].tolist() for e, n in zip(ends, data['face_sizes'])]\n"
        "x, y, z = 100.0 * data['vertices'].T\n"
        "x, y = np.cos(turn) * x - np.sin(turn) * y, np.sin(turn) * x + np.cos(turn) * y\n"
        "mesh = bpy.data.meshes.new('Body')\n"
        "mesh.from_pydata(np.stack([x, z, -y], axis=1).tolist(), [], faces)\n"
        "mesh.polygons.foreach_set('use_smooth', [True] * len(mesh.polygons))\n"
        "clay = bpy.data.materials.new('Clay')\n"
        "clay.diffuse_color = (0.5, 0.42, 0.37, 1.0)\n"
        "mesh.materials.append(clay)\n"
        "obj = bpy.data.objects.new('Body', mesh)\n"
        "bpy.context.scene.collection.objects.link(obj)\n"
        "bpy.context.view_layer.objects.active = obj\n"
        "obj.select_set(True)\n"
        "bpy.context.window_manager.risorius.wheel.show = bpy.context.window_manager.risorius.preview.show = False"
    )
    session.run("bpy.ops.risorius.bake_six('INVOKE_DEFAULT')")
    session.window.wait(
        "not any('bake_six' in op.bl_idname for op in bpy.context.window_manager.windows[0].modal_operators)", 300.0
    )
    out = session.folder / "points-six.jpg"
    row = ROW.format(frames=FULL, folder=str(session.folder), out=str(out), quality=QUALITY)
    session.window.ask("from pathlib import Path" + row)
    (PICTURES / out.name).write_bytes(out.read_bytes())
    print(out.name, flush=True)


def clicking(session: Session) -> None:
    """Blender's monkey, whose face is clicked: the next point is asked for, corners of eyes and mouth are mirrored."""
    places = json.loads(session.lent("heads/suzanne.fp.json").read_text(encoding="utf-8"))["points"]
    session.fresh()
    session.run(
        "bpy.ops.mesh.primitive_monkey_add()\nbpy.context.object.scale = (0.1,) * 3\n"
        "bpy.ops.view3d.view_axis(type='FRONT')\nbpy.ops.view3d.view_selected()\nbpy.ops.view3d.zoom(delta=-1)"
    )
    session.run("bpy.ops.risorius.click_points('INVOKE_DEFAULT')")
    for name in ("3.7", "8.3", "9.3"):
        pixel = session.window.ask(
            "from bpy_extras.view3d_utils import location_3d_to_region_2d\n"
            "region, obj = viewport()[2]['WINDOW'], bpy.context.object\n"
            f"place = obj.matrix_world @ obj.data.vertices[{int(places[name])}].co\n"
            "at = location_3d_to_region_2d(region, viewport()[1].spaces.active.region_3d, place)\n"
            "result = [round(region.x + at.x), 900 - round(region.y + at.y)]"
        )
        session.window.click(*pixel)
    session.take("points-clicked", MIDDLE)
    session.window.key("Escape")


#: Objects of a character -> labels of the shared head that they are made of, and their colour.
CHARACTER = {
    "Body": ((0, 5, 7), (0.72, 0.5, 0.4)),
    "Eyes": ((1, 2), (0.9, 0.9, 0.9)),
    "Teeth": ((3, 8), (0.95, 0.92, 0.8)),
    "Tongue": ((4,), (0.75, 0.25, 0.25)),
    "Eyelashes": ((6,), (0.08, 0.05, 0.05)),
}


def character(session: Session) -> None:
    """A character of several objects, baked by one button, and what follows its face."""
    mesh = session.lent("heads/makehuman.npz")
    session.only_panels("followers", "emotion")
    session.fresh()
    session.window.ask(
        "import numpy as np\n"
        f"data = np.load({str(mesh)!r})\n"
        "labels, ends = data['labels'], np.cumsum(data['face_sizes'])\n"
        "faces = [data['loops'][e - n:e] for e, n in zip(ends, data['face_sizes'])]\n"
        f"for name, (kinds, colour) in {CHARACTER!r}.items():\n"
        "    mine = [face for face in faces if labels[face[0]] in kinds]\n"
        "    used = np.unique(np.concatenate(mine))\n"
        "    mesh = bpy.data.meshes.new(name)\n"
        "    polygons = [np.searchsorted(used, face).tolist() for face in mine]\n"
        "    mesh.from_pydata(data['vertices'][used].tolist(), [], polygons)\n"
        "    mesh.polygons.foreach_set('use_smooth', [True] * len(mesh.polygons))\n"
        "    material = bpy.data.materials.new(name)\n"
        "    material.diffuse_color = (*colour, 1.0)\n"
        "    mesh.materials.append(material)\n"
        "    obj = bpy.data.objects.new(name, mesh)\n"
        "    bpy.context.scene.collection.objects.link(obj)\n"
        "body = bpy.data.objects['Body']\n"
        "bpy.context.view_layer.objects.active = body\n"
        "body.select_set(True)"
    )
    session.run("bpy.ops.view3d.view_axis(type='FRONT')\nbpy.ops.view3d.view_selected()")
    session.run("bpy.ops.risorius.bake_six()\nbody.risorius.emotion.word = 'surprise'")
    session.window.wait("any(m.name == 'Risorius Preview' and m.show_viewport for m in body.modifiers)")
    session.take("character")
