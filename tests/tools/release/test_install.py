"""The built zip, installed in this Blender as a user would: enable, bake, unregister. Runs in the bpy module."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from places import ROOT

bpy = pytest.importorskip("bpy", reason="needs the bpy module")

pytestmark = [pytest.mark.smoke, pytest.mark.slow]

#: The zip for this Blender.
RANGE = "5.1" if bpy.app.version >= (5, 1) else "4.2"

# Runs in an interpreter of its own, with an empty settings folder. SciPy may come from the extension's wheel alone.
SCRIPT = '''
import importlib, importlib.machinery, json, sys

class OnlyFromExtension:
    """Finds SciPy in the folder of the extensions' wheels and nowhere else."""
    def find_spec(self, name, path=None, target=None):
        if name != "scipy":
            return None
        places = [place for place in sys.path if place.startswith(sys.argv[2])]
        found = importlib.machinery.PathFinder.find_spec(name, places)
        if found is None:
            raise ModuleNotFoundError(name, name=name)
        return found

sys.meta_path.insert(0, OnlyFromExtension())
import bpy

def registered():
    """Everything of Risorius that Blender knows of."""
    names = [name for name in dir(bpy.types) if "risorius" in name.lower()]
    names += [f"Object.{key}" for key in bpy.types.Object.bl_rna.properties.keys() if "risorius" in key]
    names += [f"Scene.{key}" for key in bpy.types.Scene.bl_rna.properties.keys() if "risorius" in key]
    return names

said = {"before": registered()}
bpy.ops.extensions.package_install_files(filepath=sys.argv[1], repo="user_default", enable_on_install=True)
module = "bl_ext.user_default.risorius"
said["registered"] = registered()
import scipy
said["scipy"] = scipy.__file__
bpy.ops.risorius.add_head()
head = bpy.context.object
said["bake"] = sorted(bpy.ops.risorius.bake_expression())
said["keys"] = [key.name for key in head.data.shape_keys.key_blocks]
said["animated"] = head.data.shape_keys.animation_data.action is not None
for _ in range(2):
    bpy.ops.preferences.addon_disable(module=module)
    said["after"] = registered()
    bpy.ops.preferences.addon_enable(module=module)
    said["again"] = registered()
bpy.ops.preferences.addon_disable(module=module)
said["keys_after"] = [key.name for key in head.data.shape_keys.key_blocks]
print("said", json.dumps(said))
'''


def built_zip(folder: Path, *options: str) -> Path:
    """A zip for this Blender and system, built by the project's own tool."""
    build = [sys.executable, str(ROOT / "tools" / "build.py"), *options, "--output", str(folder)]
    done = subprocess.run(build, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    (path,) = folder.glob("*.zip")
    return path


@pytest.fixture(scope="module")
def installed(tmp_path_factory: pytest.TempPathFactory) -> dict[str, object]:
    """What the script above saw."""
    if not sys.platform.startswith("linux"):
        pytest.skip("the zip is built for Linux here")
    folder = tmp_path_factory.mktemp("installed")
    path = built_zip(folder / "zip", "--platform", "linux-x64", "--blender", RANGE)
    settings = folder / "settings"
    settings.mkdir()
    run = [sys.executable, "-I", "-c", SCRIPT, str(path), str(settings)]
    environment = {**os.environ, "BLENDER_USER_RESOURCES": str(settings)}
    done = subprocess.run(run, capture_output=True, text=True, env=environment, timeout=300, check=False)
    lines = [line for line in done.stdout.splitlines() if line.startswith("said ")]
    assert lines, done.stdout + done.stderr
    said: dict[str, object] = json.loads(lines[-1].removeprefix("said "))
    said["settings"] = str(settings)
    with zipfile.ZipFile(path) as archive:
        said["wheels"] = [name for name in archive.namelist() if name.endswith(".whl")]
    return said


def test_zip_brings_scipy_and_what_speech_needs_and_never_numpy(installed: dict[str, object]) -> None:
    assert str(installed["scipy"]).startswith(str(installed["settings"]))
    wheels = installed["wheels"]
    assert isinstance(wheels, list)
    brought = {name.split("/")[-1].split("-")[0] for name in wheels}
    assert brought == {"scipy", "praatio", "typing_extensions", "espeakng_loader"}


def test_installed_extension_bakes(installed: dict[str, object]) -> None:
    assert installed["bake"] == ["FINISHED"]
    assert len(installed["keys"]) > 1  # type: ignore[arg-type]
    assert installed["animated"]


def test_unregister_leaves_blender_as_found_and_the_bake_in_place(installed: dict[str, object]) -> None:
    assert installed["before"] == installed["after"] == []
    assert installed["registered"] == installed["again"] != []
    assert installed["keys_after"] == installed["keys"]
