"""Tables as spreadsheets and programs of all countries write them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from risorius import api
from risorius.errors import FormatError

PLAIN = [["timestamp", "jawOpen", "eyeBlinkLeft"], *([f"{n / 25:.2f}", f"{n / 8:.3f}", "0.250"] for n in range(8))]


def lines(mark: str, *, comma: bool = False, quote: str = "") -> list[str]:
    """The table with other marks."""
    return [mark.join(quote + (cell.replace(".", ",") if comma else cell) + quote for cell in row) for row in PLAIN]


def text(*args: str, **options: object) -> bytes:
    """As a file."""
    return ("\n".join(lines(*args, **options)) + "\n").encode()  # type: ignore[arg-type]


def numbered(name: str) -> bytes:
    """With a column of row numbers before the others."""
    return "\n".join(f"{number - 1 if number else name},{line}" for number, line in enumerate(lines(","))).encode()


FORMS = {
    "plain": text(","),
    "semicolons": text(";"),
    "semicolons and decimal commas": text(";", comma=True),
    "tabs": text("\t"),
    "tabs and decimal commas": text("\t", comma=True),
    "bars": text("|"),
    "a first line that says the mark": b"sep=;\r\n" + text(";", comma=True),
    "a first line that says a comma": b"sep=,\n" + text(","),
    "quotes": text(",", quote='"'),
    "quotes around decimal commas": text(",", quote='"', comma=True),
    "whole lines in quotes": "\n".join(f'"{line}"' for line in lines(",")).encode(),
    "a byte order mark": b"\xef\xbb\xbf" + text(","),
    "UTF-16": text("\t").decode().encode("utf-16"),
    "carriage returns": text(",").replace(b"\n", b"\r\n"),
    "commas at the ends": text(",").replace(b"\n", b",\n"),
    "many commas at the ends": text(",").replace(b"\n", b",,,\n"),
    "commas at the ends of rows": text(",").replace(b"0.250\n", b"0.250,,\n"),
    "blanks": text(" , "),
    "blank lines": text(",").replace(b"\n", b"\n\n"),
    "a remark above": b"# made by a logger\n" + text(","),
    "an index column": numbered(""),
    "a named index column": numbered("Unnamed: 0"),
}  # fmt: skip


@pytest.mark.parametrize("form", sorted(FORMS))
def test_a_table_in_every_form(form: str, tmp_path: Path) -> None:
    (tmp_path / "plain.csv").write_bytes(FORMS["plain"])
    (tmp_path / "a.csv").write_bytes(FORMS[form])
    expected, found = (api.read_recording(tmp_path / name) for name in ("plain.csv", "a.csv"))
    assert (found.format, found.stream.fps, found.assumed) == ("arkit", 25.0, ())
    np.testing.assert_allclose(found.stream.frames, expected.stream.frames)


def test_openface_saved_again_in_another_country(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text(
        "frame;face_id;timestamp;confidence;success;AU12_r;AU15_r\n1;0;0,000;0,980;1;2,50;0,00\n2;0;0,033;0,980;1;5,00;0,00\n"
    )
    smile = api.load_shapes()["mouthSmileLeft"].frame[59 - 1] + api.load_shapes()["mouthSmileRight"].frame[59 - 1]
    np.testing.assert_allclose(api.read_stream(tmp_path / "a.csv").frames[:, 59 - 1], [smile / 2.0, smile])


def test_live_link_face_saved_again_in_another_country(tmp_path: Path) -> None:
    rows = [f"10:00:00:{n:02d},{n:03d};61;0,{n}" for n in range(9)]
    (tmp_path / "a.csv").write_text("\n".join(["Timecode;BlendShapeCount;JawOpen", *rows]))
    stream = api.read_stream(tmp_path / "a.csv")
    assert (len(stream.frames), round(stream.fps)) == (9, 60)
    np.testing.assert_allclose(
        stream.frames[:, 2], [api.load_shapes()["jawOpen"].frame[2] * n / 10 for n in range(9)], rtol=0.01
    )


def test_decimal_commas_between_commas_are_refused_with_the_remedy(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("timestamp,jawOpen\n0,00,0,10\n0,04,0,20\n")
    with pytest.raises(FormatError, match=r"line 2: has 4 cells, but the heading has 2: .*semicolons"):
        api.read_stream(tmp_path / "a.csv")


def test_a_row_that_ends_within_what_was_seen_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("timestamp,jawOpen,eyeBlinkLeft\n0,0,0\n0.04,0.1\n")
    with pytest.raises(FormatError, match=r"line 3: has 2 cells, but the heading has 3: is the file cut off here?"):
        api.read_stream(tmp_path / "a.csv")
