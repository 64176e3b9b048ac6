"""FAP streams as JSON: nothing is lost, and damage names its key."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from risorius.errors import FormatError
from risorius.mpeg4 import ExpressionField, FapStream, VisemeField, read_fap, read_fap_json, write_fap_json

NAMES = ("greta_au_interpolation_1131", "vreng_eyes", "vreng_jag", "xface_joy")


def assert_same(one: FapStream, other: FapStream) -> None:
    np.testing.assert_array_equal(one.frames, other.frames)
    np.testing.assert_array_equal(one.mask, other.mask)
    assert (one.fps, one.name, one.first_frame, one.version) == (
        other.fps, other.name, other.first_frame, other.version,
    )  # fmt: skip
    assert (dict(one.visemes), dict(one.expressions)) == (dict(other.visemes), dict(other.expressions))


@pytest.mark.parametrize("name", NAMES)
def test_samples_survive(shared: Path, tmp_path: Path, name: str) -> None:
    stream = read_fap(shared / "samples" / "fap" / f"{name}.fap")
    write_fap_json(tmp_path / "x.json", stream)
    assert_same(read_fap_json(tmp_path / "x.json"), stream)


def example() -> FapStream:
    frames = np.full((3, 68), np.nan)
    frames[[0, 2], 2] = 1.25, -1e5
    return FapStream(
        frames, fps=24000 / 1001, name="böse x", visemes={1: VisemeField(4, 5, 40, 1)},
        expressions={0: ExpressionField(6, 63, 1, 20, 0, 1)}, first_frame=7, version="2.0",
    )  # fmt: skip


def test_everything_a_stream_knows_survives(tmp_path: Path) -> None:
    write_fap_json(tmp_path / "x.json", example())
    assert_same(read_fap_json(tmp_path / "x.json"), example())
    document = json.loads((tmp_path / "x.json").read_text())
    assert document["faps"] == ["open_jaw"]
    assert document["frames"] == [[1.25], [None], [-1e5]]


@pytest.mark.parametrize(
    ("change", "key"),
    [
        ({"format": "else"}, "format"),
        ({"version": 9}, "format"),
        ({"faps": ["open_jaws"]}, "faps"),
        ({"faps": ["open_jaw", "open_jaw"]}, "faps"),
        ({"faps": ["viseme"]}, "faps"),
        ({"faps": [3]}, "faps"),
        ({"frames": 3}, "frames"),
        ({"frames": [[1], [2, 3]]}, "frames.1"),
        ({"frames": [["1"]]}, "frames.0"),
        ({"frames": [[float("inf")]]}, "frames.0"),
        ({"fps": "fast"}, "fps"),
        ({"fps": 0}, None),
        ({"name": 3}, "name"),
        ({"visemes": {"one": [1, 0, 63, 0]}}, "visemes"),
        ({"visemes": {"0": [1, 0, 64, 0]}}, None),
        ({"visemes": {"0": [1, 0, 6, 0, 0]}}, None),
        ({"visemes": {"9": [1, 0, 6, 0]}}, None),
        ({"expressions": [1]}, "expressions"),
        ({"first_frame": -1}, None),
    ],
)
def test_damage_names_the_key(tmp_path: Path, change: dict[str, object], key: str | None) -> None:
    path = tmp_path / "x.json"
    write_fap_json(path, example())
    path.write_text(json.dumps({**json.loads(path.read_text()), **change}))
    with pytest.raises(FormatError) as caught:
        read_fap_json(path)
    assert (caught.value.path, caught.value.key) == (path, key)


values = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=3), inner, max_size=3),
    max_leaves=8,
)


@given(
    st.sampled_from(["faps", "frames", "fps", "name", "visemes", "expressions", "first_frame", "file_version"]), values
)
def test_any_value_is_a_stream_or_a_format_error(
    tmp_path_factory: pytest.TempPathFactory, key: str, value: object
) -> None:
    path = tmp_path_factory.mktemp("json") / "x.json"
    write_fap_json(path, example())
    path.write_text(json.dumps({**json.loads(path.read_text()), key: value}))
    try:
        assert read_fap_json(path).frames.shape[1] == 68
    except FormatError as error:
        assert str(path) in str(error)  # noqa: PT017  (a stream is as good)


def test_what_is_no_stream(tmp_path: Path) -> None:
    path = tmp_path / "x.json"
    with pytest.raises(FormatError, match="cannot be read"):
        read_fap_json(path)
    wrong = (("{", "not valid JSON"), ("[1]", "must be"), ("nul", "not valid JSON"), ("\xff", "can't decode byte"))
    for text, told in wrong:
        path.write_text(text, encoding="latin-1")
        with pytest.raises(FormatError, match=told):
            read_fap_json(path)
    with pytest.raises(FormatError, match="cannot be written"):
        write_fap_json(tmp_path / "none" / "x.json", example())
