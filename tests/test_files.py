"""Files are written whole or not at all; what cannot be read is named with the remedy."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from risorius.errors import FormatError
from risorius.files import read_bytes, write_whole
from risorius.resources import PRESETS


def test_text_and_bytes_stand_as_they_are_and_nothing_else_is_left(tmp_path: Path) -> None:
    write_whole(tmp_path / "a", "one\ntwo é\n")
    write_whole(tmp_path / "b", b"\x00\x01")
    assert (tmp_path / "a").read_bytes() == "one\ntwo é\n".encode()
    assert (tmp_path / "b").read_bytes() == b"\x00\x01"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a", "b"]


def test_an_older_file_stays_where_the_new_one_cannot_be_put(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a").write_text("old")

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", full)
    with pytest.raises(FormatError, match="No space left"):
        write_whole(tmp_path / "a", "new")
    assert (tmp_path / "a").read_text() == "old"
    assert [path.name for path in tmp_path.iterdir()] == ["a"]


def test_a_folder_that_is_not_there_is_named(tmp_path: Path) -> None:
    with pytest.raises(FormatError, match=r"nowhere.*cannot be written"):
        write_whole(tmp_path / "nowhere" / "a", "new")
    (tmp_path / "file").write_text("old")
    with pytest.raises(FormatError, match=r"a: cannot be written \(Not a directory\)"):
        write_whole(tmp_path / "file" / "a", "new")


def test_a_file_that_cannot_be_read_is_named_with_the_remedy(tmp_path: Path) -> None:
    (tmp_path / "a").write_bytes(b"\x00")
    assert read_bytes(tmp_path / "a") == b"\x00"
    with pytest.raises(FormatError, match=r"absent: cannot be read \(No such file or directory\): give a file"):
        read_bytes(tmp_path / "absent")
    with pytest.raises(FormatError, match=r"cannot be read .*: install Risorius again"):
        read_bytes(PRESETS / "absent.toml")
    with pytest.raises(FormatError, match=r"absent.csv: cannot be read .*: give a file"):
        read_bytes(PRESETS.parent / "absent.csv")  # of somebody who works in a checkout
