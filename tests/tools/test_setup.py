"""Setting up: which Python is found, what is said where something is missing, and that no failure is hidden."""

from __future__ import annotations

import importlib.util
import os
import shutil
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).resolve().parents[2]
FIND = ROOT / "tools" / "find_python.sh"
NEEDS_311 = pytest.mark.skipif(sys.version_info[:2] != (3, 11), reason="needs to run on Python 3.11 itself")


def tool(name: str, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """A script of tools/ as a module of its own."""
    monkeypatch.syspath_prepend(str(ROOT / "tools"))
    spec = importlib.util.spec_from_file_location(f"tools_{name}", ROOT / "tools" / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    monkeypatch.setitem(sys.modules, spec.name, module)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def bare_path(tmp_path: Path) -> Path:
    """A PATH with the shell's own tools and nothing to run Python with."""
    folder = tmp_path / "bin"
    folder.mkdir()
    for name in ("sh", "sed", "cat", "env"):
        found = shutil.which(name)
        assert found is not None
        (folder / name).symlink_to(found)
    return folder


def find(path: Path, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run find_python.sh with this PATH."""
    variables = {"PATH": str(path), **environment}
    return subprocess.run(["/bin/sh", str(FIND)], env=variables, capture_output=True, text=True, check=False)


def command(folder: Path, name: str, script: str) -> None:
    """Put a command of this name on the PATH."""
    (folder / name).write_text(f"#!/bin/sh\n{script}\n")
    (folder / name).chmod(0o755)


def test_without_any_python_it_says_what_will_do(bare_path: Path) -> None:
    done = find(bare_path)
    assert done.returncode == 1
    assert done.stdout == ""
    for thing in ("Python 3.11", "uv", "Blender 4.2"):
        assert thing in done.stderr


def test_another_python_is_not_taken_for_311(bare_path: Path) -> None:
    command(bare_path, "python3", "echo 3.12")
    assert find(bare_path).returncode == 1
    refused = find(bare_path, PYTHON=str(bare_path / "python3"))
    assert refused.returncode == 1
    assert "is not a Python 3.11" in refused.stderr


@NEEDS_311
def test_python_is_found_on_the_path_or_from_uv_or_in_blender(bare_path: Path) -> None:
    for name, script in (
        ("blender", f"echo risorius-python {sys.executable}"),
        ("uv", f'[ "$1 $2" = "python find" ] && echo {sys.executable}'),
    ):
        command(bare_path, name, script)
        done = find(bare_path)
        assert (done.returncode, done.stdout.strip()) == (0, sys.executable), name
        (bare_path / name).unlink()
    (bare_path / "python3.11").symlink_to(sys.executable)
    assert find(bare_path).stdout.strip() == str(bare_path / "python3.11")


def test_missing_libraries_are_named_with_the_command(monkeypatch: pytest.MonkeyPatch) -> None:
    libraries = tool("system_libraries", monkeypatch)
    monkeypatch.setattr(sys, "platform", "linux")
    monkeypatch.setattr(libraries, "LIBRARIES", {"libnowhere.so.9": "libnowhere9"})
    monkeypatch.setattr(os, "geteuid", lambda: 1000, raising=False)
    with pytest.raises(libraries.MissingLibraries, match=r"apt-get install .*libnowhere9"):
        libraries.ensure_system_libraries()


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("def test_a(): pass\ndef test_b(): assert False", "1 passed, 1 failed, 0 skipped"),
        ("import os\ndef test_a(): pass\ndef test_b(): os._exit(3)", "0 passed, 1 failed, 0 skipped"),
        ("import nowhere_at_all", "0 passed, 1 failed, 0 skipped"),
        ("", "0 passed, 1 failed, 0 skipped"),
        ("import pytest\ndef test_a(): pytest.skip('no')", "0 passed, 0 failed, 1 skipped"),
    ],
)
def test_no_failing_run_is_hidden(body: str, expected: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A failure, a crash, a broken import and an empty run all count as failures."""
    runner = tool("test", monkeypatch)
    environments = tool("environments", monkeypatch)
    here = environments.Environment(str(tmp_path), (), blender=False)
    monkeypatch.setattr(type(here), "python", property(lambda self: Path(sys.executable)))
    monkeypatch.setattr(runner, "ensure", lambda name: here)
    monkeypatch.setattr(runner, "REPORTS", tmp_path)
    (tmp_path / "test_body.py").write_text(body)
    count = runner.pytest("any", "any", "-p", "no:cacheprovider", str(tmp_path / "test_body.py"))
    assert str(count) == expected


def test_exit_code_and_last_line_tell_of_a_failing_step(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    runner = tool("test", monkeypatch)
    monkeypatch.setattr(runner, "REPORTS", tmp_path)
    good = runner.Step("good", "passes", lambda: runner.Count(passed=3, skipped=1))
    bad = runner.Step("bad", "fails", lambda: runner.Count(passed=1, failed=1))
    monkeypatch.setattr(runner, "STEPS", (good, bad))
    assert runner.main([]) == 1
    assert capsys.readouterr().out.splitlines()[-1] == "4 passed, 1 failed, 1 skipped"
    assert runner.main(["good"]) == 0
    assert runner.main(["neither"]) == 2


def test_report_of_a_run_counts_errors_as_failures(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    report = tmp_path / "r.xml"
    report.write_text('<testsuites><testsuite tests="9" failures="1" errors="2" skipped="3"/></testsuites>')
    assert str(tool("test", monkeypatch).read_report(report)) == "3 passed, 3 failed, 3 skipped"
