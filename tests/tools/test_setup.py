"""Setting up: which Python is found, what is said where something is missing, and that a broken-off set-up heals."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import environments
import pytest
import system_libraries
from environments import ANY_BLENDER, ENVIRONMENTS, NoPythonError, SetUpError
from places import ROOT

FIND = ROOT / "tools" / "find_python.sh"


@pytest.fixture
def bare_path(tmp_path: Path) -> Path:
    """A PATH with the shell's own tools and nothing to run Python with."""
    folder = tmp_path / "bin"
    folder.mkdir()
    for name in ("sh", "sed", "cat", "env", "tail"):
        found = shutil.which(name)
        assert found is not None
        (folder / name).symlink_to(found)
    return folder


def find(path: Path, *versions: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run find_python.sh with this PATH."""
    variables = {"PATH": str(path), **environment}
    return subprocess.run(["/bin/sh", str(FIND), *versions], env=variables, capture_output=True, text=True, check=False)


def command(folder: Path, name: str, script: str) -> str:
    """Put a command of this name on the PATH; its path."""
    (folder / name).write_text(f"#!/bin/sh\n{script}\n")
    (folder / name).chmod(0o755)
    return str(folder / name)


# ---- which Python ---------------------------------------------------------------------------------------------


def test_without_any_python_it_says_what_will_do(bare_path: Path) -> None:
    done = find(bare_path)
    assert done.returncode == 1
    assert done.stdout == ""
    for thing in ("no Python 3.11, 3.13, 3.12 or 3.14.", "Python 3.11 on the PATH", "uv", "Blender 4.2"):
        assert thing in done.stderr
    assert "no Python 3.13." in find(bare_path, "3.13").stderr


@pytest.mark.parametrize("version", ["3.11", "3.12", "3.13", "3.14"])
def test_any_python_that_risorius_runs_on_will_do(version: str, bare_path: Path) -> None:
    python = command(bare_path, "python3", f"echo {version}")
    assert find(bare_path).stdout.strip() == python
    assert find(bare_path, PYTHON=python).stdout.strip() == python


def test_those_that_have_a_blender_come_first(bare_path: Path) -> None:
    command(bare_path, "python3", "echo 3.14")
    for version in ("3.12", "3.13", "3.11"):
        python = command(bare_path, f"python{version}", f"echo {version}")
        assert find(bare_path).stdout.strip() == python
    assert find(bare_path, "3.14", "3.12").stdout.strip() == str(bare_path / "python3")


def test_an_older_python_and_a_command_that_does_not_run_are_not_taken(bare_path: Path) -> None:
    command(bare_path, "python3", "echo 3.10")
    command(bare_path, "python3.13", "echo 'pyenv: command not found' >&2; exit 127")
    assert find(bare_path).returncode == 1
    refused = find(bare_path, PYTHON=str(bare_path / "python3"))
    assert refused.returncode == 1
    assert "no Python 3.11 to 3.14" in refused.stderr


def test_a_python_given_by_hand_serves_where_it_is_of_the_version(bare_path: Path, tmp_path: Path) -> None:
    python = command(tmp_path, "mine", "echo 3.12")
    other = command(bare_path, "python3.11", "echo 3.11")
    assert find(bare_path, PYTHON=python).stdout.strip() == python
    assert find(bare_path, "3.11", PYTHON=python).stdout.strip() == other


@pytest.mark.parametrize(
    ("name", "script"),
    [
        ("pyenv", 'case "$PYENV_VERSION $*" in " whence python3.13") echo 3.13.0;; "3.13.0 which "*) echo {}; esac'),
        ("uv", '[ "$1 $2" = "python find" ] && [ "$5" = 3.13 ] && echo {}'),
        ("uv", 'case "$1 $2" in "python install") touch {}.fetched;; *) [ -e {}.fetched ] && echo {}; esac'),
        ("blender", "echo risorius-python {}"),
    ],
    ids=["pyenv", "uv", "uv fetches", "blender"],
)
def test_python_is_found_elsewhere(name: str, script: str, bare_path: Path, tmp_path: Path) -> None:
    touch = shutil.which("touch")
    assert touch is not None
    (bare_path / "touch").symlink_to(touch)
    python = command(tmp_path, "elsewhere", "echo 3.13")
    command(bare_path, name, script.replace("{}", python))
    done = find(bare_path, "3.13")
    assert (done.returncode, done.stdout.strip()) == (0, python)


def test_without_the_python_of_a_blender_it_is_said_which(monkeypatch: pytest.MonkeyPatch, bare_path: Path) -> None:
    monkeypatch.setattr(environments, "ensure_system_libraries", lambda: None)
    monkeypatch.setattr(environments, "_fits", lambda environment: False)
    monkeypatch.setattr(sys, "version_info", (3, 14, 0))
    monkeypatch.setenv("PATH", str(bare_path))
    for name in ("bpy-4.5", "bpy-5.3"):
        with pytest.raises(NoPythonError, match=rf"Found no Python {ENVIRONMENTS[name].pythons[0]}\."):
            environments.ensure(name)


@pytest.mark.parametrize("name", ANY_BLENDER)
def test_any_blender_is_the_one_whose_python_is_here(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    (version,) = ENVIRONMENTS[name].pythons
    monkeypatch.setattr(environments, "find_python", lambda versions: f"python{version}")
    monkeypatch.setattr(environments, "version_of", lambda python: version)
    monkeypatch.setattr(environments, "ensure", lambda name: ENVIRONMENTS[name])
    assert environments.ensure_any_blender() is ENVIRONMENTS[name]


def test_missing_libraries_are_named_with_the_command(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "platform", "linux")
    monkeypatch.setattr(system_libraries, "LIBRARIES", {"libnowhere.so.9": "libnowhere9"})
    monkeypatch.setattr(os, "geteuid", lambda: 1000, raising=False)
    with pytest.raises(system_libraries.MissingLibraries, match=r"apt-get install .*libnowhere9"):
        system_libraries.ensure_system_libraries()


# ---- the demo -------------------------------------------------------------------------------------------------

# Of the version that its name says; "sets up" an environment whose interpreter says what it was called with.
DEMO_PYTHON = """
case "$1" in
-c) case "$2" in *"%d.%d"*) echo "${0##*python}" ;; *) echo "${0##*python3.}" ;; esac ;;
*)
    mkdir -p ".venv-$2/bin"
    printf '#!/bin/sh\\necho ran "$0" "$@"\\n' > ".venv-$2/bin/python"
    chmod +x ".venv-$2/bin/python" ;;
