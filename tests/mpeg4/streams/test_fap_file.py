"""The .fap reader and writer: what real files do, round trips, and errors with line and remedy."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from risorius.errors import FormatError, ParameterError
from risorius.mpeg4 import ExpressionField, FapStream, VisemeField, read_fap, write_fap

# Frames, rate, first number, stated values, and one value known from looking at the file.
SAMPLES = {
    "greta_au_interpolation_1131.fap": (1, 25.0, 0, 4, (0, 19, 626.0)),
    "vreng_anger.fap": (23, 10.0, 0, 23 * 18, (1, 32, -18.0)),
    "vreng_eyes.fap": (52, 2.0, 1, 52 * 8, (0, 19, 0.0)),
    "vreng_jag.fap": (169, 5.0, 0, 169 * 66, (0, 3, 57.0)),
    "vreng_sad.fap": (14, 10.0, 0, 14 * 18, (1, 52, -19.0)),
    "xface_anger.fap": (108, 25.0, 0, 108 * 48, (1, 4, 8.0)),
    "xface_fear.fap": (107, 25.0, 0, 107 * 50, (1, 3, 9.0)),
    "xface_joy.fap": (108, 25.0, 0, 108 * 42, (1, 4, 8.0)),
}


def _mask(*numbers: int, flags: int = 68) -> str:
    return " ".join("1" if number in numbers else "0" for number in range(1, flags + 1))


def _write(folder: Path, text: str | bytes) -> Path:
    path = folder / "some.fap"
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    return path


def _assert_same(one: FapStream, other: FapStream) -> None:
    np.testing.assert_array_equal(one.frames, other.frames)
    np.testing.assert_array_equal(one.mask, other.mask)
    assert (one.fps, one.name, one.first_frame, one.version) == (
        other.fps, other.name, other.first_frame, other.version,
    )  # fmt: skip
    assert (dict(one.visemes), dict(one.expressions)) == (dict(other.visemes), dict(other.expressions))


@pytest.mark.parametrize("name", SAMPLES)
def test_real_files_are_read_and_survive_a_round_trip(shared: Path, tmp_path: Path, name: str) -> None:
    stream = read_fap(shared / "samples" / "fap" / name)
    count, fps, first, stated, (frame, number, value) = SAMPLES[name]
    assert stream.frames.shape == stream.mask.shape == (count, 68)
    assert (stream.fps, stream.first_frame, int(stream.mask.sum())) == (fps, first, stated)
    assert stream.frames[frame, number - 1] == value
    np.testing.assert_array_equal(stream.mask, ~np.isnan(stream.frames))
    write_fap(tmp_path / name, stream)
    _assert_same(read_fap(tmp_path / name), stream)


def test_a_name_with_blanks_and_a_windows_path(shared: Path) -> None:
    folder = shared / "samples" / "fap"
    assert read_fap(folder / "greta_au_interpolation_1131.fap").name == "AU Interpolation_1131.fap"
    assert read_fap(folder / "xface_joy.fap").name.startswith("C:\\Users\\")


def test_values_go_to_the_faps_the_mask_names(shared: Path) -> None:
    """Read the widest sample again by another way: split tokens, no lines."""
    path = shared / "samples" / "fap" / "vreng_jag.fap"
    tokens = path.read_text().split()[4:]
    stream = read_fap(path)
    for frame in (0, 77, 168):
        block = tokens[frame * (68 + 67) : (frame + 1) * (68 + 67)]
        assert block[:2] == ["0", "0"]
        assert int(block[68]) == frame
        np.testing.assert_array_equal(stream.frames[frame, 2:], np.array(block[69:], dtype=float))


def test_variants_met_in_the_wild(tmp_path: Path) -> None:
    text = (
        "# a comment\r\n\r\n2.2  my  file 29.97 10000\r\n"
        f"{_mask(3, 31, flags=69)} \r\n3\t-10\t 20.5 \r\n"
        f"# another\r\n{_mask(5)}\r\n6 inf\r\n"
    )
    stream = read_fap(_write(tmp_path, text))
    assert (stream.name, stream.fps, stream.version, stream.first_frame) == ("my file", 29.97, "2.2", 3)
    assert stream.frames.shape == (4, 68)  # frames 4 and 5 are missing: they state nothing
    assert stream.frames[0, [2, 30]].tolist() == [-10.0, 20.5]
    assert stream.mask.sum(axis=1).tolist() == [2, 0, 0, 0]  # and inf is no statement


def test_a_byte_order_mark_and_an_old_code_page(tmp_path: Path) -> None:
    body = f"{_mask(3)}\n0 1\n".encode()
    assert read_fap(_write(tmp_path, b"\xef\xbb\xbf2.1 x 25 1\n" + body)).name == "x"
    assert read_fap(_write(tmp_path, b"2.1 b\xf6se 25 1\n" + body)).name == "böse"
    assert read_fap(_write(tmp_path, b"2.1 25 1\n" + body)).name == ""


def test_the_mask_may_change_between_frames(tmp_path: Path) -> None:
    stream = read_fap(_write(tmp_path, f"2.1 x 25 2\n{_mask(3, 4)}\n0 1 2\n{_mask(68)}\n1 9\n"))
    assert stream.frames[0, [2, 3]].tolist() == [1.0, 2.0]
    assert stream.frames[1, 67] == 9.0
    assert np.isnan(stream.frames[1, 2])


def test_high_level_faps_keep_their_sub_fields(tmp_path: Path) -> None:
    text = f"2.1 x 25 2\n{_mask(1, 2, 3)}\n0 4 5 40 1  6 63 1 20 0 1  77\n{_mask(3)}\n1 78\n"
    stream = read_fap(_write(tmp_path, text))
    assert stream.visemes == {0: VisemeField(4, 5, 40, 1)}
    assert stream.expressions == {0: ExpressionField(6, 63, 1, 20, 0, 1)}
    assert stream.frames[0, 2] == 77.0
    assert np.isnan(stream.frames[:, :2]).all()
    assert stream.mask[:, :3].tolist() == [[True, True, True], [False, False, True]]
    write_fap(tmp_path / "again.fap", stream)
    _assert_same(read_fap(tmp_path / "again.fap"), stream)


def test_a_viseme_packed_in_one_number(tmp_path: Path) -> None:
    packed = (4 * 10000 + 100000) + (5 * 100 + 1000) + (40 + 10)
    stream = read_fap(_write(tmp_path, f"2.1 x 25 1\n{_mask(1, 3)}\n0 {packed} 77\n"))
    assert stream.visemes == {0: VisemeField(4, 5, 40, 0)}
    assert stream.frames[0, 2] == 77.0


HEADER = "2.1 x 25 1\n"


@pytest.mark.parametrize(
    ("text", "line", "says"),
    [
        ("", None, "is empty"),
        ("hello\n", 1, "version name fps frames"),
        ("3.1 x 25 1\n", 1, "body animation"),
        ("2.7 x 25 1\n", 1, "2.0, 2.1, 2.2"),
        ("2.1 x fast 1\n", 1, "frame rate must be a positive number, but it is 'fast'"),
        ("2.1 x 0 1\n", 1, "frame rate"),
        ("2.1 x 25 many\n", 1, "frame count"),
        (HEADER, 1, "contains no frame"),
        (f"{HEADER}{_mask(3)}\n", 2, "cut off"),
        (f"{HEADER}# note\n{_mask(3, flags=67)}\n0 1\n", 3, "68 flags .* has 67"),
        (f"{HEADER}{_mask(3, 69, flags=69)}\n0 1 2\n", 2, "68 flags"),
        (f"{HEADER}{_mask(3)[:-1]}2\n0 1\n", 2, "flag 68 must be 0 or 1, but it is '2'"),
        (f"{HEADER}{_mask(3, 4)}\n0 1\n", 3, "requires 3 numbers .* has 2"),
        (f"{HEADER}{_mask(3)}\n0 1 2\n", 3, "requires 2 numbers .* has 3"),
        (f"{HEADER}{_mask(3)}\n0 1,5\n", 3, "value 2 must be a number, but it is '1,5'"),
        (f"{HEADER}{_mask(3)}\n0 nan\n", 3, "value 2 must be a number"),
        (f"{HEADER}{_mask(3)}\n0 1_0\n", 3, "value 2 must be a number"),
        (f"{HEADER}{_mask(3)}\n0.5 1\n", 3, "frame number"),
        (f"{HEADER}{_mask(3)}\n-1 1\n", 3, "frame number"),
        (f"{HEADER}{_mask(3)}\ninf 1\n", 3, "frame number"),
        (f"{HEADER}{_mask(3)}\n1 1\n{_mask(3)}\n1 2\n", 5, "frame 1 comes after frame 1"),
        (f"{HEADER}{_mask(3)}\n0 1\n{_mask(3)}\n99999999 2\n", 5, "more than 10000 frames after 0"),
        (f"{HEADER}{_mask(3)}\n99999999999 1\n", 3, "frame number must be"),
        (f"{HEADER}{_mask(3, 4)}\n0 1 2e7\n", 3, "value 3 must be within 10000000 FAP units, but it is"),
        (f"{HEADER}{_mask(3)}\n0 1e999\n", 3, "value 2 must be a number"),
        (f"2.1 x 1e999 1\n{_mask(3)}\n0 1\n", 1, "frame rate"),
        (f"{HEADER}{_mask(1)}\n0 4.5 0 0 0\n", 3, "sub-field of FAP 1 or 2 must be a whole number"),
        (f"{HEADER}{_mask(1)}\n0 145050.5\n", 3, "must be a whole number"),
        (f"{HEADER}{_mask(1)}\n0 15 0 0 0\n", 3, r"viseme_select1 must be a whole number in 0\.\.14"),
        (f"{HEADER}{_mask(2)}\n0 1 64 0 0 0 0\n", 3, "expression_intensity1"),
        (f"{HEADER}{_mask(1)}\n0 inf 0 0 0\n", 3, "must be a whole number"),
    ],
)
def test_a_damaged_file_names_line_and_remedy(tmp_path: Path, text: str, line: int | None, says: str) -> None:
    path = _write(tmp_path, text)
    with pytest.raises(FormatError, match=says) as caught:
        read_fap(path)
    assert caught.value.path == path
    assert caught.value.line == line


def test_no_file_and_a_binary_file(tmp_path: Path) -> None:
    with pytest.raises(FormatError, match="cannot be read"):
        read_fap(tmp_path / "none.fap")
    with pytest.raises(FormatError, match="binary"):
        read_fap(_write(tmp_path, b"\x00\x00\x01\xba"))


def test_an_unwritable_place_is_refused_and_leaves_nothing(tmp_path: Path) -> None:
    stream = FapStream(np.zeros((1, 68)))
    with pytest.raises(FormatError, match="cannot be written"):
        write_fap(tmp_path / "missing" / "x.fap", stream)
    (tmp_path / "folder.fap").mkdir()
    with pytest.raises(FormatError, match="cannot be written"):
        write_fap(tmp_path / "folder.fap", stream)
    assert [path.name for path in tmp_path.iterdir()] == ["folder.fap"]


def test_values_are_rounded_to_whole_numbers_unless_asked(tmp_path: Path) -> None:
    frames = np.full((1, 68), np.nan)
    frames[0, [2, 3, 4]] = -0.3, 12.346, 100.0
    path = tmp_path / "x.fap"
    write_fap(path, FapStream(frames, fps=24000 / 1001, name="two words"))
    lines = path.read_bytes().decode().splitlines()
    assert lines[0] == "2.1 two words 23.976023976023978 1"
    assert lines[2] == "0 0 12 100"
    assert b"\r" not in path.read_bytes()
    write_fap(path, FapStream(frames), decimals=2)
    assert path.read_text().splitlines()[2] == "0 -0.3 12.35 100"
    with pytest.raises(ParameterError, match="decimals"):
        write_fap(path, FapStream(frames), decimals=-1)


def test_a_stream_that_could_not_be_read_again_is_not_written(tmp_path: Path) -> None:
    path = tmp_path / "x.fap"
    with pytest.raises(ParameterError, match="at least one frame"):
        write_fap(path, FapStream(np.empty((0, 68))))
    with pytest.raises(ParameterError, match="10000000 FAP units"):
        write_fap(path, FapStream(np.full((1, 68), 1e8)))
    assert not path.exists()


def test_frames_in_all_too_many_are_refused(tmp_path: Path) -> None:
    """Each gap is allowed, their sum is not: no memory is spent on it."""
    text = "2.1 x 25 1\n" + "".join(f"{_mask(3)}\n{number} 1\n" for number in range(0, 1_000_001, 10_000))
    with pytest.raises(FormatError, match="more than 1000000 frames"):
        read_fap(_write(tmp_path, text))


cells = st.integers(-99999, 99999).map(float) | st.just(float("nan"))
streams = st.builds(
    FapStream,
    frames=st.lists(st.lists(cells, min_size=68, max_size=68), min_size=1, max_size=4).map(np.array),
    fps=st.sampled_from([1.0, 24.0, 25.0, 29.97, 60.0]),
    name=st.lists(st.from_regex(r"[!-~]{1,8}", fullmatch=True), max_size=3).map(" ".join),
    visemes=st.dictionaries(
        st.just(0), st.builds(VisemeField, *(st.integers(0, top) for top in (14, 14, 63, 1))), max_size=1
    ),
    expressions=st.dictionaries(
        st.just(0), st.builds(ExpressionField, *(st.integers(0, top) for top in (6, 63, 6, 63, 1, 1))), max_size=1
    ),
    first_frame=st.integers(0, 9),
    version=st.sampled_from(["2.0", "2.1", "2.2"]),
)


@pytest.mark.slow
@given(streams)
def test_any_stream_of_whole_numbers_survives_a_round_trip(
    tmp_path_factory: pytest.TempPathFactory, stream: FapStream
) -> None:
    path = tmp_path_factory.mktemp("fap") / "x.fap"
    write_fap(path, stream)
    _assert_same(read_fap(path), stream)


def test_a_stream_checks_its_parts() -> None:
    frames = np.zeros((2, 68))
    with pytest.raises(ParameterError, match=r"\(T, 68\)"):
        FapStream(np.zeros((2, 67)))
    with pytest.raises(ParameterError, match="fps"):
        FapStream(frames, fps=0.0)
    with pytest.raises(ParameterError, match="name"):
        FapStream(frames, name="two\nlines")
    with pytest.raises(ParameterError, match="mask"):
        FapStream(frames, mask=np.zeros((2, 68), dtype=bool))
    with pytest.raises(ParameterError, match="visemes"):
        FapStream(frames, visemes={2: VisemeField(1)})
    with pytest.raises(ParameterError, match="finite"):
        FapStream(np.full((1, 68), np.inf))
    assert FapStream(frames).mask[:, 2:].all()
    assert not FapStream(frames).mask[:, :2].any()


tokens = st.sampled_from(
    ["0", "1", "2", "-5", "63", "1e5", "inf", "nan", "1e999", "99999999", "x", "145050", "0.5", "_"]
)
lines = st.one_of(
    st.lists(tokens, max_size=8).map(" ".join),
    st.lists(st.sampled_from(["0", "0", "0", "1"]), min_size=66, max_size=70).map(" ".join),
    st.sampled_from(["2.1 x 25 1", "3.1 x 25 1", "# note", "", _mask(1, 2, 3), "0 1 2 3 4 1 2 3 4 1 1 9"]),
)
texts = st.lists(lines, max_size=8).map(lambda rows: "\n".join(["2.1 x 25 1", *rows]).encode())


def read_or_refused(path: Path) -> FapStream | FormatError:
    """What the reader makes of a file; any other exception is a failure."""
    try:
        return read_fap(path)
    except FormatError as error:
        return error


@given(st.binary(max_size=300) | texts)
def test_any_bytes_are_a_stream_or_a_format_error(tmp_path_factory: pytest.TempPathFactory, data: bytes) -> None:
    folder = tmp_path_factory.mktemp("fuzz")
    read = read_or_refused(_write(folder, data))
    if isinstance(read, FapStream):
        write_fap(folder / "again.fap", read, decimals=9)
        _assert_same(read_fap(folder / "again.fap"), read)
    else:
        assert read.path == folder / "some.fap"


@given(st.integers(0, 4500), st.binary(min_size=1, max_size=3))
def test_a_damaged_sample_is_a_stream_or_names_the_line(
    shared: Path, tmp_path_factory: pytest.TempPathFactory, place: int, junk: bytes
) -> None:
    good = (shared / "samples" / "fap" / "vreng_anger.fap").read_bytes()
    read = read_or_refused(_write(tmp_path_factory.mktemp("fuzz"), good[:place] + junk + good[place + len(junk) :]))
    assert isinstance(read, FapStream) or read.line is not None or read.offset is not None


@given(st.integers(0, 4590))
def test_a_sample_that_is_cut_off_is_shorter_or_names_the_line(
    shared: Path, tmp_path_factory: pytest.TempPathFactory, length: int
) -> None:
    whole = shared / "samples" / "fap" / "vreng_anger.fap"
    read = read_or_refused(_write(tmp_path_factory.mktemp("cut"), whole.read_bytes()[:length]))
    if isinstance(read, FapStream):
        np.testing.assert_array_equal(read.frames[:-1], read_fap(whole).frames[: len(read.frames) - 1])
    else:
        assert read.line is not None or length == 0
