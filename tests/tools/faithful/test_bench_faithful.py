"""The measuring of `make bench-faithful`: what it calls explained and met, its baselines, its page."""

from __future__ import annotations

from pathlib import Path

import bench_faithful as bench
import numpy as np
import pytest
import risorius.api as api
from faithful import baselines, heads, report, requests, scans
from places import OUT
from risorius.errors import FormatError, ParameterError
from risorius.face.drive.natural.synergies import load_synergies


def smile() -> object:
    """A smile of the default head as a shape to be explained."""
    face = api.default_face()
    frame = np.full(68, np.nan)
    frame[[11, 12, 58, 59]] = 200.0
    posed = face.pose(frame, drive="exact").positions
    skin = np.flatnonzero(np.asarray(face.parts) == api.Part.SKIN)
    return scans._shape(face, "smile", posed - face.vertices, skin)


def test_explained_is_one_for_itself_none_for_rest_and_less_than_none_for_the_opposite() -> None:
    shape = smile()
    assert shape.explained_by(shape.moved) == 1.0
    assert shape.explained_by(0.0 * shape.moved) == 0.0
    assert shape.explained_by(-shape.moved) == pytest.approx(-3.0)
    assert shape.explained_by(0.5 * shape.moved) == pytest.approx(0.75)


def test_baselines_move_the_points_as_asked_and_explain_less_than_the_face() -> None:
    face, shape = api.default_face(), smile()
    rows = face.anatomy.skin_rows
    wanted = rows.select(shape.frame)
    for name, model in baselines.baselines(face).items():
        moved = np.zeros_like(face.vertices)
        moved[shape.skin] = model(shape)
        corner = face.points["8.3"]
        shown = (corner.weights @ moved[corner.vertices]) @ rows.directions[rows.row_of[59]]
        doubt = 0.25 if name == "zones" else 1e-6  # zones share where they overlap, here with the inner corner's
        assert shown == pytest.approx(wanted[rows.row_of[59]], rel=doubt), name
    model = scans.posed(face)
    whole = shape.explained_by(model(shape))
    assert whole > 0.95
    for name in ("zones", "spline"):
        assert shape.explained_by(baselines.baselines(face)[name](shape)) < whole - 0.1, name


def test_the_fourteen_words_are_those_of_table_6() -> None:
    words = requests.words()
    assert len(words) == 14
    assert words[:3] == ["accepting", "terrified", "afraid"]
    assert "furious" not in words
    assert "fear" not in words


def test_a_request_is_within_its_range_or_beyond() -> None:
    data = load_synergies()
    row = data.row_of[3]
    end, knee = data.high[row] / data.per_fap[row], data.high_linear[row]
    for share, expected in ((0.9 * knee, (True, True)), (1.1 * knee, (False, True)), (1.1, (False, False))):
        frame = np.full(68, np.nan)
        frame[2] = share * end
        moderate, possible = requests.within_range(frame)
        assert (moderate[2], possible[2]) == expected, share
        assert not moderate[3:].any()


def test_errors_of_requests_are_shares_of_what_was_asked() -> None:
    class Stub:
        """A face that shows nine tenths of everything."""

        def pose(self, frame: np.ndarray, **_: object) -> object:
            return type("Pose", (), {"achieved": 0.9 * frame})

    profile = api.archetype("sadness", 0)
    found = requests.met(Stub(), api.Drive.EXACT, {"sadness:0": profile})
    asked = np.abs(profile.frame()[~np.isnan(profile.frame())])
    assert asked.min() < 100.0 < asked.max()
    assert found.errors == pytest.approx(0.1 * asked / np.maximum(asked, 100.0))


def test_absent_heads_and_unknown_ones_are_named(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("RISORIUS_SHARED", str(tmp_path))
    with pytest.raises(FormatError, match="RISORIUS_SHARED"):
        heads.heads_folder()
    with pytest.raises(ParameterError, match="makehuman"):
        heads.load_face("nobody")
    assert bench.main(["--no-pictures", "--heads", "ict", "--out", str(tmp_path)]) == 1
    assert not (tmp_path / "faithful.md").exists()


def test_the_page_tells_what_each_mechanism_is_worth() -> None:
    whole = {"jawOpen": 0.9, "smile": 0.8, "blink": 0.7}
    jawless = whole | {"jawOpen": 0.5}
    results = report.Results({"ict": whole}, {"zones": jawless}, {}, {"jaw": jawless}, {}, {})
    page = report.page(results)
    assert "| jaw | 0.700 | 0.667 | 0.50 | jawOpen −0.40 |" in page
    assert "| nothing | 0.800 | 0.800 | 0.70 |  |" in page
    assert "| jawOpen | 0.90 | 0.50 |" in page


def test_every_head_mechanism_and_picture_has_its_job() -> None:
    tables = bench.table_jobs(bench.HEADS)
    assert {name for kind, name in tables if kind == "requests"} == set(bench.HEADS)
    assert {m.value for m in api.Mechanism} < {name for kind, name in tables if kind == "without"}
    assert sum(kind == "scans" for kind, _ in tables) == 7
    pictures = bench.picture_jobs(bench.PICTURED, OUT, False)
    assert sum(kind == "apexes" for kind, _ in pictures) == 5
    assert ("comparison", "default") not in pictures
