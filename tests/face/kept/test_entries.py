"""Things that are kept in files come back as they were, or not at all."""

from __future__ import annotations

import errno
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from risorius.face.kept.entries import MARK, Entries
from risorius.face.kept.frozen import Frozen, NotPlainError, thawed
from risorius.face.mesh.openings import Opening
from risorius.physics.elastic import Factor, diagonal_matrix
from risorius.polygons import PolygonTable
from risorius.progress import Progress, run

KEY, OTHER = "a" * 64, "b" * 64


def thing() -> dict[str, Any]:
    """Some of all that faces are made of."""
    arcs = np.arange(4), np.arange(3, -1, -1)
    opening = Opening(*arcs)
    return {
        "numbers": np.random.default_rng(0).normal(size=(5, 3, 2)).transpose(2, 0, 1),
        "empty": np.zeros((0, 3)),
        "one": np.float64(0.1),
        "openings": [opening, opening],
        "polygons": PolygonTable.of([[0, 1, 2], [0, 2, 3, 4]]),
        "factor": Factor(diagonal_matrix(np.array([2.0, 4.0]))),
        "step": Progress(0.5, "half"),
        ("l", 1): (frozenset({"mouth"}), None, True, float("inf")),
    }


def kept(folder: Path, key: str = KEY) -> Entries:
    """A folder with the thing in it."""
    entries = Entries(folder)
    assert run(entries.write(key, {**thing(), "step": None}))
    return entries


def test_what_is_kept_comes_back_to_the_last_bit(tmp_path: Path) -> None:
    before, after = thing(), kept(tmp_path).read(KEY)
    for name in ("numbers", "empty"):
        assert np.array_equal(after[name], before[name])
        assert after[name].dtype == before[name].dtype
    assert np.argsort(after["numbers"].strides).tolist() == np.argsort(before["numbers"].strides).tolist()
    assert type(after["one"]) is np.float64
    assert after["one"] == before["one"]
    assert after["openings"][0] is after["openings"][1]
    assert [polygon.tolist() for polygon in after["polygons"]] == [[0, 1, 2], [0, 2, 3, 4]]
    assert not after["polygons"].loops.flags.writeable
    assert after["numbers"].flags.writeable
    assert after["factor"].solve(np.array([1.0, 1.0])).tolist() == [0.5, 0.25]
    assert after["l", 1] == before["l", 1]


@pytest.mark.parametrize("place", [0, len(MARK) + 3, len(MARK) + 34, 200, -1])
def test_a_damaged_one_is_ignored_and_written_again(tmp_path: Path, place: int) -> None:
    entries = kept(tmp_path)
    (path,) = tmp_path.iterdir()
    content = bytearray(path.read_bytes())
    content[place] ^= 1
    path.write_bytes(content)
    assert entries.read(KEY) is None
    assert run(entries.write(KEY, thing()["openings"]))
    assert entries.read(KEY) is not None


@pytest.mark.parametrize("length", [0, 10, len(MARK) + 32, 300, -8])
def test_a_truncated_one_is_ignored(tmp_path: Path, length: int) -> None:
    entries = kept(tmp_path)
    (path,) = tmp_path.iterdir()
    path.write_bytes(path.read_bytes()[:length])
    assert entries.read(KEY) is None


def test_one_of_another_key_is_ignored(tmp_path: Path) -> None:
    entries = kept(tmp_path)
    (path,) = tmp_path.iterdir()
    path.rename(tmp_path / f"{OTHER}.face")
    assert entries.read(OTHER) is None


def test_an_older_kind_is_ignored(tmp_path: Path) -> None:
    entries = kept(tmp_path)
    (path,) = tmp_path.iterdir()
    path.write_bytes(path.read_bytes().replace(MARK, b"Risorius kept 0\n"))
    assert entries.read(KEY) is None


@pytest.mark.parametrize(
    "node",
    [
        ["object", "os:system", {}],
        ["object", "face.kept.frozen:import_module", {}],
        ["object", "face.no_such_room:Thing", {}],
        ["object", "operators.base:RisoriusOperator", {}],
        ["array", "|O", [1], [0], 0],
        ["call", "face.face:Face"],
    ],
)
def test_reading_makes_nothing_but_objects_of_a_face(node: Any) -> None:
    with pytest.raises((ValueError, KeyError, TypeError, AttributeError, ImportError)):
        thawed([0], [node], lambda number, dtype, shape: np.zeros(shape, dtype))


