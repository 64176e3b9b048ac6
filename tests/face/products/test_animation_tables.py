"""Face Animation Tables: what they play, how far from the full solution, and their files."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest
import risorius.api as api
from risorius.api import AnimationTable, AnimationTables, Face
from risorius.errors import FormatError, ParameterError
from risorius.face.products.animation_table_building import MOVED, distance, table_borders, table_ranges
from risorius.face.products.animation_tables import TableError

#: The mouth's FAPs, and one of every other kind: lid, eye, brow, head.
MOUTH = (*range(3, 19), *range(51, 61))
SOME = (*MOUTH, 19, 23, 31, 48)


@pytest.fixture(scope="module")
def tables(face: Face) -> AnimationTables:
    """Tables of some FAPs of the default head."""
    return api.face_animation_tables(face, faps=SOME, steps=3)


def frame_of(**values: float) -> np.ndarray:
    """A frame with FAPs by number ("f3")."""
    frame = np.full(68, np.nan)
    for name, value in values.items():
        frame[int(name[1:]) - 1] = value
    return frame


def small() -> AnimationTables:
    """One FAP, two vertices of three, slopes that can be reckoned in the head."""
    slopes = np.array([[[1.0, 0, 0], [0, 0, 2.0]], [[0, 1.0, 0], [0, 0, 0]], [[0, 3.0, 0], [0, 0, 0]]])
    table = AnimationTable(3, 0.001, np.array([-100, 0, 50, 100]), np.array([2, 0]), slopes)
    return AnimationTables(np.zeros((3, 3)), {3: table})


@pytest.mark.parametrize(
    ("value", "of_two", "of_zero"),
    [
        (0.0, (0, 0, 0), (0, 0, 0)),
        (-40.0, (-0.04, 0, 0), (0, 0, -0.08)),
        (40.0, (0, 0.04, 0), (0, 0, 0)),
        (70.0, (0, 0.05 + 0.06, 0), (0, 0, 0)),
        (200.0, (0, 0.05 + 0.45, 0), (0, 0, 0)),
        (-200.0, (-0.2, 0, 0), (0, 0, -0.4)),
    ],
)
def test_a_value_walks_up_or_down_from_zero(
    value: float, of_two: tuple[float, ...], of_zero: tuple[float, ...]
) -> None:
    played = small().play(frame_of(f3=value))
    np.testing.assert_allclose(played, [of_zero, (0, 0, 0), of_two], atol=1e-15)


@pytest.mark.slow
def test_borders_are_the_full_solution(face: Face, tables: AnimationTables) -> None:
    """At a border, with the other FAPs held, a played FAP is the posed one."""
    for number in (12, 19, 31, 51):
        table = tables.tables[number]
        value = float(table.borders[-1])
        frame = np.zeros(68)
        frame[number - 1] = value
        solved = face.pose(frame, drive="exact").positions
        skin = np.flatnonzero(face.parts == api.Part.SKIN)
        apart = distance(tables.play(frame_of(**{f"f{number}": value}))[skin], solved[skin])
        assert apart.largest < 1.01e-4 * face.units.es0  # what is left out because it hardly moves


@pytest.mark.slow
def test_a_played_frame_shows_the_faps_that_it_states(face: Face, tables: AnimationTables) -> None:
    """Tables add up: no FAP moves another one's point."""
    frame = frame_of(f3=250.0, f5=-180.0, f10=-150.0, f11=-150.0, f12=120.0, f13=90.0, f19=-100.0, f31=80.0)
    frame[[50, 51, 58, 59]] = -60.0, -170.0, 110.0, 85.0
    seen = face.measure(tables.play(frame))
    stated = ~np.isnan(frame)
    np.testing.assert_allclose(seen[stated], frame[stated], atol=6.0)


@pytest.mark.slow
def test_the_error_between_borders_is_small_and_reported(tables: AnimationTables) -> None:
    for number, table in tables.tables.items():
        assert table.error is not None
        assert 0.0 <= table.error.rms <= table.error.largest
        assert table.error.largest < 2.0e-3, number
        assert table.error.rms < 0.6e-3, number
    assert tables.tables[3].error != tables.tables[31].error


