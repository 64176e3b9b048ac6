"""Steps of a run of all checks: one after another or beside each other, whatever keeps one from ending well counted."""

from __future__ import annotations

import subprocess
import tempfile
import time
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass

from environments import NoPythonError, SetUpError
from running import Bounds, Count, stop_all


class AbsentError(Exception):
    """Why this machine cannot run a step."""


@dataclass(frozen=True)
class Step:
    """One step: its name, what it checks, how, whether it runs beside the others, and the environments it uses."""

    name: str
    purpose: str
    run: Callable[[Bounds], Count]
    aside: bool = False
    environments: tuple[str, ...] = ("dev",)


@dataclass(frozen=True)
class Result:
    """How a step ended, and why it was left out where it was."""

    step: Step
    count: Count
    absent: str = ""


def perform(step: Step, bounds: Bounds) -> Result:
    """Run one step; whatever keeps it from ending well is a failure, what this machine cannot have is skipped."""
    bounds.say(f"\n== {step.name}: {step.purpose}")
    begun, absent = time.monotonic(), ""
    try:
        count = step.run(bounds)
    except (AbsentError, NoPythonError) as error:
        absent, count = str(error), Count(skipped=1)
        bounds.say(f"Not here: {error}")
    except SetUpError as error:
        count = Count(failed=1)
        bounds.say(f"Set-up stopped: {error}")
    except subprocess.TimeoutExpired:
        count = Count(failed=1)
        bounds.say(f"{step.name}: no end within the time that a run may take")
    bounds.say(f"== {step.name}: {count} in {time.monotonic() - begun:.0f} s")
    return Result(step, count, absent)


def perform_aside(step: Step, until: float) -> tuple[Result, str]:
    """Run one step beside others; how it ended, and all that it wrote."""
    with tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") as output:
        result = perform(step, Bounds(output, until))
        output.seek(0)
        return result, output.read()


def perform_all(steps: list[Step], until: float) -> list[Result]:
    """Run steps: one after another those that use all cores, and beside them, one after another, those that use one."""
    ahead = [step for step in steps if not step.aside]
    results: list[Result] = []
    if not ahead:
        return [perform(step, Bounds(None, until)) for step in steps]
    with ThreadPoolExecutor(max_workers=1) as beside:
        waiting = [beside.submit(perform_aside, step, until) for step in steps if step.aside]
        try:
            for step in ahead:
                results.append(perform(step, Bounds(None, until)))
                while waiting and waiting[0].done():
                    results.append(printed(waiting.pop(0)))
            results += [printed(step) for step in waiting]
        except BaseException:
            beside.shutdown(wait=False, cancel_futures=True)
            stop_all()
            raise
    return results


def printed(ended: Future[tuple[Result, str]]) -> Result:
    """How a step beside ended, after printing all that it wrote."""
    result, output = ended.result()
    print(output, end="", flush=True)
    return result
