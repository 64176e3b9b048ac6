"""Attempts in a process of their own, watched for crashes, hangs and memory; what fails is saved."""

from __future__ import annotations

import contextlib
import multiprocessing
import shutil
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from multiprocessing.connection import Connection
from pathlib import Path

from .attempts import Reader, outcome

#: Seconds without a word after which an attempt hangs.
HANGS = 60.0
#: Bytes that a process may take beside what it has taken when it begins.
MEMORY = 2 << 30


@dataclass
class Report:
    """How often each reader read and refused, and the files that went wrong: where they are saved, and why."""

    counts: Counter[tuple[str, str]] = field(default_factory=Counter)
    failures: list[tuple[Path, str]] = field(default_factory=list)


def watched(
    readers: Sequence[Reader], out: Path, *, seconds: float, seed: int, hangs: float = HANGS, most: int = 50
) -> Report:
    """Give every reader one file after another for a while; each gets its seeds at least.

    Files that fail are saved in `out` as NAME-READER-NUMBER with the ending of their kind.
    """
    report, until = Report(), time.monotonic() + seconds
    context = multiprocessing.get_context("fork") if sys.platform == "linux" else multiprocessing.get_context("spawn")
    first: int | None = 0
    while first is not None and len(report.failures) < most:
        mine, theirs = context.Pipe(duplex=False)
        process = context.Process(target=_attempts, args=(readers, first, until, seed, theirs), daemon=True)
        process.start()
        theirs.close()
        first = _followed(readers, mine, process, report, out, seed=seed, hangs=hangs, most=most)
        process.kill()
        process.join()
    return report


def _followed(
    readers: Sequence[Reader], told: Connection, process: multiprocessing.process.BaseProcess, report: Report,
    out: Path, *, seed: int, hangs: float, most: int,
) -> int | None:  # fmt: skip
    """Take in what a process tells; where to go on after it broke down, None where it ended well."""
    at = 0
    while True:
        came, wrong, more = "bad", f"hangs: no end within {hangs:g} s", False
        if told.poll(hangs):
            try:
                at, came, wrong = told.recv()
                more = True
            except EOFError:
                process.join()
                wrong = f"the process died (exit code {process.exitcode})"
        if came == "end":
            return None
        if came == "begun":
            continue
        reader, number = _turn(readers, at)
        report.counts[reader.name, came] += 1
        if came == "bad":
            report.failures.append((_saved(reader, number, seed, out), wrong))
        if not more:
            return at + 1
        if len(report.failures) >= most:
            return None


def _turn(readers: Sequence[Reader], at: int) -> tuple[Reader, int]:
    """Whose turn it is at a count of attempts, and which of its files."""
    return readers[at % len(readers)], at // len(readers)


def _saved(reader: Reader, number: int, seed: int, out: Path) -> Path:
    """Write a file that failed."""
    name, content = reader.file(number, seed)
    path = out / f"{reader.name}-{seed}-{number}{Path(name).suffix}"
    out.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)
    return path


def _attempts(readers: Sequence[Reader], first: int, until: float, seed: int, tell: Connection) -> None:
    """The work of the process: attempts in turn, until time is up and all have had their seeds."""
    _limit_memory()
    with tempfile.TemporaryDirectory(prefix="fuzz") as folder:
        least = max(len(reader.seeds) for reader in readers) * len(readers)
        for at in _counted(first):
            if time.monotonic() > until and at >= least:
                tell.send((at, "end", ""))
                return
            reader, number = _turn(readers, at)
            tell.send((at, "begun", ""))
            name, content = reader.file(number, seed)
            path = Path(folder) / str(at) / name  # a path of its own: what reads tables by their path may remember them
            path.parent.mkdir()
            path.write_bytes(content)
            tell.send((at, *outcome(reader, path, is_sound=number < len(reader.seeds))))
            shutil.rmtree(path.parent, ignore_errors=True)


def _counted(first: int) -> Iterator[int]:
    while True:
        yield first
        first += 1


def _limit_memory() -> None:
    """Let what asks for too much memory fail, where the system can."""
    if sys.platform != "linux":
        return
    import resource

    with contextlib.suppress(ValueError, OSError):
        taken = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0]) * resource.getpagesize()
        resource.setrlimit(resource.RLIMIT_AS, (taken + MEMORY, resource.RLIM_INFINITY))
