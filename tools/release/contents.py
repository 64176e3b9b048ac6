"""What a built zip holds, against the system and the Pythons that it is for: Blender itself checks neither."""

from __future__ import annotations

import io
import tomllib
import zipfile
from collections.abc import Iterator
from dataclasses import dataclass
from email.parser import HeaderParser
from pathlib import Path

from .sources import BuildError
from .wheels import BlenderRange, Platform

#: Distributions that each zip with wheels holds: those for one Python, and those for any.
FOR_EACH_PYTHON, FOR_ANY = {"scipy"}, {"espeakng_loader", "praatio", "typing_extensions"}
#: First bytes of a compiled module, and where in it the processor stands: offset, value. By Blender's names of systems.
MACHO, ELF = b"\xcf\xfa\xed\xfe", b"\x7fELF\x02\x01"
#: First bytes of a library for several processors of macOS, and the length of its entry for each.
SEVERAL, ENTRY = b"\xca\xfe\xba\xbe", 20
COMPILED = {
    "linux-x64": (ELF, 18, b"\x3e\x00"),
    "macos-arm64": (MACHO, 4, b"\x0c\x00\x00\x01"),
    "macos-x64": (MACHO, 4, b"\x07\x00\x00\x01"),
    "windows-x64": (b"MZ", -1, b"PE\x00\x00\x64\x86"),
    "windows-arm64": (b"MZ", -1, b"PE\x00\x00\x64\xaa"),
}
#: Endings of compiled modules and libraries.
NATIVE = (".so", ".dylib", ".dll", ".pyd")


@dataclass(frozen=True)
class WheelName:
    """The parts of a wheel's file name: distribution, and its tags as sets."""

    distribution: str
    pythons: frozenset[str]
    abis: frozenset[str]
    platforms: frozenset[str]

    @classmethod
    def of(cls, name: str) -> WheelName:
        """Read a file name as `scipy-1.15.3-cp311-cp311-win_amd64.whl`."""
        parts = name.removesuffix(".whl").split("-")
        if not name.endswith(".whl") or len(parts) not in (5, 6):
            raise BuildError(f"{name}: is no wheel's name")
        return cls(parts[0], *(frozenset(tags.split(".")) for tags in parts[-3:]))


def check_zip(path: Path, platform: Platform, blender: BlenderRange) -> None:
    """Check a built zip.

    Raises
    ------
    BuildError : its manifest names another system or range, a wheel is missing, is for something else or not named.
    """
    with zipfile.ZipFile(path) as archive:
        faults = [*_faults_of_manifest(archive, platform, blender), *_faults_of_wheels(archive, platform, blender)]
    if faults:
        raise BuildError("\n".join(f"{path.name}: {fault}" for fault in faults))


def _faults_of_manifest(archive: zipfile.ZipFile, platform: Platform, blender: BlenderRange) -> Iterator[str]:
    """What the manifest says wrongly."""
    manifest = tomllib.loads(archive.read("blender_manifest.toml").decode())
    expected = {"platforms": [platform.name], "blender_version_min": blender.first, "blender_version_max": blender.end}
    for name, value in expected.items():
        if manifest.get(name) != value:
            yield f"the manifest's {name} is {manifest.get(name)!r}, not {value!r}"
    held = sorted(f"./{name}" for name in archive.namelist() if name.endswith(".whl"))
    if sorted(manifest.get("wheels", [])) != held:
        yield f"the manifest's wheels are not those in the zip: {held}"


def _faults_of_wheels(archive: zipfile.ZipFile, platform: Platform, blender: BlenderRange) -> Iterator[str]:
    """What is wrong with the wheels, and which are missing."""
    wheels = {name: WheelName.of(Path(name).name) for name in archive.namelist() if name.endswith(".whl")}
    pythons = {f"cp{python.replace('.', '')}" for python in blender.pythons}
    for distribution in sorted(FOR_EACH_PYTHON):
        its_own = [wheel for wheel in wheels.values() if wheel.distribution == distribution]
        found = sorted(python for wheel in its_own for python in wheel.pythons)
        if found != sorted(pythons):
            yield f"{distribution} is for {found}, not for {sorted(pythons)}"
    if missing := FOR_ANY - {wheel.distribution for wheel in wheels.values()}:
        yield f"no wheel of {sorted(missing)}"
    for name, wheel in wheels.items():
        if "py3" not in wheel.pythons and not wheel.abis == wheel.pythons <= pythons:
            yield f"{name} is for Python {sorted(wheel.pythons)}, not for {sorted(pythons)}"
        if not wheel.platforms & {*platform.tags, "any"}:
            yield f"{name} is for {sorted(wheel.platforms)}, not for {platform.name}"
        yield from (f"{name} {fault}" for fault in _faults_inside(archive.read(name), wheel, platform))


def _faults_inside(data: bytes, wheel: WheelName, platform: Platform) -> Iterator[str]:
    """What a wheel holds against its name: tags of its own, and modules of another system or processor."""
    with zipfile.ZipFile(io.BytesIO(data)) as held:
        (told,) = (name for name in held.namelist() if name.endswith(".dist-info/WHEEL") and name.count("/") == 1)
        tags = HeaderParser().parsestr(held.read(told).decode()).get_all("Tag", [])
        pythons, _, platforms = zip(*(tag.split("-") for tag in tags), strict=True)
        if set(platforms) != wheel.platforms or not set(pythons) & wheel.pythons:
            yield f"holds the tags {sorted(tags)}"
        natives = [name for name in held.namelist() if name.endswith(NATIVE)]
        if bool(natives) != (wheel.platforms != {"any"}):
            yield f"holds {len(natives)} compiled modules"
        odd = [name for name in natives if not _runs_on(held.read(name), platform.name)]
        if odd:
            yield f"holds what does not run on {platform.name}: {odd[0]}"


def _runs_on(module: bytes, platform: str) -> bool:
    """Whether the beginning of a compiled module is that of a system and processor."""
    magic, offset, processor = COMPILED[platform]
    if magic == MACHO and module.startswith(SEVERAL):
        count = int.from_bytes(module[4:8], "big")
        return processor[::-1] in {module[8 + ENTRY * index : 12 + ENTRY * index] for index in range(count)}
    if offset < 0:  # Windows: where its header is stands at 60
        offset = int.from_bytes(module[60:64], "little")
    return module.startswith(magic) and module[offset : offset + len(processor)] == processor
