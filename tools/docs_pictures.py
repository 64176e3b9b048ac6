"""The pictures of the manual, taken in a real Blender window so that they show the panels as they are.

    make docs-pictures                       ARGS="--only wheel timeline" for some of them

Builds and installs the extension into a settings folder of its own, goes through the steps that the pages describe,
and writes docs/pictures/. Needs Linux, root and the shared tool that keeps a Blender with a virtual screen
(`blender-gui` in RISORIUS_SHARED, default ../shared).
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Mapping
from pathlib import Path

from places import DOCS, ROOT, shared_folder
from window.driver import NoSharedBlenderError, Window, WindowError, call, shared_blender

PICTURES = DOCS / "pictures"
#: Quality of the JPEG files, and seconds for the window to draw what was changed.
QUALITY, DRAWN = 85, 1.5
VIEW = "bl_ext.user_default.risorius.operators.wheel.view"

#: Whole window, or the part from (left, top) to (right, bottom) in its pixels.
Crop = tuple[int, int, int, int]
WHOLE: Crop = (0, 0, 1600, 900)
MIDDLE: Crop = (0, 40, 1312, 815)


class Session:
    """One window in which pictures are taken one after another."""

    def __init__(self, window: Window, folder: Path) -> None:
        self.window, self.folder = window, folder

    def run(self, code: str) -> None:
        """Run a script with the 3D viewport as its context."""
        indented = "\n".join(f"    {line}" for line in code.strip().splitlines())
        self.window.ask(f"with in_viewport():\n{indented}")

    def take(self, name: str, crop: Crop = WHOLE) -> None:
        """A picture of the window, as docs/pictures/NAME.jpg."""
        time.sleep(DRAWN)
        shot = self.window.shot(self.folder / f"{name}.png")
        out = self.folder / f"{name}.jpg"
        left, top, right, bottom = crop
        self.window.ask(
            "import numpy as np\n"
            f"source = bpy.data.images.load({str(shot)!r})\n"
            "w, h = source.size\n"
            "pixels = np.empty(4 * w * h, dtype=np.float32)\n"
            "source.pixels.foreach_get(pixels)\n"
            f"part = pixels.reshape(h, w, 4)[h - {bottom}:h - {top}, {left}:{right}]\n"
            "picture = bpy.data.images.new('picture', part.shape[1], part.shape[0])\n"
            "picture.pixels.foreach_set(np.ascontiguousarray(part).ravel())\n"
            f"picture.filepath_raw, picture.file_format = {str(out)!r}, 'JPEG'\n"
            f"picture.save(quality={QUALITY})\n"
            "bpy.data.images.remove(picture)\n"
            "bpy.data.images.remove(source)"
        )
        PICTURES.mkdir(parents=True, exist_ok=True)
        (PICTURES / f"{name}.jpg").write_bytes(out.read_bytes())
        print(f"{name}.jpg", flush=True)

    def fresh(self) -> None:
        """An empty file with the sidebar's tab open."""
        self.window.ask("bpy.ops.wm.read_homefile(use_empty=False)")
        self.run(
            "for obj in list(bpy.data.objects): bpy.data.objects.remove(obj)\n"
            "viewport()[1].spaces.active.show_region_ui = True"
        )
        time.sleep(DRAWN)
        self.window.ask("viewport()[2]['UI'].active_panel_category = 'Risorius'")

    def lent(self, name: str) -> Path:
        """A copy of a shared file where the window's Blender sees it."""
        copy = self.folder / Path(name).name
        copy.write_bytes((shared_folder() / name).read_bytes())
        return copy

    def only_panels(self, *names: str) -> None:
        """Leave these of the tab's panels, open; the other pictures come before."""
        self.window.ask(
            "panels = bpy.types.Panel.__subclasses__()\n"
            "kinds = {c.__name__: c for c in panels if c.__name__.startswith('RISORIUS_PT_')}\n"
            "for cls in kinds.values():\n"
            "    if cls.is_registered and getattr(cls, 'bl_parent_id', ''): bpy.utils.unregister_class(cls)\n"
            f"for name in {names!r}:\n"
            "    cls = kinds[f'RISORIUS_PT_{name}']\n"
            "    cls.bl_options = set()\n"
            "    bpy.utils.register_class(cls)"
        )

    def head(self) -> None:
        """The default head, shown by the preview."""
        self.fresh()
        self.run("bpy.ops.risorius.add_head()")
        self.window.wait("len(bpy.context.object.modifiers)")


def first(session: Session) -> None:
    """The first minute: the head, joyful, before anything is baked."""
    session.head()
    session.take("first-minute")


def wheel(session: Session) -> None:
    """The pointer has dragged the emotion to guilty."""
    session.head()
    session.run("bpy.context.object.risorius.emotion.word = 'guilty'")
    session.take("wheel", MIDDLE)


