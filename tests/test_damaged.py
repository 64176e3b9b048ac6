"""What is damaged in ways that Python and NumPy do not refuse by themselves: too large, too deep, out of order."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
import risorius.files
from risorius import api
from risorius.errors import FormatError, ParameterError, RisoriusError
from risorius.tables import parsed_json, parsed_number, read_arrays, read_toml

LONG = "9" * 5000


def test_numbers_beyond_use_are_none() -> None:
    assert parsed_number("1e308") == parsed_number("1e400") == parsed_number(LONG) == np.inf
    assert parsed_number("-" + LONG) == -np.inf
    assert (parsed_number("12"), parsed_number("1e30"), parsed_number("1_0")) == (12, 1e30, None)
    assert parsed_json(f"[1e308, {LONG}, -1e300, 7, 1e10]") == [np.inf, np.inf, -np.inf, 7, 1e10]


def test_nesting_is_bounded_and_brackets_in_texts_are_none() -> None:
    assert parsed_json("[" * 100 + "]" * 100)
    with pytest.raises(ValueError, match="more than 100 deep"):
        parsed_json("[" * 101 + "]" * 101)
    with pytest.raises(ValueError, match="more than 100 deep"):
        parsed_json('{"a":' * 100_000)
    assert parsed_json('["' + "[{" * 300 + '", "\\"' + "[" * 200 + '"]')


BAD = {
    "long.toml": (read_toml, f"a = {LONG}"),
    "deep.toml": (read_toml, "a = " + "[" * 100_000),
    "long.json": (api.read_point_file, f'{{"8.4": {LONG}}}'),
    "far.json": (api.read_point_file, '{"8.4": [0, 1e308, 0]}'),
    "list.json": (api.read_point_file, '{"points": {"8.4": 1}, "no_vertex": 5}'),
    "names.json": (api.read_point_file, '{"points": {"8.4": 1}, "no_vertex": ["2.1"], "xyz": [1]}'),
    "far.obj": (api.read_mesh, "v 0 0 1e308\nf 1 1 1\n"),
    "nan.obj": (api.read_mesh, "v 0 0 nan\nf 1 1 1\n"),
    "outside.obj": (api.read_mesh, "v 0 0 0\nf 1 2 3\n"),
    "late.csv": (api.read_timings, "start,end,phoneme\n0.1,1e300,m\n"),
    "later.json": (api.read_timings, '[{"start": 0, "end": 1e20, "phoneme": "p"}]'),
    "order.txt": (
        api.read_recording,
        "info,Face Cap,1.0\nk,1,0,0,0,1,2,3,0,0,0,0,0\nbs,jawOpen\nk,2,0,0,0,1,2,3,0,0,0,0,0,1\n",
    ),
    "apart.json": (
        api.read_recording,
        '{"columns": ["timestamp", "jawOpen"], "data": [[-9e18, 0], [0.04, 1], [0.08, 2], [0.12, 1]]}',
    ),
    "huge.csv": (api.read_recording, "timestamp,jawOpen\n0,1e300\n0.04,0.2\n0.08,0.3\n"),
}  # fmt: skip


@pytest.mark.parametrize("name", BAD)
def test_damage_is_refused_by_name(name: str, tmp_path: Path) -> None:
    read, text = BAD[name]
    (tmp_path / name).write_text(text, encoding="utf-8")
    with pytest.raises(FormatError, match=name) as refused:
        read(tmp_path / name)
    assert len(str(refused.value)) < 1000 + len(str(tmp_path))


def test_speech_marks_need_no_words(tmp_path: Path) -> None:
    marks = ['{"time":100,"type":"viseme","value":"p"}', '{"time":200,"type":"viseme","value":"sil"}']
    (tmp_path / "marks.json").write_text("\n".join(marks), encoding="utf-8")
    assert [sound.symbol for sound in api.read_timings(tmp_path / "marks.json").sounds] == ["p"]


def test_arrays_that_no_file_of_use_has_are_refused(tmp_path: Path) -> None:
    import zipfile

    np.savez(tmp_path / "a.npz", vertices=np.zeros((4, 3)), polygons=np.array([[0, 1, np.nan]]))
    with pytest.raises(FormatError, match="whole numbers"):
        api.read_mesh(tmp_path / "a.npz")
    np.savez(tmp_path / "b.npz", vertices=np.zeros((4, 3)), loops=np.arange(3), face_sizes=np.array([4, -1]))
    with pytest.raises(FormatError, match="face_sizes"):
        api.read_mesh(tmp_path / "b.npz")
    told = b"{'descr': '<f8', 'fortran_order': False, 'shape': (99999999999, 3), }".ljust(118)
    header = b"\x93NUMPY\x01\x00\x76\x00" + told
    with zipfile.ZipFile(tmp_path / "c.npz", "w") as archive:
        archive.writestr("vertices.npy", header)
    with pytest.raises(FormatError, match=r"not an \.npz"):
        read_arrays(tmp_path / "c.npz", "vertices")


@pytest.mark.skipif(not Path("/dev/zero").exists(), reason="no device that never ends")
def test_a_file_without_end_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(risorius.files, "LARGEST_FILE", 10_000_000)
    with pytest.raises(FormatError, match="is larger than"):
        risorius.files.read_bytes("/dev/zero")


def test_a_huge_file_is_refused_before_it_is_read(tmp_path: Path) -> None:
    with (tmp_path / "huge.csv").open("wb") as file:
        os.truncate(file.fileno(), 1 << 34)
    with pytest.raises(FormatError, match="is larger than 1 GiB: cut it"):
        api.read_recording(tmp_path / "huge.csv")


@pytest.mark.parametrize("path", ["a\0b.json", "."])
def test_a_path_that_names_no_file_is_refused(path: str) -> None:
    with pytest.raises(RisoriusError, match="cannot be read"):
        risorius.files.read_bytes(path)


def test_expressions_that_never_end_are_refused() -> None:
    with pytest.raises(ParameterError, match="must end within 1000000 frames"):
        api.sequence([api.Cue(api.expression("joy"), onset=0.1, apex=1e12, offset=0.1)])
    frames = [api.envelope(api.expression("joy"), onset=onset, apex=1.0, offset=0.1) for onset in (0.0, 1e-320)]
    np.testing.assert_array_equal(*frames)


def test_values_that_no_face_shows_are_refused() -> None:
    frame = np.full(68, np.nan)
    frame[2] = 1e8
    with pytest.raises(ParameterError, match=r"FAP 3 must be within"):
        api.default_face().pose(frame)
    with pytest.raises(ParameterError, match="frames must be finite, within 10000000 FAP units"):
        api.FapStream(frame[None])


def test_messages_are_short_and_keep_the_remedy() -> None:
    error = FormatError("a.json", "must be a number, but it is " + "[" * 100_000 + ": correct it", key="k" * 5000)
    assert len(str(error)) < 1000
    assert str(error).endswith(": correct it")
    assert len(str(ParameterError("x", "must be small", "y" * 10_000))) < 400
