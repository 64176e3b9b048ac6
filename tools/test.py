"""Run every check of Risorius, step by step, and end with one line that sums them up.

    .venv/bin/python tools/test.py [--quick] [STEP ...]

The steps are listed by `--list`; `--quick` stands for those of the inner loop. Tests use all cores; steps that take
one are run beside them, and what they write is printed when they have ended. A step that cannot run counts as failed.
A Blender that this machine cannot have counts as skipped, and is named with its reason before the last line, which
reads `N passed, N failed, N skipped`. The exit code is 1 when anything failed.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

from environments import ENVIRONMENTS, Environment, NoPythonError, SetUpError, ensure, ensure_any_blender, ensure_link
from places import OUT, ROOT
from running import Bounds, Count, read_report, run
from steps import AbsentError, Step, perform_all
from window.driver import NoSharedBlenderError, shared_blender

REPORTS = OUT / "test-reports"
TIME_LIMIT = 3000
"""Seconds for the whole run: for a hang that no test's own limit sees. A quiet machine needs a fifth of it."""

INSTALL = "tests/tools/release/test_install.py"
PURE = ("tests", "--ignore=tests/blender", "--ignore=tests/gui", f"--ignore={INSTALL}")
IN_BLENDER = ("tests/blender", "tests/test_layers.py", "tests/test_values.py")
#: What is set up once for several tests comes first: the end of the queue is shared out among all processes.
INSTALLED = (INSTALL, *IN_BLENDER)

ALL_CORES = ("-n", "auto", "--maxprocesses", "8", "--dist", "worksteal")
"""Tests in as many processes as there are cores; each goes on with the faces that it has built."""
BLENDER_LIMIT = ("--timeout", "600", "--timeout-method", "thread")
"""A test's own limit inside Blender: a hang in its C code ends the process, which Python alone could not."""
WINDOW_LIMIT = ("--timeout", "1800")
"""A test's own limit in a window: the first one sets the window's Blender up."""
SMOKE, NOT_SLOW = ("-m", "smoke"), ("-m", "not slow", "--durations", "5", "--durations-min", "1")

ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
"""One thread per process: many threads on small matrices only fight each other."""


def command(bounds: Bounds, *arguments: str, folder: Path = ROOT) -> Count:
    """One command that either passes or fails."""
    environment = {**os.environ, "MYPYPATH": os.pathsep.join((".", str(ROOT / ".typecheck")))}
    return Count(failed=1) if run(arguments, bounds, folder=folder, environment=environment) else Count(passed=1)


def lint(bounds: Bounds) -> Count:
    """Ruff over everything."""
    return command(bounds, tool("ruff"), "check", ".")


def types(bounds: Bounds) -> Count:
    """Mypy over the package (through the link, so that the checkout may have any name) and the tools beside it."""
    mypy = (tool("mypy"), "--config-file", "../pyproject.toml")
    scripts = [*sorted(path.name for path in (ROOT / "tools").glob("*.py")), "experiments/compare_layers.py"]
    package = command(bounds, *mypy, "-p", "risorius", folder=ensure_link())
    return package + command(bounds, *mypy, "--explicit-package-bases", *scripts, folder=ROOT / "tools")


def layers(bounds: Bounds) -> Count:
    """Import-linter's contracts of pyproject.toml; its cache misses modules that came later."""
    return command(bounds, tool("lint-imports"), "--no-cache")


def tool(name: str) -> str:
    """The path of a command of the development environment."""
    return str(ENVIRONMENTS["dev"].python.parent / name)


_set_up: dict[str, Environment | SetUpError] = {}


def set_up(name: str) -> Environment:
    """An environment of this name (or any with a Blender), set up once in a run.

    Raises
    ------
    SetUpError
        as `ensure` does, each time that it is asked for.
    """
    if name not in _set_up:
        try:
            _set_up[name] = ensure_any_blender() if name == "blender" else ensure(name)
        except SetUpError as error:
            _set_up[name] = error
    found = _set_up[name]
    if isinstance(found, SetUpError):
        raise found
    return found


def pytest(environment: str, name: str, *arguments: str) -> Callable[[Bounds], Count]:
    """A run of pytest in one environment."""

    def tests(bounds: Bounds) -> Count:
        return counted([set_up(environment).python], name, *arguments, bounds=bounds)

    return tests


def counted(python: list[str | Path], name: str, *arguments: str, bounds: Bounds, **variables: str) -> Count:
    """One run of pytest, counted from its JUnit report, with these variables in its environment.

    A run that ends badly without a failing test (a crash, a hang, nothing collected) counts as one failure.
    """
    REPORTS.mkdir(parents=True, exist_ok=True)
    report = REPORTS / f"{name}.xml"
    report.unlink(missing_ok=True)
    tests = [*python, "-m", "pytest", "-q", f"--junit-xml={report}", *arguments]
    code = run(tests, bounds, environment={**os.environ, **ONE_THREAD, **variables})
    count = read_report(report) if report.exists() else Count()
    if code and not count.failed:
        bounds.say(f"{name}: pytest ended with code {code} and no failing test")
        count += Count(failed=1)
    return count


