"""Damaged files for every reader: a short run of `make fuzz`; and that it notices what is wrong with a reader."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from pathlib import Path

import fuzz
import numpy as np
import pytest
from fuzzing.attempts import Reader, flaw, outcome
from fuzzing.readers import readers
from fuzzing.watch import watched
from risorius.errors import FormatError

SEEDS = {"a.json": b'{"fps": 25, "frames": [[1.5, 2.5], [3.5, 4.5]]}', "b.json": b"[1, 2, 3]"}


@pytest.mark.slow
def test_no_reader_fails_on_damaged_files(tmp_path: Path) -> None:
    given = [reader for reader in readers() if not reader.name.startswith("blend")]
    found = watched(given, tmp_path, seconds=15, seed=0)
    assert [f"{path.name}: {wrong}" for path, wrong in found.failures] == []
    assert all(found.counts[reader.name, "read"] for reader in given)
    assert sum(found.counts.values()) > 200


def raising(path: Path) -> object:
    """Raise what is not for people where a file is damaged."""
    if path.read_bytes() not in SEEDS.values():
        raise KeyError("frames")
    return 1


def overflowing(path: Path) -> object:
    """Compute with what cannot be computed with."""
    return np.array([1e200]) * 1e200


def endless(path: Path) -> object:
    """Never end where a file is damaged."""
    while path.read_bytes() not in SEEDS.values():
        time.sleep(0.05)
    return 1


def dying(path: Path) -> object:
    """End the process."""
    if path.read_bytes() not in SEEDS.values():
        os._exit(7)
    return 1


def wordy(path: Path) -> object:
    """Put the whole file into a message."""
    error = FormatError(path, "is wrong")
    error.args = ("x" * 5000,)
    if path.read_bytes() not in SEEDS.values():
        raise error
    return 1


@pytest.mark.parametrize(
    ("read", "told"),
    [
        (raising, "KeyError"),
        (lambda path: {"a": (1.0, [np.nan])}, "is not finite|are not finite"),
        (lambda path: [10**200], "as large as"),
        (overflowing, "overflow"),
        (endless, "hangs"),
        (dying, "the process died"),
        (wordy, "5000 characters"),
    ],
)
def test_what_is_wrong_with_a_reader_is_noticed(
    read: Callable[[Path], object], told: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    broken = Reader("broken", read, SEEDS)
    found = watched([broken], tmp_path, seconds=2.0, seed=1, hangs=1.0, most=2)
    assert found.failures
    path, wrong = found.failures[0]
    assert any(word in wrong for word in told.split("|"))
    assert path.name.startswith("broken-1-")
    if told not in ("hangs", "the process died"):
        assert fuzz.again([path], {"broken": broken}) == 1
        assert str(path) in capsys.readouterr().out


def test_a_refused_sound_file_is_noticed_and_a_refused_damaged_one_is_well(tmp_path: Path) -> None:
    def refusing(path: Path) -> object:
        raise FormatError(path, "is refused: give another")

    (tmp_path / "a").write_bytes(b"")
    assert outcome(Reader("r", refusing, SEEDS), tmp_path / "a") == ("refused", "")
    came, wrong = outcome(Reader("r", refusing, SEEDS), tmp_path / "a", is_sound=True)
    assert (came, "refused a sound file" in wrong) == ("bad", True)


def test_the_same_seed_gives_the_same_files() -> None:
    one, other = (Reader("r", str, SEEDS) for _ in range(2))
    assert [one.file(n, 3) for n in range(40)] == [other.file(n, 3) for n in range(40)]
    assert one.file(9, 3) != one.file(9, 4)


def test_faps_may_be_silent_and_nothing_else() -> None:
    assert flaw(np.full((3, 68), np.nan)) == ""
    assert flaw(np.full((3, 67), np.nan)) != ""
    assert flaw(np.full((3, 68), np.inf)) != ""