esac
"""


@pytest.mark.parametrize(
    ("present", "says"),
    [
        (("python3.11", "python3.13"), "ran .venv-bpy-4.5/bin/python -m risorius demo --out out joy"),
        (("python3.13", "python3.12"), "ran .venv-bpy-5.3/bin/python -m risorius demo --out out joy"),
        (("python3.12", "blender"), "in_blender.py -- demo --out out joy"),
        (("python3.12",), "Found no Python 3.11 or 3.13."),
    ],
)
def test_the_demo_runs_in_what_is_here(present: tuple[str, ...], says: str, bare_path: Path, tmp_path: Path) -> None:
    (tmp_path / "tools").mkdir()
    for name in ("demo.sh", "find_python.sh"):
        shutil.copyfile(ROOT / "tools" / name, tmp_path / "tools" / name)
    for name in ("mkdir", "chmod", "rm", "dirname"):
        found = shutil.which(name)
        assert found is not None
        (bare_path / name).symlink_to(found)
    for name in present:
        command(bare_path, name, DEMO_PYTHON if name.startswith("python") else 'echo blender "$@"')
    done = subprocess.run(
        ["/bin/sh", "tools/demo.sh", "joy"], cwd=tmp_path, env={"PATH": str(bare_path)}, capture_output=True, text=True,
        check=False,
    )  # fmt: skip
    assert says in done.stdout + done.stderr
    assert (done.returncode == 0) == (says[:5] != "Found")


# ---- environments ---------------------------------------------------------------------------------------------

# Makes an environment whose interpreter is itself. Stops for good where $STOP says: when only the folder is there,
# or when pip has put half of a package there.
PYTHON = """
case "$1 $2" in
"-m venv")
    mkdir -p "$3/bin"
    cp "$0" "$3/bin/python"
    printf 'version = 3.13.0\\ncommand = python -m venv %s\\n' "$3" > "$3/pyvenv.cfg"
    [ "$STOP" = venv ] && touch "$REACHED" && sleep 60
    touch "$3/pip" ;;
"-m pip")
    here=${0%/bin/python}
    [ -e "$here/pip" ] || { echo "No module named pip" >&2; exit 1; }
    [ "$STOP" = pip ] && touch "$here/half" "$REACHED" && sleep 60
    echo installed >> "$here/packages" ;;
