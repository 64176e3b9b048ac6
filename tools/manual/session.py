"""One window in which pictures are taken one after another, with the built extension installed."""

from __future__ import annotations

import subprocess
import sys
import time
from pathlib import Path

from places import DOCS, ROOT, shared_folder
from window.driver import Window, WindowError, call

PICTURES = DOCS / "pictures"
#: Quality of the JPEG files, and seconds for the window to draw what was changed.
QUALITY, DRAWN = 85, 1.5

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
        shot = self.shot(name)
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

    def shot(self, name: str) -> Path:
        """The whole window, as a PNG in the folder. Panels that open slide there first."""
        for _ in range(2):
            time.sleep(DRAWN)
            self.run("bpy.ops.wm.redraw_timer(type='DRAW_WIN_SWAP', iterations=3)")
        return self.window.shot(self.folder / f"{name}.png")

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