def test_what_is_not_made_of_figures_is_not_kept(tmp_path: Path) -> None:
    with pytest.raises(NotPlainError):
        Frozen({"action": print})
    entries = Entries(tmp_path)
    assert not run(entries.write(KEY, [print]))
    assert entries.trouble
    assert not list(tmp_path.iterdir())


def test_no_more_is_kept_than_may_be(tmp_path: Path) -> None:
    size = kept(tmp_path / "one").size()
    entries = Entries(tmp_path / "few", most=3 * size)
    for number, letter in enumerate("abc"):
        assert run(entries.write(letter * 64, {**thing(), "step": None}))
        os.utime(entries.folder / f"{letter * 64}.face", (number, number))
    assert entries.read("a" * 64) is not None  # used again: now "b" was not used for longest
    assert run(entries.write("d" * 64, {**thing(), "step": None}))
    assert [entries.read(letter * 64) is not None for letter in "abcd"] == [True, False, True, True]
    assert entries.size() <= entries.most
    assert not run(Entries(tmp_path / "none", most=100).write(KEY, thing()["openings"]))


def test_a_folder_that_cannot_be_written_keeps_nothing(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("not a folder")
    entries = Entries(tmp_path / "file" / "faces")
    assert not run(entries.write(KEY, thing()["openings"]))
    assert entries.trouble
    assert entries.read(KEY) is None
    assert entries.size() == entries.clear() == 0


def test_a_full_disk_leaves_what_was_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    entries = kept(tmp_path)

    def full(*_: Any) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("risorius.face.kept.entries._pieces", full)
    assert not run(entries.write(KEY, thing()["openings"]))
    assert entries.trouble == "No space left on device"
    assert [path.suffix for path in tmp_path.iterdir()] == [".face"]
    assert "polygons" in entries.read(KEY)


def test_stopped_half_way_it_leaves_nothing(tmp_path: Path) -> None:
    work = Entries(tmp_path).write(KEY, thing()["openings"])
    next(work)
    work.close()
    assert not list(tmp_path.iterdir())


def test_clearing_leaves_what_is_not_ours(tmp_path: Path) -> None:
    entries = kept(tmp_path)
    for name in ("notes.txt", "mine.face"):
        (tmp_path / name).write_text("mine")
    assert entries.clear() == 1
    assert sorted(path.name for path in tmp_path.iterdir()) == ["mine.face", "notes.txt"]
    assert entries.size() == 0


#: What each of several Blenders does at once: keeps and reads the same few things, for which there is hardly room.
BLENDER = """
import sys
import numpy as np
from risorius.face.kept.entries import Entries
from risorius.progress import run
number, count = int(sys.argv[2]), 150
entries = Entries(__import__("pathlib").Path(sys.argv[1]), most=400_000)
for turn in range(count):
    key = f"{turn % 3:064x}"
    assert run(entries.write(key, {"of": key, "numbers": np.full(20_000, turn % 3)})), entries.trouble
    found = entries.read(f"{(turn + number) % 3:064x}")
    if found is not None:
        assert (found["numbers"] == (turn + number) % 3).all() and len(found["numbers"]) == 20_000
    entries.size()
"""


@pytest.mark.slow
def test_several_blenders_use_a_folder_at_once(tmp_path: Path) -> None:
    """Each finds a whole thing or none, whoever writes, reads or makes room meanwhile; no piece is left."""
    blenders = [
        subprocess.Popen(
            [sys.executable, "-c", BLENDER, str(tmp_path / "kept"), str(number)],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        for number in range(3)
    ]
    for blender in blenders:
        said, _ = blender.communicate(timeout=120)
        assert blender.returncode == 0, said
    assert not list((tmp_path / "kept").glob("*.part"))


def test_a_file_that_another_has_deleted_is_left_out_and_the_others_count(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    entries = kept(tmp_path)
    run(entries.write(OTHER, thing()))
    gone, left = tmp_path.iterdir()  # the first that is looked at
    state, size = Path.stat, left.stat().st_size

    def stat(path: Path, **asked: Any) -> os.stat_result:
        if path == gone:
            raise FileNotFoundError(errno.ENOENT, "gone", str(path))
        return state(path, **asked)

    monkeypatch.setattr(Path, "stat", stat)
    assert entries.size() == size
