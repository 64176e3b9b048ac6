"""The Blender extension: one zip per system and Blender range, with SciPy inside, checked by Blender."""

from __future__ import annotations

import re
import shutil
import subprocess
import tempfile
import tomllib
import zipfile
from pathlib import Path

from environments import ENVIRONMENTS

from .contents import check_zip
from .sources import BuildError, copy_sources
from .wheels import BlenderRange, Platform

DATE = (1980, 1, 1, 0, 0, 0)  # of every file in a zip, so that building twice gives the same bytes

#: Bytes: what the extension site takes stays below this.
LARGEST = 100_000_000


def stage(folder: Path, wheels: list[Path], *, platform: Platform | None, blender: BlenderRange | None) -> None:
    """Fill `folder` with the sources, the wheels and the manifest that names them."""
    copy_sources(folder)
    for wheel in wheels:
        (folder / "wheels").mkdir(exist_ok=True)
        shutil.copyfile(wheel, folder / "wheels" / wheel.name)
    manifest = folder / "blender_manifest.toml"
    text = staged_manifest(manifest.read_text(encoding="utf-8"), wheels, platform=platform, blender=blender)
    manifest.write_text(text, encoding="utf-8")


def staged_manifest(
    text: str, wheels: list[Path], *, platform: Platform | None, blender: BlenderRange | None
) -> str:  # fmt: skip
    """The manifest with the wheels, the platform and the Blender range of one zip written into it."""
    lines = []
    if wheels:
        lines += ["wheels = [", *(f'  "./wheels/{wheel.name}",' for wheel in wheels), "]"]
    if platform:
        lines.append(f'platforms = ["{platform.name}"]')
    if blender:
        text, replaced = re.subn(r'(?m)^blender_version_min = ".*"$', f'blender_version_min = "{blender.first}"', text)
        if replaced != 1:
            raise BuildError("blender_manifest.toml: expected one line blender_version_min")
        if blender.end:
            lines.append(f'blender_version_max = "{blender.end}"')
    head, table, tail = text.partition("\n[")
    staged = head.rstrip("\n") + "\n" + "\n".join(lines) + "\n" + table + tail
    tomllib.loads(staged)
    return staged


def blender_extension_command() -> list[str]:
    """How to call Blender's own extension tool here: from a bpy environment, or a Blender on the PATH."""
    for environment in reversed(ENVIRONMENTS.values()):
        if environment.blender:
            found = sorted(environment.path.glob("[lL]ib/**/bl_pkg/cli/blender_ext.py"))
            if found:
                return [str(environment.python), str(found[-1])]
    if blender := shutil.which("blender"):
        return [blender, "--command", "extension"]
    raise BuildError(
        "Blender's extension tool is needed to build and check the zip: put a Blender 4.2 or later on the PATH, "
        "or run tools/environments.py blender"
    )


def valid_tags(command: list[str]) -> list[str]:
    """The options that make the tool check the manifest's tags against Blender's list (bare script only)."""
    if "--command" in command:
        return []
    scripts = Path(command[-1]).parents[3]
    return ["--valid-tags", str(scripts / "modules" / "_bpy_internal" / "extensions" / "tags.py")]


def build_zip(target: Path, wheels: list[Path], *, platform: Platform | None, blender: BlenderRange | None) -> Path:
    """Build and check one zip at `target`.

    Raises
    ------
    BuildError
        Blender's tool refuses the extension, a wheel is missing or for another system or Python, or the zip is larger
        than the extension site takes.
    """
    command = blender_extension_command()
    target.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        source, raw = Path(scratch) / "source", Path(scratch) / "raw.zip"
        source.mkdir()
        stage(source, wheels, platform=platform, blender=blender)
        run([*command, "build", *valid_tags(command), "--source-dir", str(source), "--output-filepath", str(raw)])
        repack(raw, target)
    run([*command, "validate", *valid_tags(command), str(target)])
    if platform and blender:
        check_zip(target, platform, blender)
    size = target.stat().st_size
    if size >= LARGEST:
        raise BuildError(f"{target}: {size / 1e6:.0f} MB; the extension site takes less than {LARGEST / 1e6:.0f} MB")
    return target


def run(command: list[str]) -> None:
    """Run Blender's tool; its output is shown only when it refuses."""
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise BuildError(f"Blender refuses the extension:\n{done.stdout}{done.stderr}")


def repack(raw: Path, target: Path) -> None:
    """Write `raw` again as `target` with sorted names and fixed dates; wheels are compressed already."""
    with zipfile.ZipFile(raw) as old, zipfile.ZipFile(target, "w") as new:
        for name in sorted(old.namelist()):
            if name.endswith("/"):
                continue
            entry = zipfile.ZipInfo(name, DATE)
            entry.external_attr = 0o644 << 16
            entry.compress_type = zipfile.ZIP_STORED if name.endswith(".whl") else zipfile.ZIP_DEFLATED
            new.writestr(entry, old.read(name))
