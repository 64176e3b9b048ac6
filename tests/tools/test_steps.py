"""The run of all checks: no failure is hidden, nothing hangs, what steps write stays apart, what is absent is said."""

from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from environments import Environment, NoPythonError, SetUpError
from places import ROOT
from running import Bounds, Count, read_report, run
from steps import Step, perform

SOON = 60.0


@pytest.fixture
def runner(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """tools/test.py as a module, writing its reports beside the test; every environment is this very Python."""
    spec = importlib.util.spec_from_file_location("tools_test", ROOT / "tools" / "test.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    monkeypatch.setitem(sys.modules, spec.name, module)
    spec.loader.exec_module(module)
    here = Environment(str(tmp_path), ())
    monkeypatch.setattr(Environment, "python", property(lambda self: Path(sys.executable)))
    monkeypatch.setattr(module, "ensure", lambda name: here)
    monkeypatch.setattr(module, "ensure_any_blender", lambda: here)
    monkeypatch.setattr(module, "REPORTS", tmp_path / "reports")
    return module


def bounds(seconds: float = SOON) -> Bounds:
    """Written to the terminal, to end within these seconds."""
    return Bounds(None, time.monotonic() + seconds)


# ---- one run of pytest ----------------------------------------------------------------------------------------


CRASH = "import os\ndef test_a(): pass\ndef test_b(): os._exit(3)"
HANG = "import time\ndef test_a(): time.sleep(60)\ndef test_b(): pass"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("body", "processes", "expected"),
    [
        ("def test_a(): pass\ndef test_b(): assert False", 0, "1 passed, 1 failed, 0 skipped"),
        ("def test_a(): pass\ndef test_b(): assert False", 2, "1 passed, 1 failed, 0 skipped"),
        (CRASH, 0, "0 passed, 1 failed, 0 skipped"),  # it takes what had passed with it
        (CRASH, 2, "1 passed, 1 failed, 0 skipped"),
        (HANG, 0, "1 passed, 1 failed, 0 skipped"),
        (HANG, 2, "1 passed, 1 failed, 0 skipped"),
        ("import nowhere_at_all", 0, "0 passed, 1 failed, 0 skipped"),
        ("", 0, "0 passed, 1 failed, 0 skipped"),
        ("import pytest\ndef test_a(): pytest.skip('no')", 0, "0 passed, 0 failed, 1 skipped"),
    ],
    ids=["failure", "failure of two", "crash", "crash of two", "hang", "hang of two", "import", "empty", "skipped"],
)
def test_no_failing_run_is_hidden(body: str, processes: int, expected: str, runner: ModuleType, tmp_path: Path) -> None:
    """A failure, a crash, a hang, a broken import and an empty run all count as failures."""
    (tmp_path / "test_body.py").write_text(body)
    options = ("-p", "no:cacheprovider", "--timeout", "1", "-n", str(processes))
    assert str(runner.pytest("any", "any", *options, str(tmp_path / "test_body.py"))(bounds())) == expected


def test_report_of_a_run_counts_errors_as_failures(tmp_path: Path) -> None:
    report = tmp_path / "r.xml"
    report.write_text('<testsuites><testsuite tests="9" failures="1" errors="2" skipped="3"/></testsuites>')
    assert str(read_report(report)) == "3 passed, 3 failed, 3 skipped"


@pytest.mark.slow
def test_a_command_that_does_not_end_is_stopped_with_all_that_it_started(tmp_path: Path) -> None:
    script = f"sleep 60 & echo $! > '{tmp_path}/started'; wait"
    with pytest.raises(subprocess.TimeoutExpired):
        run(["sh", "-c", script], bounds(1.0))
    started = int((tmp_path / "started").read_text())
    until = time.monotonic() + 10.0
    while running(started):
        assert time.monotonic() < until
        time.sleep(0.05)


def running(process: int) -> bool:
    """Whether a process of this number runs; one that has ended and waits to be collected does not."""
    try:
        os.kill(process, 0)
        return ") Z" not in Path(f"/proc/{process}/stat").read_text()
    except (ProcessLookupError, FileNotFoundError):
        return False


# ---- all steps ------------------------------------------------------------------------------------------------


def step(runner: ModuleType, name: str, count: Count | Exception, **options: Any) -> Any:
    """A step that says its name and ends so."""

    def end(within: Bounds) -> Count:
        within.say(f"{name} begins")
        if isinstance(count, Exception):
            raise count
        within.say(f"{name} ends")
        return count

    return Step(name, f"does {name}", end, **options)


def test_exit_code_and_last_line_tell_of_a_failing_step(
    runner: ModuleType, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    good = step(runner, "good", Count(passed=3, skipped=1))
    bad = step(runner, "bad", Count(passed=1, failed=1), aside=True)
    monkeypatch.setattr(runner, "STEPS", (good, bad))
    assert runner.main([]) == 1
    assert capsys.readouterr().out.splitlines()[-1] == "4 passed, 1 failed, 1 skipped"
    assert (runner.REPORTS / "summary.txt").read_text() == "4 passed, 1 failed, 1 skipped\n"
    assert runner.main(["good"]) == 0
    assert runner.main(["neither"]) == 2


@pytest.mark.parametrize(
    "error", [SetUpError("no network"), subprocess.TimeoutExpired("pytest", 1.0)], ids=["set-up", "time"]
)
@pytest.mark.parametrize("aside", [False, True])
def test_a_step_that_cannot_end_has_failed(
    error: Exception, aside: bool, runner: ModuleType, monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    monkeypatch.setattr(runner, "STEPS", (step(runner, "one", error, aside=aside), step(runner, "two", Count(1))))
    assert runner.main([]) == 1
    assert capsys.readouterr().out.splitlines()[-1] == "1 passed, 1 failed, 0 skipped"


def test_a_blender_that_cannot_be_had_is_skipped_with_its_reason(
    runner: ModuleType, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def ensure(name: str) -> Environment:
        raise NoPythonError("Found no Python 3.11.")

    monkeypatch.setattr(runner, "ensure", ensure)
    blender = Step("old", "tests on an old Blender", runner.smoke("bpy-4.2"), environments=("bpy-4.2",))
    monkeypatch.setattr(runner, "STEPS", (step(runner, "one", Count(1), environments=()), blender))
    assert runner.main([]) == 0
    said = capsys.readouterr().out.splitlines()
    assert said[-1] == "1 passed, 0 failed, 1 skipped"
    assert "Left out: tests on an old Blender. Found no Python 3.11." in said


def test_what_steps_beside_write_is_printed_whole(
    runner: ModuleType, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Two steps run at once, each beginning before the other ends, and their lines do not mix."""
    meet = threading.Barrier(2)

    def meeting(name: str) -> Callable[[Bounds], Count]:
        def end(within: Bounds) -> Count:
            within.say(f"{name} begins")
            meet.wait(timeout=SOON)
            run([sys.executable, "-c", f"print('{name} works')"], Bounds(within.output, within.until))
            within.say(f"{name} ends")
            meet.wait(timeout=SOON)
            return Count(1)

        return end

    ahead, beside = (Step(name, name, meeting(name), aside=name == "beside") for name in ("ahead", "beside"))
    monkeypatch.setattr(runner, "STEPS", (beside, ahead))
    assert runner.main([]) == 0
    said = capsys.readouterr().out.splitlines()
    first = said.index("beside begins")
    assert said.index("ahead ends") < first
    assert said[first : first + 3] == ["beside begins", "beside works", "beside ends"]


# ---- the newest Blender ---------------------------------------------------------------------------------------

SHARED = """
import os, sys
if {missing!r} in sys.argv:
    sys.exit("no network in there")
os.execv(sys.executable, [sys.executable, *sys.argv[2:]])
"""


@pytest.fixture
def no_python(runner: ModuleType, monkeypatch: pytest.MonkeyPatch) -> None:
    """A machine without Python 3.13."""

    def ensure(name: str) -> Environment:
        raise NoPythonError("Found no Python 3.13.")

    monkeypatch.setattr(runner, "ensure", ensure)


def shared_blender(folder: Path, *, missing: str = "nothing") -> Path:
    """A shared program whose Blender is this Python; it cannot do what is missing."""
    (folder / "shared.py").write_text(SHARED.format(missing=missing))
    return folder / "shared.py"


@pytest.mark.slow
@pytest.mark.usefixtures("no_python")
def test_without_its_python_the_shared_blender_runs_the_newest(
    runner: ModuleType, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    tests = tmp_path / "tests"
    tests.mkdir()
    package = tmp_path / "package"
    package.mkdir()
    (package / "risorius").symlink_to(ROOT)
    (package / "bpy.py").touch()
    monkeypatch.setattr(runner, "ensure_link", lambda: package)
    monkeypatch.setattr(runner, "shared_blender", lambda: shared_blender(tmp_path))
    (tests / "test_a.py").write_text(
        "import pytest\nimport risorius\npytestmark = pytest.mark.smoke\ndef test_a(): pass\ndef test_b(): assert 0\n"
    )
    monkeypatch.setattr(runner, "IN_BLENDER", (str(tests), "-q"))
    result = perform(Step("new", "new", runner.newest_blender), bounds())
    assert (str(result.count), result.absent) == ("1 passed, 1 failed, 0 skipped", "")


@pytest.mark.usefixtures("no_python")
@pytest.mark.parametrize("reason", ["it needs root", "cannot be set up: no network in there"])
def test_without_either_it_is_skipped_and_said_why(
    reason: str, runner: ModuleType, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    def shared() -> Path:
        if "root" in reason:
            raise runner.NoSharedBlenderError(reason)
        return shared_blender(tmp_path, missing="bpy53")

    monkeypatch.setattr(runner, "shared_blender", shared)
    result = perform(Step("new", "new", runner.newest_blender), bounds())
    assert str(result.count) == "0 passed, 0 failed, 1 skipped"
    assert reason in result.absent
