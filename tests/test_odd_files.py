"""What stands in a file's place that is none, or changes while it is read: each reader refuses it in words, in time."""

from __future__ import annotations

import os
import sys
import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
import risorius.api as api
import risorius.files
from risorius.batch.design import read_design
from risorius.batch.table import read_jobs
from risorius.cli import main
from risorius.cli.kept import kept_folder
from risorius.errors import FormatError, RisoriusError
from risorius.mpeg4.preset_file import read_preset
from risorius.tables import read_arrays, read_csv, read_json, read_toml

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="pipes, links and devices of Unix")

#: Reader -> the ending of what it reads.
READERS: dict[str, tuple[Callable[[Path], object], str]] = {
    "recording": (api.read_recording, ".csv"),
    "recording as JSON": (api.read_recording, ".json"),
    "stream": (api.read_stream, ".fap"),
    "bitstream": (api.read_stream, ".fba"),
    "timings": (api.read_timings, ".TextGrid"),
    "sound": (api.read_timings, ".wav"),
    "mesh": (api.read_mesh, ".obj"),
    "arrays of a mesh": (api.read_mesh, ".npz"),
    "points": (api.read_point_file, ".json"),
    "tables": (api.read_animation_tables, ".json"),
    "topology": (api.read_topology, ".toml"),
    "emotions": (lambda path: api.load_emotions([path], bundled=False), ".toml"),
    "preset": (read_preset, ".toml"),
    "jobs": (read_jobs, ".csv"),
    "jobs as TOML": (read_jobs, ".toml"),
    "design": (lambda path: read_design(str(path)), ".toml"),
    "TOML": (read_toml, ".toml"),
    "CSV": (read_csv, ".csv"),
    "JSON": (lambda path: read_json(path, kind="a", version=1), ".json"),
    "arrays": (lambda path: read_arrays(path, "a"), ".npz"),
}
#: What is more than any reader needs, seconds.
PATIENCE = 20.0


def in_time(call: Callable[[], object]) -> BaseException | None:
    """What a call raises; fails where it does not come back."""
    raised: list[BaseException] = []

    def work() -> None:
        try:
            call()
        except BaseException as error:
            raised.append(error)

    thread = threading.Thread(target=work, daemon=True)
    thread.start()
    thread.join(PATIENCE)
    assert not thread.is_alive(), "hangs"
    return raised[0] if raised else None


def folder(path: Path) -> None:
    path.mkdir()


def loop(path: Path) -> None:
    path.symlink_to(path.name)


def dangling(path: Path) -> None:
    path.symlink_to("nowhere")


def pipe(path: Path) -> None:
    os.mkfifo(path)


def endless(path: Path) -> None:
    path.symlink_to("/dev/zero")


def sparse(path: Path) -> None:
    with path.open("wb") as file:
        os.truncate(file.fileno(), (1 << 30) + 1)


def empty(path: Path) -> None:
    path.write_bytes(b"")


def blank(path: Path) -> None:
    path.write_bytes(b"\n \n\t\r\n" * 50)


def nulls(path: Path) -> None:
    path.write_bytes(b"\0" * 5000)


def unreadable(path: Path) -> None:
    path.write_bytes(b"a")
    path.chmod(0)
    if os.access(path, os.R_OK):
        pytest.skip("whoever runs this may read everything")


def utf16(path: Path) -> None:
    path.write_bytes("a,b\n1,2\n".encode("utf-16"))


#: What a reader may well take: nothing, or a folder of its files, says nothing.
TAKEN = {("folder", "emotions"), ("empty", "emotions"), ("blank", "emotions"), ("empty", "TOML"), ("blank", "TOML"),
         ("nulls", "CSV")}  # fmt: skip
ODD = (folder, loop, dangling, pipe, endless, sparse, empty, blank, nulls, unreadable, utf16)


