"""What Windows and macOS ask of files: names, lengths, and text whose encoding is said."""

from __future__ import annotations

import ast
import os
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path, PurePosixPath

import numpy as np
import pytest
from places import ROOT
from risorius.api import FapStream, read_stream, write_fap
from risorius.errors import RisoriusError
from risorius.files import DEVICES, read_bytes, safe_stem, scratch_folder, write_whole
from risorius.tables import read_csv, read_toml

PRODUCT = [
    path for path in ROOT.rglob("*")
    if path.is_file() and path.relative_to(ROOT).parts[0] in
    ("batch", "cli", "face", "mpeg4", "operators", "physics", "presets", "scene", "speech", "tables", "track")
    and "__pycache__" not in path.parts
]  # fmt: skip
NAMES = [PurePosixPath(path.relative_to(ROOT).as_posix()) for path in PRODUCT]


def test_names_are_told_apart_whatever_their_case_and_are_no_devices() -> None:
    assert len(NAMES) > 400
    twice = [name for name, count in Counter(str(name).casefold() for name in NAMES).items() if count > 1]
    assert twice == []
    parts = {part.partition(".")[0].casefold() for name in NAMES for part in name.parts}
    assert not parts & DEVICES
    assert all(not set(str(name)) & set('<>:"|?*\\') and str(name).isascii() for name in NAMES)


def test_paths_leave_room_for_a_users_home() -> None:
    """Windows' 260 letters, less what Blender puts before an extension's files under a long user name."""
    assert max(len(str(name)) for name in NAMES) < 90


def test_text_is_opened_with_its_encoding() -> None:
    missing = []
    for path in PRODUCT:
        if path.suffix != ".py":
            continue
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and _opens_text(node) and not any(k.arg == "encoding" for k in node.keywords):
                missing.append(f"{path.relative_to(ROOT)}:{node.lineno}")
    assert missing == []


def _opens_text(call: ast.Call) -> bool:
    """Whether a call opens a file as text."""
    name = call.func.attr if isinstance(call.func, ast.Attribute) else getattr(call.func, "id", "")
    if name in ("read_text", "write_text"):
        return isinstance(call.func, ast.Attribute)  # functions of that name are the package's own
    owner = getattr(getattr(call.func, "value", None), "id", "")
    modes = [arg.value for arg in [*call.args, *(k.value for k in call.keywords if k.arg == "mode")]
             if isinstance(arg, ast.Constant) and isinstance(arg.value, str)]  # fmt: skip
    return name == "open" and owner not in ("wave", "os", "Image") and not any("b" in mode for mode in modes)


@pytest.mark.parametrize(
    ("name", "stem"),
    [("CON", "CON_"), ("aux", "aux_"), ("Lpt1", "Lpt1_"), ("a/b:c", "a_b_c"), ("", "Mine"), ("x" * 300, "x" * 100),
     ("Zoë lächelt", "Zoë lächelt"), ("笑" * 100, "笑" * 66), ("end. ", "end_"), ("../up", "___up")],
)  # fmt: skip
def test_a_users_name_becomes_a_file_on_every_system(name: str, stem: str) -> None:
    assert safe_stem(name, "Mine") == stem


def test_text_with_windows_ends_of_lines_is_read(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_bytes(b"\xef\xbb\xbf# a remark\r\nname,figure\r\none,1.5\r\n\r\n")
    (tmp_path / "a.toml").write_bytes(b'# a remark\r\nname = "one"\r\nfigure = 1.5\r\n')
    (row,) = read_csv(tmp_path / "a.csv", "name", "figure")
    table = read_toml(tmp_path / "a.toml")
    assert (row.text("name"), row.number("figure")) == (table.text("name"), table.number("figure")) == ("one", 1.5)


def test_odd_folders_are_written_to_and_read_from(tmp_path: Path) -> None:
    folder = tmp_path / "Zoë Müller's files" / "100% & more" / ("d" * 120) / ("e" * 120)
    folder.mkdir(parents=True)
    write_whole(folder / "été.toml", "a = 1\n")
    assert read_bytes(folder / "été.toml") == b"a = 1\n"
    assert [path.name for path in folder.iterdir()] == ["été.toml"]


def test_a_name_as_long_as_systems_take_is_written(tmp_path: Path) -> None:
    one, other = tmp_path / f"{'n' * 246}.fap", tmp_path / f"{'n' * 245}m.fap"
    write_whole(one, "1")
    write_whole(other, "2")
    assert (read_bytes(one), read_bytes(other)) == (b"1", b"2")
    assert len(list(tmp_path.iterdir())) == 2


def test_without_room_for_temporary_files_the_remedy_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:  # fmt: skip
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "gone"))
    with pytest.raises(RisoriusError, match=r"temporary files: cannot be written .*set TMPDIR"), scratch_folder():
        pass


#: What a program finds on systems that are not set up as ours: no UTF-8, no home.
ODD = [
    {"PYTHONIOENCODING": "ascii", "LC_ALL": "C", "PYTHONCOERCECLOCALE": "0"},
    {"PYTHONIOENCODING": "cp1252"},
    {"HOME": "/nonexistent", "XDG_CACHE_HOME": "/nonexistent", "TMPDIR": "/nonexistent", "APPDATA": "/nonexistent"},
]


@pytest.mark.slow
@pytest.mark.parametrize("odd", ODD, ids=["ascii", "cp1252", "no-home"])
def test_the_command_line_speaks_to_every_terminal(odd: dict[str, str], tmp_path: Path) -> None:
    """Names that the terminal has no letters for are written as escapes, and the work is done."""
    folder = tmp_path / "Zoë's 文件 & more"
    folder.mkdir()
    stream = FapStream(np.zeros((2, 68)), fps=25.0, name="笑")
    write_fap(folder / "文.fap", stream)
    for arguments in (["info", "文.fap"], ["convert", "文.fap", "笑.json"]):
        run = subprocess.run(
            [sys.executable, "-m", "risorius", "fap", *arguments],
            cwd=folder, env={**os.environ, "PYTHONUTF8": "0", **odd}, capture_output=True, timeout=100, check=False,
        )  # fmt: skip
        assert run.returncode == 0, run.stderr.decode(errors="replace")
    assert read_stream(folder / "笑.json").name == "笑"