def test_finer_steps_leave_less_error(face: Face) -> None:
    coarse, fine = (api.face_animation_tables(face, faps=[48], steps=steps).tables[48].error for steps in (2, 4))
    assert coarse is not None
    assert fine is not None
    assert fine.rms == pytest.approx(coarse.rms / 4.0, rel=0.1)  # a chord's error goes with the square of its length


@pytest.mark.slow
def test_lower_teeth_move_with_the_jaw_only(face: Face, tables: AnimationTables) -> None:
    teeth = np.flatnonzero(face.parts == api.Part.TEETH_LOWER)
    assert np.isin(teeth, tables.tables[3].vertices).all()
    assert not np.isin(teeth, tables.tables[5].vertices).any()


@pytest.mark.slow
def test_points_of_other_faps_stay_or_follow(face: Face) -> None:
    still, free = (api.face_animation_tables(face, faps=[3, 5], steps=2, others=others) for others in ("still", "free"))
    seen = [face.measure(tables.play(frame_of(f3=500.0))) for tables in (still, free)]
    assert abs(seen[0][4]) < 5.0  # the lower lip's middle
    assert seen[1][4] < -250.0


@pytest.mark.slow
def test_an_opening_jaw_with_its_lips_leaves_no_spikes(face: Face, tables: AnimationTables) -> None:
    """Fear opens the mouth: what is measured and played again is the pose."""
    pose = face.pose(api.expression("fear").frame())
    frame = pose.achieved.copy()
    frame[[number - 1 for number in range(1, 69) if number not in MOUTH]] = np.nan
    lower = (face.parts == api.Part.SKIN) & (face.vertices[:, 2] < face.vertices[face.points["8.4"].vertices[0], 2])
    error = distance(tables.play(frame)[lower], pose.positions[lower])
    assert error.rms < 1.5e-3
    assert error.largest < 6.0e-3


def frame_error(face: Face, tables: AnimationTables, frame: np.ndarray) -> TableError:
    """How far tables are from the face for a whole frame (68,) that is posed, measured and played, where skin moves."""
    pose = face.pose(frame)
    played = tables.play(pose.achieved)
    reach = np.maximum(*(np.linalg.norm(each - face.vertices, axis=1) for each in (pose.positions, played)))
    moving = (reach > MOVED * face.units.es0) & (face.parts == api.Part.SKIN)
    return distance(played[moving], pose.positions[moving])


@pytest.mark.slow
def test_the_error_of_a_whole_frame(face: Face, tables: AnimationTables) -> None:
    same = frame_error(face, tables, frame_of(f48=20000.0))
    assert same.rms < 1e-4
    other = frame_error(face, tables, api.expression("surprise").frame())
    assert same.rms < other.rms <= other.largest


def test_every_low_level_fap_has_a_range_with_zero_inside() -> None:
    assert set(table_ranges()) == set(range(3, 69))
    for number, (low, high) in table_ranges().items():
        assert low <= 0.0 < high, number
        borders = table_borders(number)
        assert 0 in borders
        assert len(borders) == (9 if low < 0.0 else 5)


def test_progress_counts_faps(face: Face) -> None:
    seen: list[api.Progress] = []
    api.face_animation_tables(face, faps=[23, 65], steps=1, progress=seen.append)
    assert seen == [(0.5, "1 of 2 FAPs"), (1.0, "2 of 2 FAPs")]


def test_wrong_requests_are_refused(face: Face) -> None:
    for options, says in (
        ({"faps": [1]}, "low-level"),
        ({"faps": []}, "low-level"),
        ({"steps": 0}, "steps"),
        ({"drive": "magic"}, "natural, exact"),
        ({"others": "gone"}, "still, free"),
    ):
        with pytest.raises(ParameterError, match=says):
            api.face_animation_tables(face, **options)
    with pytest.raises(ParameterError, match="frame"):
        small().play(np.zeros(67))
    with pytest.raises(ParameterError, match="contain 0"):
        AnimationTable(3, 1.0, np.array([1, 2]), np.array([0]), np.zeros((1, 1, 3)))
    with pytest.raises(ParameterError, match="some of 1 vertices"):
        AnimationTables(np.zeros((1, 3)), small().tables)