def timeline(session: Session) -> None:
    """Three clips, one selected."""
    session.head()
    for frame, word in ((1, "joy"), (45, "surprise"), (90, "disgust")):
        session.run(
            f"bpy.context.scene.frame_set({frame})\n"
            "bpy.ops.risorius.add_clip()\n"
            f"bpy.context.object.risorius.emotion.word = {word!r}"
        )
    session.take("timeline")


def muscles(session: Session) -> None:
    """Muscles of a smile from the side, and their sliders."""
    session.head()
    session.run(
        "window = bpy.context.window_manager.risorius\n"
        "window.show.muscles = window.muscles.busy_only = True\n"
        "bpy.ops.view3d.view_orbit(angle=0.5, type='ORBITRIGHT')"
    )
    session.take("muscles", MIDDLE)
    session.run("window.show.muscles = False\nwindow.show.strain = True")
    session.take("strain", MIDDLE)
    session.run("window.show.strain = False\nwindow.show.paths = True\nbpy.context.object.risorius.emotion.seed = 0")
    session.window.wait("bpy.context.object.modifiers[0].show_viewport")
    session.take("paths", MIDDLE)
    session.run("window.show.paths = False")


def baked(session: Session) -> None:
    """A baked expression at its apex."""
    session.head()
    session.run("bpy.context.object.risorius.emotion.word = 'surprise'\nbpy.ops.risorius.bake_expression()")
    session.run("bpy.context.scene.frame_set(30)")
    session.take("baked")


def own_head(session: Session) -> None:
    """A head of the user's: points found, parts told apart."""
    mesh = session.lent("heads/makehuman.npz")
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
    session.take("own-head")
    session.run("bpy.ops.risorius.find_points()")
    session.take("points-found")
    session.run(
        "bpy.ops.risorius.find_parts()\nbpy.context.window_manager.risorius.parts.show = True\n"
        "bpy.context.window_manager.risorius.points.show = False"
    )
    session.take("parts")
    session.run("bpy.context.window_manager.risorius.parts.show = False")


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


def reading(session: Session) -> None:
    """The Read panel, alone and open, on joy at its apex; and the plot of its animation."""
    session.only_panels("read", "read_faps", "read_features")
    session.head()
    session.run(
        "scene = bpy.context.scene\nscene.frame_end = 75\nscene.risorius.read.rule = 'robust'\n"
        "bpy.ops.risorius.bake_expression()\nscene.frame_set(20)"
    )
    session.take("reading", MIDDLE)
    session.window.ask(
        "with in_viewport():\n    bpy.ops.risorius.read_animation()\n"
        "    picture = bpy.data.images[f'{bpy.context.object.name} Beliefs']\n"
        f"path = {str(session.folder / 'reading-plot.jpg')!r}\n"
        "picture.filepath_raw, picture.file_format = path, 'JPEG'\n"
        f"picture.save(quality={QUALITY})"
    )
    (PICTURES / "reading-plot.jpg").write_bytes((session.folder / "reading-plot.jpg").read_bytes())


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

#: Frames at which the six emotions of the button are full.
FULL = (24, 89, 154, 219, 284, 349)


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


PICTURED: Mapping[str, Callable[[Session], None]] = {
    "first": first,
    "wheel": wheel,
    "timeline": timeline,
    "muscles": muscles,
    "baked": baked,
    "own_head": own_head,
    "reading": reading,  # the last three take the other panels away
    "character": character,
    "rig": rig,
}


def installed(tool: Path, folder: Path) -> Path:
    """A settings folder in which the extension is installed and enabled."""
    settings = folder / "settings"
    settings.mkdir()
    build = [sys.executable, str(ROOT / "tools" / "build.py"), "--platform", "linux-x64", "--blender", "5.1"]
    subprocess.run([*build, "--output", str(folder)], check=True, stdout=subprocess.DEVNULL)
    (path,) = folder.glob("*.zip")
    install = ["--command", "extension", "install-file", "-r", "user_default", "--enable", str(path)]
    done = call(tool, "background", *install, settings=settings)
    if done.returncode:
        raise WindowError(done.stdout + done.stderr)
    return settings


def main() -> int:
    """Take the pictures."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", nargs="*", choices=PICTURED, default=list(PICTURED), help="which pictures")
    arguments = parser.parse_args()
    try:
        tool = shared_blender()
    except NoSharedBlenderError as reason:
        print(f"The pictures need a Blender with a virtual screen: {reason}.", file=sys.stderr)
        return 1
    with tempfile.TemporaryDirectory(prefix="risorius-") as name:
        folder = Path(name)
        try:
            settings = installed(tool, folder)
            with Window(tool, settings, folder / "asked") as window:
                session = Session(window, folder)
                for key in arguments.only:
                    PICTURED[key](session)
        except WindowError as problem:
            print(problem, file=sys.stderr)
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
