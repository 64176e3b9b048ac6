"""What is installed is what the checkout holds: the wheel, the zip and the version."""

from __future__ import annotations

import importlib.util
import itertools
import os
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ("cli", "tables", "mpeg4", "physics", "face", "scene", "operators", "presets", "track")
SKIPPED_AT_ROOT = {"tests", "tools", "docs", "build", "dist", "out"}


def tool(name: str) -> ModuleType:
    """A script of tools/ as a module."""
    sys.path.insert(0, str(ROOT / "tools"))
    try:
        spec = importlib.util.spec_from_file_location(name, ROOT / "tools" / f"{name}.py")
        assert spec is not None
        assert spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        sys.modules.setdefault(name, module)
        spec.loader.exec_module(module)
    finally:
        sys.path.pop(0)
    return module


def product_files() -> set[str]:
    """Every file of the product in the checkout, relative to it: modules of the root, and all of the packages."""
    found = {path.name for path in ROOT.glob("*.py")}
    for folder in FOLDERS:
        found |= {
            path.relative_to(ROOT).as_posix()
            for path in (ROOT / folder).rglob("*")
            if path.is_file() and "__pycache__" not in path.parts and not path.name.startswith(".")
        }
    return found


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> set[str]:
    """The names in a wheel built from the checkout."""
    folder = tmp_path_factory.mktemp("wheel")
    build = [sys.executable, "-m", "pip", "wheel", "--no-deps", "--no-build-isolation", "--quiet", "-w", str(folder)]
    environment = {**os.environ, "PIP_DISABLE_PIP_VERSION_CHECK": "1"}
    # A copy is built, so that no build/ folder is left in the checkout.
    sources = folder / "sources"
    others = ("pyproject.toml", "README.md", "LICENSE", "blender_manifest.toml", "tools/version.py")
    for name in [*product_files(), *others]:
        (sources / name).parent.mkdir(parents=True, exist_ok=True)
        (sources / name).write_bytes((ROOT / name).read_bytes())
    done = subprocess.run([*build, str(sources)], capture_output=True, text=True, env=environment, check=False)
    assert done.returncode == 0, done.stderr
    (built,) = folder.glob("risorius-*.whl")
    with zipfile.ZipFile(built) as archive:
        return set(archive.namelist())


@pytest.fixture(scope="module")
def small_zip(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The extension without wheels."""
    folder = tmp_path_factory.mktemp("zip")
    build = tool("build")
    try:
        build.blender_extension_command()
    except build.BuildError as error:
        pytest.skip(str(error))
    assert build.main(["--no-wheels", "--output", str(folder)]) == 0
    (built,) = folder.glob("*.zip")
    return built


def test_wheel_holds_every_product_file(wheel: set[str]) -> None:
    expected = {f"risorius/{name}" for name in product_files()}
    packaged = {name for name in wheel if name.startswith("risorius/")}
    assert sorted(expected - packaged) == [], "add the package to pyproject.toml"
    assert sorted(packaged - expected - {"risorius/blender_manifest.toml"}) == []


def test_zip_holds_every_product_file_and_nothing_else(small_zip: Path) -> None:
    with zipfile.ZipFile(small_zip) as archive:
        names = set(archive.namelist())
    allowed = {"blender_manifest.toml", "LICENSE", "README.md", "CHANGELOG.md"}
    expected = {name for name in product_files() if not name.startswith("track/")}  # runs outside Blender
    assert sorted(expected - names) == []
    assert sorted(names - expected - allowed) == []


def test_zip_is_the_same_when_built_again(small_zip: Path, tmp_path: Path) -> None:
    assert tool("build").main(["--no-wheels", "--output", str(tmp_path)]) == 0
    assert (tmp_path / small_zip.name).read_bytes() == small_zip.read_bytes()


def test_version_has_one_place() -> None:
    version = tomllib.loads((ROOT / "blender_manifest.toml").read_text(encoding="utf-8"))["version"]
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert version == tool("version").VERSION
    assert "version" not in project
    changelog = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    assert f"## {version}" in changelog, "the changelog has no entry for this version"


def test_manifest_keeps_blenders_rules() -> None:
    manifest = tomllib.loads((ROOT / "blender_manifest.toml").read_text(encoding="utf-8"))
    texts = [manifest["tagline"], *manifest["permissions"].values()]
    assert all(len(text) <= 64 for text in texts)
    assert all(text[-1].isalnum() or text[-1] == ")" for text in texts)
    assert set(manifest["permissions"]) == {"files"}
    assert {".*", "__pycache__/", "/*.zip"} <= set(manifest["build"]["paths_exclude_pattern"])


def test_staged_manifest_names_its_wheels_and_range() -> None:
    build, wheels = tool("build"), tool("wheels")
    text = (ROOT / "blender_manifest.toml").read_text(encoding="utf-8")
    for blender in wheels.RANGES:
        for platform in wheels.PLATFORMS:
            names = [Path(f"scipy-1.0-cp{python.replace('.', '')}-x.whl") for python in blender.pythons]
            staged = tomllib.loads(build.staged_manifest(text, names, platform=platform, blender=blender))
            assert staged["wheels"] == [f"./wheels/{name}" for name in names]
            assert staged["platforms"] == [platform.name]
            assert staged["blender_version_min"] == blender.first
            assert staged.get("blender_version_max") == blender.end
            assert staged["build"] == tomllib.loads(text)["build"]


def test_ranges_cover_every_blender_without_overlap() -> None:
    ranges = tool("wheels").RANGES
    for one, next_one in itertools.pairwise(ranges):
        assert one.end == next_one.first
    assert ranges[-1].end is None
    manifest = tomllib.loads((ROOT / "blender_manifest.toml").read_text(encoding="utf-8"))
    assert ranges[0].first == manifest["blender_version_min"]


def test_report_of_a_run_counts_errors_as_failures(tmp_path: Path) -> None:
    runner = tool("test")
    report = tmp_path / "r.xml"
    report.write_text('<testsuites><testsuite tests="9" failures="1" errors="2" skipped="3"/></testsuites>')
    assert str(runner.read_report(report)) == "3 passed, 3 failed, 3 skipped"
