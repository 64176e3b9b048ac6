"""Build the installable extension: one zip per system and Blender range, with SciPy inside, checked by Blender.

    .venv/bin/python tools/build.py [--platform linux-x64] [--blender 5.1] [--no-wheels] [--output dist]

Without filters every zip is built. `--no-wheels` builds one small zip for Blenders whose Python has SciPy already
(those of Linux distributions). The same sources give the same bytes.
"""

from __future__ import annotations

import argparse
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
import zipfile
from collections.abc import Iterator
from pathlib import Path

from environments import ENVIRONMENTS, ROOT
from version import VERSION
from wheels import PLATFORMS, RANGES, BlenderRange, DownloadError, Platform, fetch

WHEELS = ROOT / ".cache" / "wheels"
DATE = (1980, 1, 1, 0, 0, 0)  # of every file in a zip, so that building twice gives the same bytes
GENERATED = {"build", "dist", "out"}


class BuildError(Exception):
    """Why a zip could not be built."""


def source_files() -> list[Path]:
    """The files of the checkout, relative to it: what git tracks or would, or all but hidden ones without git.

    Which of them belong in the extension is said by the manifest's own exclusions alone.
    """
    listing = ["git", "ls-files", "--cached", "--others", "--exclude-standard", "-z"]
    done = subprocess.run(listing, cwd=ROOT, capture_output=True, check=False)
    if done.returncode == 0:
        names = [Path(name) for name in done.stdout.decode().split("\0") if name]
    else:
        names = [path.relative_to(ROOT) for path in ROOT.rglob("*") if path.is_file()]
        names = [name for name in names if name.parts[0] not in GENERATED and "__pycache__" not in name.parts]
    visible = (name for name in names if not any(part.startswith(".") for part in name.parts))
    return sorted(name for name in visible if (ROOT / name).is_file())


def stage(folder: Path, wheels: list[Path], *, platform: Platform | None, blender: BlenderRange | None) -> None:
    """Fill `folder` with the sources, the wheels and the manifest that names them."""
    for name in source_files():
        target = folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(ROOT / name, target)
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
                return [sys.executable, str(found[-1])]
    if blender := shutil.which("blender"):
        return [blender, "--command", "extension"]
    raise BuildError(
        "Blender's extension tool is needed to build and check the zip: put a Blender 4.2 or later on the PATH, "
        "or run tools/environments.py bpy-4.5"
    )


def valid_tags(command: list[str]) -> list[str]:
    """The options that make the tool check the manifest's tags against Blender's list (bare script only)."""
    if "--command" in command:
        return []
    scripts = Path(command[-1]).parents[3]
    return ["--valid-tags", str(scripts / "modules" / "_bpy_internal" / "extensions" / "tags.py")]


def build(target: Path, wheels: list[Path], *, platform: Platform | None, blender: BlenderRange | None) -> Path:
    """Build and check one zip at `target`.

    Raises
    ------
    BuildError
        when Blender's tool refuses the extension; what it said is printed.
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


def targets(arguments: argparse.Namespace) -> Iterator[tuple[str, Platform | None, BlenderRange | None]]:
    """The zips asked for: file name, system, Blender range."""
    if arguments.no_wheels:
        yield f"risorius-{VERSION}-no-wheels.zip", None, None
        return
    for blender in RANGES:
        for platform in PLATFORMS:
            if arguments.platform in (None, platform.name) and arguments.blender in (None, blender.name):
                yield f"risorius-{VERSION}-blender{blender.name}-{platform.name}.zip", platform, blender


def main(argv: list[str] | None = None) -> int:
    """Build what the options ask for; 0 when every zip was built and passed Blender's check."""
    parser = argparse.ArgumentParser(description="Build the installable extension.")
    parser.add_argument("--platform", choices=[platform.name for platform in PLATFORMS], help="only this system")
    parser.add_argument("--blender", choices=[blender.name for blender in RANGES], help="only from this Blender on")
    parser.add_argument("--no-wheels", action="store_true", help="one zip without SciPy")
    parser.add_argument("--output", type=Path, default=ROOT / "dist", help="folder of the zips (default: dist)")
    arguments = parser.parse_args(argv)
    try:
        for name, platform, blender in targets(arguments):
            wheels = fetch(platform, blender, WHEELS) if platform and blender else []
            path = build(arguments.output / name, wheels, platform=platform, blender=blender)
            print(f"{path}  {path.stat().st_size / 1e6:.1f} MB, valid", flush=True)
    except (BuildError, DownloadError) as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