esac
"""

SET_UP = """
import sys
from pathlib import Path
import environments
python, root, *requirements = sys.argv[1:]
environments.ROOT = Path(root)
environments.ENVIRONMENTS = {"some": environments.Environment(".venv", tuple(requirements), ("3.13",))}
environments.find_python = lambda versions: python
sys.exit(environments.main(["some"]))
"""


class Checkout:
    """A checkout with one environment that a stub of a Python makes."""

    def __init__(self, root: Path, python: str) -> None:
        (root / "pyproject.toml").write_text("[project]\n[tool.setuptools]\n")
        self.root, self.python, self.venv, self.reached = root, python, root / ".venv", root / "reached"

    def start(self, *requirements: str, stop: str = "") -> subprocess.Popen[str]:
        """Begin a set-up; it stops for good where `stop` says."""
        variables = {**os.environ, "PYTHONPATH": str(ROOT / "tools"), "STOP": stop, "REACHED": str(self.reached)}
        run = [sys.executable, "-c", SET_UP, self.python, str(self.root), *requirements]
        return subprocess.Popen(
            run, env=variables, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True
        )

    def set_up(self, *requirements: str) -> None:
        """Set up to the end."""
        process = self.start(*requirements)
        said, _ = process.communicate(timeout=60)
        assert process.returncode == 0, said

    def kill(self, stop: str, *requirements: str) -> None:
        """Set up and be killed midway."""
        process = self.start(*requirements, stop=stop)
        until = time.monotonic() + 60
        while not self.reached.exists():
            assert process.poll() is None
            assert time.monotonic() < until
            time.sleep(0.02)
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()

    def packages(self) -> int:
        """How often pip has filled the environment."""
        return len((self.venv / "packages").read_text().splitlines())


@pytest.fixture
def checkout(tmp_path: Path) -> Checkout:
    """A checkout without environments, its path with a space in it."""
    root = tmp_path / "check out"
    root.mkdir()
    return Checkout(root, command(tmp_path, "python3.13", PYTHON))


def test_an_environment_is_made_once_and_filled_again_for_other_packages(checkout: Checkout) -> None:
    checkout.set_up("one")
    made = (checkout.venv / "pip").stat().st_mtime_ns
    checkout.set_up("one")
    assert checkout.packages() == 1
    checkout.set_up("another")
    assert checkout.packages() == 2
    assert (checkout.venv / "pip").stat().st_mtime_ns == made


@pytest.mark.parametrize("stop", ["venv", "pip"])
def test_a_set_up_that_was_killed_heals(stop: str, checkout: Checkout) -> None:
    """A folder without pip, or one half filled, is made anew by the next run."""
    checkout.kill(stop, "one")
    assert checkout.venv.exists()
    checkout.set_up("one")
    assert checkout.packages() == 1
    assert not (checkout.venv / "half").exists()


def test_an_update_that_was_killed_heals(checkout: Checkout) -> None:
    checkout.set_up("one")
    checkout.kill("pip", "another")
    checkout.set_up("another")
    assert checkout.packages() == 1
    assert not (checkout.venv / "half").exists()


def test_an_environment_that_was_moved_is_made_anew(checkout: Checkout, tmp_path: Path) -> None:
    checkout.set_up("one")
    moved = Checkout(checkout.root.rename(tmp_path / "moved"), checkout.python)
    (moved.venv / "half").touch()
    moved.set_up("one")
    assert not (moved.venv / "half").exists()


def test_what_pip_cannot_fill_says_so_and_is_made_anew(checkout: Checkout, monkeypatch: pytest.MonkeyPatch) -> None:
    environment = environments.Environment(".venv", ("one",), ("3.13",))
    monkeypatch.setattr(environments, "ROOT", checkout.root)
    monkeypatch.setattr(environments, "ENVIRONMENTS", {"some": environment})
    monkeypatch.setattr(environments, "find_python", lambda versions: checkout.python)
    with monkeypatch.context() as patch:
        failing = checkout.python.replace("python3.13", "failing")
        Path(failing).write_text(Path(checkout.python).read_text().replace("echo installed >>", "exit 1 #"))
        Path(failing).chmod(0o755)
        patch.setattr(environments, "find_python", lambda versions: failing)
        with pytest.raises(SetUpError, match=r"pip could not fill \.venv"):
            environments.ensure("some")
    assert environments.ensure("some") is environment
    assert checkout.packages() == 1