@pytest.mark.slow
def test_json_survives_a_round_trip(tables: AnimationTables, tmp_path: Path) -> None:
    path = tmp_path / "face.json"
    api.write_animation_tables(path, tables)
    read = api.read_animation_tables(path)
    assert set(read.tables) == set(tables.tables)
    for number, table in read.tables.items():
        np.testing.assert_array_equal(table.borders, tables.tables[number].borders)
        np.testing.assert_array_equal(table.vertices, tables.tables[number].vertices)
        known = tables.tables[number].error
        assert table.error is not None
        assert known is not None
        assert (table.error.rms, table.error.largest) == pytest.approx((known.rms, known.largest))
    frame = frame_of(f3=300.0, f12=120.0, f31=-40.0, f48=15000.0)
    np.testing.assert_allclose(read.play(frame), tables.play(frame), atol=2e-7)


def test_face_def_tables_hold_the_same_numbers(tmp_path: Path) -> None:
    api.write_face_def_tables(tmp_path / "face.wrl", small(), node="Skin")
    text = (tmp_path / "face.wrl").read_text()
    assert text.count("{") == text.count("}") == 3
    assert "faceSceneGraphNode USE Skin" in text
    numbers = {
        name: [float(token) for token in re.findall(r"-?[\d.]+(?:e-?\d+)?", found)]
        for name, found in re.findall(r"(\w+) \[([-\d\s.,e]+)\]", text)
    }
    assert numbers["intervalBorders"] == [-100, 0, 50, 100]
    assert numbers["coordIndex"] == [2, 0]
    assert numbers["displacements"] == small().tables[3].slopes.ravel().tolist()
    with pytest.raises(ParameterError, match="node"):
        api.write_face_def_tables(tmp_path / "x.wrl", small(), node="my face")


@pytest.mark.parametrize(
    ("change", "key", "says"),
    [
        ({"format": "else"}, "format", "risorius face animation tables"),
        ({"version": 2}, "format", "version"),
        ({"tables": 3}, "tables", "list"),
        ({"vertices": [[0, 0]]}, "vertices", "N x 3 finite numbers"),
        ({"vertices": [[0, 0, "x"]]}, "vertices", "numbers"),
        ({"vertices": [[0, 0, 0]]}, "tables", "some of 1 vertices"),
        ({"fap": 2}, "tables.0.fap", "low-level"),
        ({"fap": "jaw"}, "tables.0.fap", "number"),
        ({"unit": 0}, "tables.0.unit", "positive"),
        ({"borders": [0]}, "tables.0.slopes", "0 x 2 x 3 finite numbers"),
        ({"borders": [0, 1, 2, 2]}, "tables.0.borders", "ascending order"),
        ({"borders": [0.5, 1, 2, 3]}, "tables.0.borders", "whole"),
        ({"vertices2": None, "slopes": [[[1]]]}, "tables.0.slopes", "3 x 2 x 3 finite numbers"),
        ({"slopes": [[[float("nan")] * 3] * 2] * 3}, "tables.0.slopes", "finite"),
    ],
)
def test_a_damaged_file_names_the_key(tmp_path: Path, change: dict[str, object], key: str, says: str) -> None:
    path = tmp_path / "face.json"
    api.write_animation_tables(path, small())
    document = json.loads(path.read_text())
    for name, value in change.items():
        (document if name in document else document["tables"][0])[name] = value
    path.write_text(json.dumps(document))
    with pytest.raises(FormatError, match=says) as caught:
        api.read_animation_tables(path)
    assert caught.value.key == key


def test_what_is_no_file_of_tables(tmp_path: Path) -> None:
    path = tmp_path / "face.json"
    with pytest.raises(FormatError, match="cannot be read"):
        api.read_animation_tables(path)
    wrong = (("{", "not valid JSON"), ("[1, 2]", "must be"), ("null", "must be"), ("\xff", "can't decode byte"))
    for text, told in wrong:
        path.write_text(text, encoding="latin-1")
        with pytest.raises(FormatError, match=told):
            api.read_animation_tables(path)
    with pytest.raises(FormatError, match="cannot be written"):
        api.write_animation_tables(tmp_path / "none" / "face.json", small())
