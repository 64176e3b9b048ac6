"""Set up the Python environments of this checkout: one to develop in, and one per Blender (the `bpy` module).

    python3.11 tools/environments.py NAME [NAME ...]

makes what is missing of dev, track, bpy-4.2, bpy-4.5 and bpy-5.0 (`all`: each of them) and leaves what is up to date.
Needs only Python 3.11's own library.
"""

from __future__ import annotations

import hashlib
import json
import shutil
import subprocess
import sys
import tomllib
import venv
from dataclasses import dataclass
from pathlib import Path

from places import ROOT
from system_libraries import MissingLibraries, ensure_system_libraries


@dataclass(frozen=True)
class Environment:
    """One virtual environment: its folder in the checkout and what `pip install` puts there."""

    folder: str
    requirements: tuple[str, ...]
    blender: bool

    @property
    def path(self) -> Path:
        """The environment's folder."""
        return ROOT / self.folder

    @property
    def python(self) -> Path:
        """The environment's interpreter."""
        return self.path / ("Scripts/python.exe" if sys.platform == "win32" else "bin/python")

    def fingerprint(self) -> str:
        """What the environment's packages were chosen by: when this changes, pip runs again."""
        project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
        chosen = [self.requirements, str(ROOT), sys.version, project["project"], project["tool"]["setuptools"]]
        return hashlib.sha256(json.dumps(chosen, sort_keys=True).encode()).hexdigest()


# NumPy is what the official Blender of that version brings; SciPy is the newest that runs on it.
ENVIRONMENTS = {
    "dev": Environment(".venv", ("-e", ".[dev]"), blender=False),
    "track": Environment(".venv-track", ("-e", ".[test,track]", "scikit-image"), blender=False),
    "bpy-4.2": Environment(
        ".venv-bpy-4.2", ("-e", ".[test]", "bpy~=4.2.0", "numpy==1.24.3", "scipy<1.16"), blender=True
    ),
    "bpy-4.5": Environment(
        ".venv-bpy-4.5", ("-e", ".[test]", "bpy~=4.5.0", "numpy==1.26.4", "scipy<1.16"), blender=True
    ),
    "bpy-5.0": Environment(
        ".venv-bpy-5.0", ("-e", ".[test]", "bpy~=5.0.1", "numpy==1.26.4", "scipy<1.16"), blender=True
    ),
}


class SetUpError(Exception):
    """What stopped the setting up, and what to do about it."""


def ensure(name: str) -> Environment:
    """Make the named environment, or leave it where it is up to date.

    Raises
    ------
    SetUpError
        when the environment cannot be made; the message says what to do.
    """
    environment = ENVIRONMENTS[name]
    if environment.blender:
        try:
            ensure_system_libraries()
        except MissingLibraries as missing:
            raise SetUpError(str(missing)) from missing
    stamp = environment.path / ".risorius"
    if stamp.exists() and stamp.read_text(encoding="utf-8") == environment.fingerprint():
        return environment
    if sys.version_info[:2] != (3, 11):
        raise SetUpError(f"{sys.executable} is Python {sys.version.split()[0]}; Risorius is set up with Python 3.11")
    print(f"Setting up {environment.folder} ({name}) ...", flush=True)
    if not _fits(environment):
        _create(environment)
    _install(environment)
    stamp.write_text(environment.fingerprint(), encoding="utf-8")
    return environment


def ensure_link() -> Path:
    """Make `.typecheck/risorius`, a link to the checkout under the package's name, and return `.typecheck`."""
    folder = ROOT / ".typecheck"
    folder.mkdir(exist_ok=True)
    link = folder / "risorius"
    if not link.exists():
        link.unlink(missing_ok=True)
        link.symlink_to("..", target_is_directory=True)
    return folder


def _fits(environment: Environment) -> bool:
    """Whether the environment's folder holds a Python of this very version, made at this very place."""
    settings = environment.path / "pyvenv.cfg"
    if not settings.exists() or not environment.python.exists():
        return False
    version = ".".join(map(str, sys.version_info[:3]))
    lines = settings.read_text(encoding="utf-8").splitlines()
    return f"version = {version}" in lines and any(line.endswith(f" {environment.path}") for line in lines)


def _create(environment: Environment) -> None:
    """Make the empty environment with pip in it."""
    shutil.rmtree(environment.path, ignore_errors=True)
    try:
        venv.create(environment.path, with_pip=True, symlinks=sys.platform != "win32")
    except (subprocess.CalledProcessError, OSError) as error:
        shutil.rmtree(environment.path, ignore_errors=True)
        raise SetUpError(
            f"{sys.executable} cannot make a virtual environment ({error}).\n"
            "On Debian and Ubuntu: apt-get install python3.11-venv"
        ) from error


def _install(environment: Environment) -> None:
    """Install the requirements; pip shows its downloads and keeps them in its own cache."""
    command = [environment.python, "-m", "pip", "install", "--disable-pip-version-check"]
    command += [] if sys.stdout.isatty() else ["--progress-bar=off"]
    done = subprocess.run([*map(str, command), *environment.requirements], cwd=ROOT, check=False)
    if done.returncode:
        raise SetUpError(
            f"pip could not fill {environment.folder} (its message is above). "
            "It needs the network the first time; run the command again once that is mended."
        )


def main(names: list[str]) -> int:
    """Set up the named environments; 0 when all stand."""
    unknown = [name for name in names if name not in {"all", *ENVIRONMENTS}]
    if unknown or not names:
        print(f"usage: environments.py all | {' | '.join(ENVIRONMENTS)}", file=sys.stderr)
        return 2
    try:
        for name in ENVIRONMENTS if "all" in names else names:
            ensure(name)
        ensure_link()
    except SetUpError as error:
        print(f"\nSet-up stopped: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
