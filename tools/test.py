"""Run every check of Risorius, step by step, and end with one line that sums them up.

    .venv/bin/python tools/test.py [STEP ...]

The steps are listed by `--list`. A step that cannot run counts as failed; what is skipped is said with its
reason. The last line reads `N passed, N failed, N skipped` and the exit code is 1 when anything failed.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

from environments import ENVIRONMENTS, SetUpError, ensure, ensure_link
from places import OUT, ROOT

REPORTS = OUT / "test-reports"
TIME_LIMIT = 1500  # s for one step: a hang must not eat the whole run
PURE = ("tests", "--ignore=tests/blender", "--ignore=tests/gui", "--ignore=tests/tools/release/test_install.py")
IN_BLENDER = ("tests/blender", "tests/test_layers.py", "tests/tools/release/test_install.py")

BUILDER = ("bpy-4.5",)  # brings Blender's extension tool, which the tests of the zip need


@dataclass(frozen=True)
class Count:
    """How many checks passed, failed and were skipped."""

    passed: int = 0
    failed: int = 0
    skipped: int = 0

    def __add__(self, other: Count) -> Count:
        return Count(self.passed + other.passed, self.failed + other.failed, self.skipped + other.skipped)

    def __str__(self) -> str:
        return f"{self.passed} passed, {self.failed} failed, {self.skipped} skipped"


@dataclass(frozen=True)
class Step:
    """One step: its name, what it checks, and how."""

    name: str
    purpose: str
    run: Callable[[], Count]


def command(*arguments: str, folder: Path = ROOT) -> Count:
    """One command that either passes or fails."""
    environment = {**os.environ, "MYPYPATH": os.pathsep.join((".", str(ROOT / ".typecheck")))}
    done = subprocess.run(arguments, cwd=folder, env=environment, timeout=TIME_LIMIT, check=False)
    return Count(failed=1) if done.returncode else Count(passed=1)


def lint() -> Count:
    """Ruff over everything."""
    return command(tool("ruff"), "check", ".")


def types() -> Count:
    """Mypy over the package (through the link, so that the checkout may have any name) and the tools beside it."""
    mypy = (tool("mypy"), "--config-file", "../pyproject.toml")
    scripts = [*sorted(path.name for path in (ROOT / "tools").glob("*.py")), "experiments/compare_layers.py"]
    package = command(*mypy, "-p", "risorius", folder=ensure_link())
    return package + command(*mypy, "--explicit-package-bases", *scripts, folder=ROOT / "tools")


def layers() -> Count:
    """Import-linter's contracts of pyproject.toml; its cache misses modules that came later."""
    return command(tool("lint-imports"), "--no-cache")


def tool(name: str) -> str:
    """The path of a command of the development environment."""
    return str(ENVIRONMENTS["dev"].python.parent / name)


def pytest(environment: str, name: str, *arguments: str, beside: tuple[str, ...] = ()) -> Count:
    """One run of pytest in one environment, counted from its JUnit report; `beside` must be set up too.

    A run that ends badly without a failing test (a crash, a hang, nothing collected) counts as one failure.
    """
    try:
        for other in beside:
            ensure(other)
        python = ensure(environment).python
    except SetUpError as error:
        print(f"Set-up stopped: {error}", flush=True)
        return Count(failed=1)
    REPORTS.mkdir(parents=True, exist_ok=True)
    report = REPORTS / f"{name}.xml"
    report.unlink(missing_ok=True)
    run = [str(python), "-m", "pytest", "-q", f"--junit-xml={report}", *arguments]
    try:
        code = subprocess.run(run, cwd=ROOT, env=quiet_environment(), timeout=TIME_LIMIT, check=False).returncode
    except subprocess.TimeoutExpired:
        print(f"{name}: no end within {TIME_LIMIT} s", flush=True)
        code = -1
    count = read_report(report) if report.exists() else Count()
    if code and not count.failed:
        print(f"{name}: pytest ended with code {code} and no failing test", flush=True)
        count += Count(failed=1)
    return count


def quiet_environment() -> dict[str, str]:
    """One thread per process: many threads on small matrices only fight each other."""
    return {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "PYTHONDONTWRITEBYTECODE": "1"}


def read_report(report: Path) -> Count:
    """Sum a JUnit report; an error in a fixture is a failure."""
    count = Count()
    for suite in ElementTree.parse(report).getroot().iter("testsuite"):
        total, failed, errors, skipped = (
            int(suite.get(key, "0")) for key in ("tests", "failures", "errors", "skipped")
        )
        count += Count(max(total - failed - errors - skipped, 0), failed + errors, skipped)
    return count


STEPS = (
    Step("lint", "style (ruff)", lint),
    Step("types", "types (mypy --strict)", types),
    Step("layers", "import directions (import-linter)", layers),
    Step("pure", "tests without Blender", lambda: pytest("dev", "pure", *PURE, beside=BUILDER)),
    Step("bpy-4.5", "tests on Blender 4.5", lambda: pytest("bpy-4.5", "bpy-4.5", *IN_BLENDER)),
    Step("bpy-4.2", "smoke tests on Blender 4.2", lambda: pytest("bpy-4.2", "bpy-4.2", *IN_BLENDER, "-m", "smoke")),
    Step("bpy-5.0", "smoke tests on Blender 5.0", lambda: pytest("bpy-5.0", "bpy-5.0", *IN_BLENDER, "-m", "smoke")),
    Step("gui", "the built extension in a real window", lambda: pytest("dev", "gui", "tests/gui", beside=BUILDER)),
)


def main(names: list[str]) -> int:
    """Run the named steps, or all of them."""
    known = {step.name: step for step in STEPS}
    if "--list" in names or not set(names) <= set(known):
        print("\n".join(f"{step.name:<9}{step.purpose}" for step in STEPS))
        return 0 if "--list" in names else 2
    chosen = [known[name] for name in names] or list(STEPS)
    started, results = time.monotonic(), []
    for number, step in enumerate(chosen, 1):
        print(f"\n== {number}/{len(chosen)} {step.name}: {step.purpose}", flush=True)
        begun = time.monotonic()
        count = step.run()
        results.append(count)
        print(f"== {step.name}: {count} in {time.monotonic() - begun:.0f} s", flush=True)
    total = sum(results, Count())
    failing = [step.name for step, count in zip(chosen, results, strict=True) if count.failed]
    ending = f"; failing: {', '.join(failing)}" if failing else ""
    print(f"\n{len(chosen)} steps in {time.monotonic() - started:.0f} s{ending}")
    REPORTS.mkdir(parents=True, exist_ok=True)
    (REPORTS / "summary.txt").write_text(f"{total}\n", encoding="utf-8")
    print(total, flush=True)
    return 1 if total.failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
