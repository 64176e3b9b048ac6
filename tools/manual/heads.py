"""Pictures of heads of the user's: points found, parts told apart, what follows a face."""

from __future__ import annotations

import json

from .session import MIDDLE, PICTURES, QUALITY, Session

#: Frames at which the six emotions of the button are full.
FULL = (24, 89, 154, 219, 284, 349)
#: Half of a picture of a face, across and up, and its middle below the eyes, as shares of the way from eyes to chin.
ACROSS, UP, BELOW = 1.45, 2.1, 0.35
#: Where in the window a face is: the middle between its eyes, and its chin, in pixels from the upper left.
PLACES = """
from importlib import import_module
from bpy_extras.view3d_utils import location_3d_to_region_2d
points = import_module("bl_ext.user_default.risorius.scene.points.kept").read_kept(bpy.context.object).points
region, view = viewport()[2]["WINDOW"], viewport()[1].spaces.active.region_3d
found = [
    location_3d_to_region_2d(region, view, bpy.context.object.matrix_world @ Vector(points[name].at))
    for name in ("3.7", "3.12", "2.1")
]
result = [[region.x + place.x, 900 - region.y - place.y] for place in ((found[0] + found[1]) / 2.0, found[2])]
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
        "obj = bpy.data.objects.new('Body', mesh)\n"
        "bpy.context.scene.collection.objects.link(obj)\n"
        "bpy.context.view_layer.objects.active = obj\n"
        "obj.select_set(True)\n"
        "viewport()[1].spaces.active.overlay.show_overlays = False\n"
        "viewport()[1].spaces.active.clip_end = 10000.0\n"
        "bpy.context.window_manager.risorius.wheel.show = bpy.context.window_manager.risorius.preview.show = False"
    )
    session.run("bpy.ops.risorius.bake_six('INVOKE_DEFAULT')")
    session.window.wait(
        "not any('bake_six' in op.bl_idname for op in bpy.context.window_manager.windows[0].modal_operators)", 300.0
    )
    shots = []
    for frame in FULL:
        session.run(f"bpy.context.scene.frame_set({frame})")
        shots.append(str(session.shot(f"body-{frame}")))
    (x, y), (_, chin) = session.window.ask("from mathutils import Vector" + PLACES)
    middle, long = y + BELOW * (chin - y), chin - y
    left, top, right, bottom = (
        round(edge) for edge in (x - ACROSS * long, middle - UP * long, x + ACROSS * long, middle + UP * long)
    )
    out = session.folder / "points-six.jpg"
    session.window.ask(
        "import numpy as np\n"
        "parts = []\n"
        f"for path in {shots!r}:\n"
        "    image = bpy.data.images.load(path)\n"
        "    w, h = image.size\n"
        "    pixels = np.empty(4 * w * h, dtype=np.float32)\n"
        "    image.pixels.foreach_get(pixels)\n"
        f"    parts.append(pixels.reshape(h, w, 4)[h - {bottom}:h - {top}, {left}:{right}])\n"
        "    bpy.data.images.remove(image)\n"
        "sheet = np.concatenate(parts, axis=1)\n"
        "picture = bpy.data.images.new('sheet', sheet.shape[1], sheet.shape[0])\n"
        "picture.pixels.foreach_set(np.ascontiguousarray(sheet).ravel())\n"
        f"picture.filepath_raw, picture.file_format = {str(out)!r}, 'JPEG'\n"
        f"picture.save(quality={QUALITY})\n"
        "viewport()[1].spaces.active.overlay.show_overlays = True"
    )
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