@pytest.mark.parametrize("reader", READERS)
@pytest.mark.parametrize("odd", ODD)
def test_what_is_no_file_is_refused_in_words(
    odd: Callable[[Path], None], reader: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if (odd.__name__, reader) in TAKEN:
        return
    monkeypatch.setattr(risorius.files, "PATIENCE", 0.05)
    if odd is endless:
        monkeypatch.setattr(risorius.files, "LARGEST_FILE", 1 << 22)
    read, ending = READERS[reader]
    path = tmp_path / f"odd{ending}"
    odd(path)
    raised = in_time(lambda: read(path))
    assert isinstance(raised, RisoriusError), raised
    assert path.name in str(raised)
    assert len(str(raised)) < 1200


@pytest.mark.parametrize(
    "name", ["trailing. .csv", "ünïcode \N{SNOWMAN}.csv", "-x.csv", "a.b.c.csv", " .csv", "x" * 240]
)
def test_names_of_all_kinds_are_read_and_written(name: str, tmp_path: Path) -> None:
    path = tmp_path / name
    stream = api.FapStream(np.zeros((3, 68)), fps=25.0)
    api.write_stream(path, stream, "faps")
    assert len(api.read_stream(path, "faps").frames) == 3
    assert [left.name for left in tmp_path.iterdir()] == [name]


def test_a_pipe_is_read_as_a_file_is(tmp_path: Path) -> None:
    path = tmp_path / "take.csv"
    os.mkfifo(path)
    content = b"timestamp,jawOpen\n0,0\n0.04,0.5\n0.08,1\n"
    writer = threading.Thread(target=lambda: path.write_bytes(content), daemon=True)
    writer.start()
    assert risorius.files.read_bytes(path) == content
    writer.join(PATIENCE)


@pytest.mark.parametrize("change", ["cut", "grown", "gone", "replaced"])
def test_a_file_that_changes_while_it_is_read_is_read_or_refused(
    change: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Between two looks at one file: no reader takes halves of two for one without a word, and none breaks."""
    path = tmp_path / "take.csv"
    rows = [f"{n / 25:.2f},{n % 2}" for n in range(200)]
    path.write_text("timestamp,jawOpen\n" + "\n".join(rows), encoding="utf-8")
    changes: dict[str, Callable[[], object]] = {
        "cut": lambda: os.truncate(path, 30),
        "grown": lambda: path.write_text("timestamp,jawOpen\n" + "\n".join(rows * 3), encoding="utf-8"),
        "gone": lambda: path.unlink(missing_ok=True),
        "replaced": lambda: path.write_bytes(b"\0" * 500),
    }
    real = risorius.files.read_bytes

    def read(given: str | Path) -> bytes:
        found = real(given)
        changes[change]()
        return found

    for module in [found for name, found in sys.modules.items() if name.startswith("risorius") and found is not None]:
        if getattr(module, "read_bytes", None) is real:
            monkeypatch.setattr(module, "read_bytes", read)
    raised = in_time(lambda: api.read_recording(path))
    assert raised is None or isinstance(raised, RisoriusError), raised


def test_the_command_line_refuses_them_too(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "a.csv").mkdir()
    for arguments in (["import", "{}"], ["fap", "info", "{}"], ["export", "csv", "{}", "--out", "b.csv"],
                      ["recognise", "{}"], ["batch", "{}", "--out", str(tmp_path / "set")]):  # fmt: skip
        assert main([argument.format(tmp_path / "a.csv") for argument in arguments]) == 1
        assert "a.csv" in capsys.readouterr().err


@pytest.fixture(autouse=True)
def _rights(tmp_path: Path) -> Iterator[None]:
    """Give back what was taken, that the folder can go."""
    yield
    for path in tmp_path.iterdir():
        if path.is_file() and not path.is_symlink():
            path.chmod(0o600)


def test_what_cannot_be_written_leaves_what_was_there(tmp_path: Path) -> None:
    stream = api.FapStream(np.zeros((3, 68)), fps=25.0)
    (tmp_path / "there.fap").mkdir()
    for path in (tmp_path / "there.fap", tmp_path / "none" / "a.fap", tmp_path / "a\0.fap", Path("/dev/null/a.fap")):
        with pytest.raises(FormatError, match="cannot be written"):
            api.write_fap(path, stream)
    assert [path.name for path in tmp_path.iterdir()] == ["there.fap"]


@pytest.mark.parametrize("head", ["~nobody_of_this_name/a.npz", "x" * 5000, "a" * 300 + "/b.npz", "loop"])
def test_one_row_that_names_no_file_leaves_the_others(head: str, tmp_path: Path) -> None:
    (tmp_path / "loop").symlink_to("loop")
    table = tmp_path / "jobs.csv"
    table.write_text(f"id,emotion,head\na,joy,\nb,joy,{head}\n", encoding="utf-8")
    found = read_jobs(table)
    assert [job.id for job in found.jobs] == ["a"]
    assert "line 3" in str(found.problems[0])
    read_design(f"emotion=joy,fear head={head}")


def test_a_cache_in_nobodys_home_is_none(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("RISORIUS_CACHE", "~nobody_of_this_name/faces")
    assert kept_folder() is None
