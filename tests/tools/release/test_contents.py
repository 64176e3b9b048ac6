"""What a zip holds is checked against its system and Pythons: each fault that could be is found and named."""

from __future__ import annotations

import io
import zipfile
from pathlib import Path

import pytest
from release.contents import COMPILED, NATIVE, WheelName, check_zip
from release.sources import BuildError
from release.wheels import PLATFORMS, RANGES
from release.zips import staged_manifest

WINDOWS = next(platform for platform in PLATFORMS if platform.name == "windows-x64")
NEWER = RANGES[-1]
MANIFEST = 'blender_version_min = "4.2.0"\n\n[permissions]\nfiles = "Read"\n'
GOOD = (
    "scipy-1.17.1-cp313-cp313-win_amd64.whl",
    "scipy-1.17.1-cp314-cp314-win_amd64.whl",
    "espeakng_loader-0.2.4-py3-none-win_amd64.whl",
    "praatio-6.2.2-py3-none-any.whl",
    "typing_extensions-4.16.0-py3-none-any.whl",
)


def module(platform: str) -> bytes:
    """The beginning of a compiled module of a system and processor."""
    magic, offset, processor = COMPILED[platform]
    data = bytearray(256)
    data[: len(magic)] = magic
    if offset < 0:
        offset, data[60:64] = 128, (128).to_bytes(4, "little")
    data[offset : offset + len(processor)] = processor
    return bytes(data)


def wheel(name: str, *, holds: str = "windows-x64", tag: str = "") -> bytes:
    """A wheel with the tags of its name, and a compiled module where it is for a system."""
    parts, data = WheelName.of(name), io.BytesIO()
    with zipfile.ZipFile(data, "w") as archive:
        tags = [tag] if tag else [f"{p}-{a}-{s}" for p in parts.pythons for a in parts.abis for s in parts.platforms]
        archive.writestr("x-1.dist-info/WHEEL", "".join(f"Tag: {each}\n" for each in tags))
        if "any" not in parts.platforms:
            archive.writestr(f"x/x{NATIVE[-1]}", module(holds))
    return data.getvalue()


def zipped(folder: Path, wheels: dict[str, bytes], *, manifest: str = "") -> Path:
    """A zip of these wheels, named in its manifest."""
    path = folder / "risorius.zip"
    told = staged_manifest(MANIFEST, [Path(name) for name in wheels], platform=WINDOWS, blender=NEWER)
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("blender_manifest.toml", manifest or told)
        for name, data in wheels.items():
            archive.writestr(f"wheels/{name}", data)
    return path


def test_a_good_zip_passes(tmp_path: Path) -> None:
    check_zip(zipped(tmp_path, {name: wheel(name) for name in GOOD}), WINDOWS, NEWER)


@pytest.mark.parametrize(
    ("wrong", "instead", "said"),
    [
        (GOOD[0], "scipy-1.17.1-cp313-cp313-win_arm64.whl", "not for windows-x64"),
        (GOOD[0], "scipy-1.17.1-cp313-cp313-macosx_12_0_arm64.whl", "not for windows-x64"),
        (GOOD[0], "scipy-1.15.3-cp311-cp311-win_amd64.whl", r"not for \['cp313', 'cp314'\]"),
        (GOOD[0], GOOD[1].replace("1.17.1", "1.16.3"), r"scipy is for \['cp314', 'cp314'\]"),
        (GOOD[0], "scipy-1.17.1-cp313-cp313t-win_amd64.whl", "is for Python"),
        (GOOD[1], None, r"scipy is for \['cp313'\]"),
        (GOOD[2], None, r"no wheel of \['espeakng_loader'\]"),
        (GOOD[2], "espeakng_loader-0.2.4-py3-none-manylinux_2_17_x86_64.whl", "not for windows-x64"),
        (GOOD[3], "praatio.whl", "is no wheel's name"),
    ],
)
def test_a_wrong_wheel_is_named(tmp_path: Path, wrong: str, instead: str | None, said: str) -> None:
    wheels = {name: wheel(name) for name in GOOD if name != wrong}
    if instead == "praatio.whl":
        wheels[instead] = wheels[GOOD[4]]
    elif instead is not None:
        wheels[instead] = wheel(instead)
    with pytest.raises(BuildError, match=said):
        check_zip(zipped(tmp_path, wheels), WINDOWS, NEWER)


@pytest.mark.parametrize("holds", ["linux-x64", "macos-arm64", "windows-arm64"])
def test_a_module_of_another_system_in_a_wheel_is_named(tmp_path: Path, holds: str) -> None:
    wheels = {name: wheel(name) for name in GOOD} | {GOOD[0]: wheel(GOOD[0], holds=holds)}
    with pytest.raises(BuildError, match="does not run on windows-x64"):
        check_zip(zipped(tmp_path, wheels), WINDOWS, NEWER)


def test_a_wheel_that_was_renamed_is_named(tmp_path: Path) -> None:
    wheels = {name: wheel(name) for name in GOOD} | {GOOD[0]: wheel(GOOD[0], tag="cp312-cp312-win_amd64")}
    with pytest.raises(BuildError, match="holds the tags"):
        check_zip(zipped(tmp_path, wheels), WINDOWS, NEWER)


@pytest.mark.parametrize(
    ("text", "instead", "said"),
    [
        ("windows-x64", "linux-x64", "platforms"),
        ("5.1.0", "4.2.0", "blender_version_min"),
        ('  "./wheels/praatio-6.2.2-py3-none-any.whl",\n', "", "wheels are not those"),
    ],
)
def test_a_manifest_that_says_otherwise_is_named(tmp_path: Path, text: str, instead: str, said: str) -> None:
    told = staged_manifest(MANIFEST, [Path(name) for name in GOOD], platform=WINDOWS, blender=NEWER)
    assert text in told
    path = zipped(tmp_path, {name: wheel(name) for name in GOOD}, manifest=told.replace(text, instead))
    with pytest.raises(BuildError, match=said):
        check_zip(path, WINDOWS, NEWER)