def newest_blender(bounds: Bounds) -> Count:
    """Blender 5.3, from an environment of its own or, without a Python 3.13 here, in the shared program's.

    The shared one has pytest alone, and its own Blender where the built zip is tried: see the step gui.
    """
    try:
        python = set_up("bpy-5.3").python
    except NoPythonError as no_python:
        try:
            shared: list[str | Path] = [sys.executable, shared_blender(), "bpy53"]
        except NoSharedBlenderError as no_tool:
            raise AbsentError(f"{no_python}\nThe shared Blender would do, but {no_tool}") from no_python
    else:
        return counted([python], "bpy-5.3", *INSTALLED, *SMOKE, *ALL_CORES, *BLENDER_LIMIT, bounds=bounds)
    package = {"PYTHONPATH": str(ensure_link())}
    environment, probing = {**os.environ, **package}, [*shared, "-c", "import bpy, risorius"]
    left = max(bounds.until - time.monotonic(), 0.0)
    probe = subprocess.run(probing, env=environment, timeout=left, capture_output=True, text=True, check=False)
    if probe.returncode:
        raise AbsentError(f"the shared Blender 5.3 cannot be set up: {probe.stderr.strip()[-300:]}")
    return counted(shared, "bpy-5.3", *IN_BLENDER, *SMOKE, bounds=bounds, **package)


def smoke(environment: str) -> Callable[[Bounds], Count]:
    """The smoke tests on one Blender."""
    return pytest(environment, environment, *INSTALLED, *SMOKE, *ALL_CORES, *BLENDER_LIMIT)


CHECKS = (
    Step("lint", "style (ruff)", lint, aside=True),
    Step("layers", "import directions (import-linter)", layers, aside=True),
    Step("types", "types (mypy --strict)", types, aside=True),
)
# The tests of the zip are skipped where there is no Blender whose extension tool they could use.
STEPS = (
    *CHECKS,
    Step(
        "gui", "the built extension in a real window", pytest("dev", "gui", "tests/gui", *WINDOW_LIMIT),
        aside=True, environments=("dev", "blender"),
    ),
    Step("pure", "tests without Blender", pytest("dev", "pure", *PURE, *ALL_CORES), environments=("dev", "blender")),
    Step(
        "bpy-4.5", "tests on Blender 4.5", pytest("bpy-4.5", "bpy-4.5", *INSTALLED, *ALL_CORES, *BLENDER_LIMIT),
        environments=("bpy-4.5",),
    ),
    Step("bpy-4.2", "smoke tests on Blender 4.2", smoke("bpy-4.2"), environments=("bpy-4.2",)),
    Step("bpy-5.0", "smoke tests on Blender 5.0", smoke("bpy-5.0"), environments=("bpy-5.0",)),
    Step("bpy-5.3", "smoke tests on Blender 5.3", newest_blender, environments=("bpy-5.3",)),
)  # fmt: skip
QUICK = (
    *CHECKS,
    Step("quick-pure", "short tests without Blender", pytest("dev", "quick-pure", *PURE, *NOT_SLOW, *ALL_CORES)),
    Step(
        "quick-blender", "short tests on one Blender",
        pytest("blender", "quick-blender", *IN_BLENDER, *NOT_SLOW, *ALL_CORES, *BLENDER_LIMIT),
        environments=("blender",),
    ),
)  # fmt: skip


def main(arguments: list[str]) -> int:
    """Run the named steps, or all of them."""
    known = {step.name: step for step in (*STEPS, *QUICK)}
    parser = argparse.ArgumentParser(description="Run every check, or the named steps.")
    parser.add_argument("steps", nargs="*", metavar="STEP", help="a step; see --list")
    parser.add_argument("--quick", action="store_true", help="style, types, layers and the short tests")
    parser.add_argument("--list", action="store_true", help="the steps, and end")
    options = parser.parse_args(arguments)
    if options.list or not set(options.steps) <= set(known):
        print("\n".join(f"{step.name:<15}{step.purpose}" for step in known.values()))
        return 0 if options.list else 2
    chosen = [known[name] for name in options.steps] or list(QUICK if options.quick else STEPS)
    started = time.monotonic()
    for name in dict.fromkeys(name for step in chosen for name in step.environments):
        try:
            set_up(name)
        except SetUpError:
            continue  # the steps that use it say so
    results = perform_all(chosen, started + TIME_LIMIT)
    total = sum((result.count for result in results), Count())
    failing = [result.step.name for result in results if result.count.failed]
    ending = f"; failing: {', '.join(failing)}" if failing else ""
    print(f"\n{len(chosen)} steps in {time.monotonic() - started:.0f} s{ending}")
    for result in results:
        if result.absent:
            print(f"Left out: {result.step.purpose}. {result.absent}")
    REPORTS.mkdir(parents=True, exist_ok=True)
    (REPORTS / "summary.txt").write_text(f"{total}\n", encoding="utf-8")
    print(total, flush=True)
    return 1 if total.failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
