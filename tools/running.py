"""Commands that end in time and leave nothing running, and how many checks passed in them."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import IO
from xml.etree import ElementTree

from places import ROOT


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
class Bounds:
    """Where a step writes (None: to the terminal), and when it must have ended, in seconds of `time.monotonic`."""

    output: IO[str] | None
    until: float

    def say(self, text: str) -> None:
        """Write one line where the step writes."""
        print(text, file=self.output or sys.stdout, flush=True)


_running: set[subprocess.Popen[bytes]] = set()


def run(
    command: Sequence[str | Path], bounds: Bounds, *, folder: Path = ROOT, environment: Mapping[str, str] | None = None
) -> int:
    """Run a command to its end; its exit code.

    Raises
    ------
    TimeoutExpired
        its time was up; it was stopped, with all that it had started.
    """
    apart = sys.platform != "win32"
    process = subprocess.Popen(
        list(map(str, command)), cwd=folder, env=environment, stdout=bounds.output, stderr=bounds.output,
        start_new_session=apart,
    )  # fmt: skip
    _running.add(process)
    try:
        return process.wait(timeout=max(bounds.until - time.monotonic(), 0.0))
    except BaseException:
        _stop(process)
        raise
    finally:
        _running.discard(process)


def stop_all() -> None:
    """Stop what is running, as Ctrl-C would: commands run in sessions of their own, which it does not reach."""
    for process in list(_running):
        _stop(process)


def _stop(process: subprocess.Popen[bytes]) -> None:
    """End a command and what it has started."""
    if sys.platform == "win32":
        process.kill()
    else:
        try:
            os.killpg(process.pid, signal.SIGKILL)
        except ProcessLookupError:
            return
    process.wait()


def read_report(report: Path) -> Count:
    """Sum a JUnit report; an error in a fixture is a failure."""
    count = Count()
    for suite in ElementTree.parse(report).getroot().iter("testsuite"):
        total, failed, errors, skipped = (
            int(suite.get(key, "0")) for key in ("tests", "failures", "errors", "skipped")
        )
        count += Count(max(total - failed - errors - skipped, 0), failed + errors, skipped)
    return count
