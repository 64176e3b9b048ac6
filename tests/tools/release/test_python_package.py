"""The package for plain Python: a source distribution, a wheel from it, and both at work in a clean environment."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import sysconfig
import tarfile
import venv
import zipfile
from email.parser import Parser
from pathlib import Path

import pytest
from release.python_package import build_python_package
from release.sources import VERSION

pytestmark = pytest.mark.slow

POSE = """
import json, sys
import risorius, risorius.api as api
face = api.default_face()
pose = face.pose(api.expression("joy").frame())
moved = abs(pose.positions - face.vertices).max()
print(json.dumps({"file": risorius.__file__, "moved": float(moved), "blender": "bpy" in sys.modules}))
"""


def run(*command: str | Path, folder: Path) -> str:
    """What a command prints, run away from the checkout."""
    own = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    done = subprocess.run([*map(str, command)], cwd=folder, env=own, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def clean(python_package: tuple[Path, Path], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A new environment with the wheel in it, and of this Python's packages nothing but what the wheel requires."""
    place = tmp_path_factory.mktemp("clean")
    venv.create(place / "venv", symlinks=sys.platform != "win32")
    python = place / "venv" / ("Scripts/python.exe" if sys.platform == "win32" else "bin/python")
    install = ["install", "--quiet", "--no-deps", "--no-index", str(python_package[1])]
    run(sys.executable, "-m", "pip", "--python", python, *install, folder=place)
    site = Path(run(python, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))", folder=place).strip())
    for name in ("numpy", "scipy"):
        for found in Path(sysconfig.get_path("purelib")).glob(f"{name}*"):
            (site / found.name).symlink_to(found)
    return python


def test_wheel_of_the_source_distribution_holds_every_product_file(
    python_package: tuple[Path, Path], product: frozenset[str]
) -> None:
    with zipfile.ZipFile(python_package[1]) as archive:
        packaged = {name.removeprefix("risorius/") for name in archive.namelist() if name.startswith("risorius/")}
    assert sorted(product - packaged) == []
    assert sorted(packaged - product) == []


def test_source_distribution_holds_what_building_needs_and_no_tests(
    python_package: tuple[Path, Path], product: frozenset[str]
) -> None:
    with tarfile.open(python_package[0]) as archive:
        names = {name.partition("/")[2] for name in archive.getnames()}
    assert product | {"setup.py", "pyproject.toml", "README.md", "CHANGELOG.md", "LICENSE"} <= names
    assert not [name for name in names if name.startswith(("tests/", "tools/", "docs/"))]


def test_metadata_say_what_an_index_shows(python_package: tuple[Path, Path]) -> None:
    with zipfile.ZipFile(python_package[1]) as archive:
        (name,) = (name for name in archive.namelist() if name.endswith(".dist-info/METADATA"))
        metadata = Parser().parsestr(archive.read(name).decode())
    assert (metadata["Name"], metadata["Version"]) == ("risorius", VERSION)
    assert metadata["Author"] == "Risorius developers"
    assert metadata["License-Expression"] == "GPL-3.0-or-later"
    assert metadata.get_all("License-File") == ["LICENSE", "presets/heads/NOTICE-ICT-FaceKit.txt"]
    assert {"Typing :: Typed", "Programming Language :: Python :: 3.13"} <= set(metadata.get_all("Classifier") or ())
    required = [line for line in metadata.get_all("Requires-Dist") or () if "extra ==" not in line]
    assert [line.partition(">")[0] for line in required] == ["numpy", "scipy", "praatio"]


def test_installed_wheel_poses_a_face_without_the_checkout(clean: Path, tmp_path: Path) -> None:
    said = json.loads(run(clean, "-c", POSE, folder=tmp_path))
    assert Path(said["file"]).is_relative_to(clean.parents[1])
    assert said["moved"] > 1e-3
    assert not said["blender"]


def test_installed_command_answers(clean: Path, tmp_path: Path) -> None:
    command = clean.with_name("risorius" + clean.suffix)
    said = json.loads(run(command, "profile", "joy", "--json", folder=tmp_path))
    as_module = json.loads(run(clean, "-m", "risorius", "profile", "joy", "--json", folder=tmp_path))
    assert said == as_module
    assert said["ranges"]


def test_wheel_is_the_same_when_built_again(python_package: tuple[Path, Path], tmp_path: Path) -> None:
    assert build_python_package(tmp_path)[1].read_bytes() == python_package[1].read_bytes()
