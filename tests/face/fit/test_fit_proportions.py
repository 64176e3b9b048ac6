"""Points on smooth skin that a face's proportions tell."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from risorius.errors import FormatError
from risorius.face.fit.bending import proportions
from risorius.face.fit.bending.proportions import Proportion, View, read_brow_places, read_proportions
from risorius.face.fit.template.template import FitTemplate, fit_template

TWINS = {"3.7": "3.12", "3.12": "3.7", "5.3": "5.4", "5.4": "5.3"}
PLACES = {
    "3.7": np.array([45.0, 3.0, 30.0]),
    "3.12": np.array([-45.0, 3.0, 30.0]),
    "5.3": np.array([40.0, 1.0, 2.0]),
    "5.4": np.array([-41.0, 1.0, 2.0]),
}


@pytest.fixture(scope="module")
def template() -> FitTemplate:
    return fit_template()


def test_a_place_is_told_along_and_across_a_way() -> None:
    rule = Proportion("5.3", View.FRONT, "3.7", "3.12", "3.7", 0.1, -0.5, 1.0)
    np.testing.assert_allclose(rule.place(PLACES, TWINS, left=True), [45.0 + 9.0, 1.0, 30.0 - 45.0])
    np.testing.assert_allclose(rule.place(PLACES, TWINS, left=False), [-45.0 - 9.0, 1.0, 30.0 - 45.0])


def test_a_share_draws_a_point_part_of_the_way() -> None:
    whole, half = (Proportion("5.3", View.FRONT, "3.7", "3.12", "3.7", 0.1, -0.5, s) for s in (1.0, 0.5))
    ends = PLACES["5.3"] + whole.place(PLACES, TWINS, left=True)
    np.testing.assert_allclose(half.place(PLACES, TWINS, left=True), ends / 2.0)


@pytest.mark.parametrize("view", list(View))
def test_proportions_do_not_mind_how_a_face_is_held_in_the_picture(view: View) -> None:
    rule = Proportion("5.3", view, "3.7", "2.1", "3.7", 0.3, -0.2, 0.7)
    places = PLACES | {"2.1": np.array([0.0, -20.0, -60.0])}
    angle, size, picture = 0.4, 1.7, list(view.value)
    turn = size * np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])

    def held(place: np.ndarray) -> np.ndarray:
        moved = place.copy()
        moved[picture] = turn @ place[picture] + np.array([3.0, -8.0])
        return moved

    there = rule.place({name: held(place) for name, place in places.items()}, {}, left=True)
    np.testing.assert_allclose(there, held(rule.place(places, {}, left=True)))


def test_every_row_of_the_table_tells_about_the_place_of_the_default_heads_point(template: FitTemplate) -> None:
    places = dict(zip(template.names, template.read(template.skin.vertices), strict=True))
    assert len(read_proportions()) >= 5
    for row in read_proportions():
        assert 0.0 < row.share <= 1.0, row.point
        assert row.point in template.twins, row.point
        picture = list(row.view.value)
        for left in (True, False):
            name = row.point if left else template.twins[row.point]
            told = Proportion(**vars(row) | {"share": 1.0}).place(places, template.twins, left=left)
            assert np.linalg.norm((told - places[name])[picture]) < 4e-3, name


def test_brows_lie_where_scans_have_them(template: FitTemplate) -> None:
    places = dict(zip(template.names, template.read(template.skin.vertices), strict=True))
    width = np.linalg.norm(places["3.7"] - places["3.12"])
    told = {row.point: row.place(places, template.twins, left=True) for row in read_brow_places()}
    assert list(told) == ["4.1", "4.3", "4.5"]
    heights = {name: 88.0 * (place[2] - places["3.11"][2]) / width for name, place in told.items()}
    assert 15.0 < heights["4.1"] < 19.0
    assert heights["4.1"] < heights["4.3"] < 24.0
    assert told["4.1"][0] < places["3.11"][0] < told["4.3"][0] < places["3.7"][0] < told["4.5"][0]
    assert heights["4.1"] < 88.0 * (places["4.1"][2] - places["3.11"][2]) / width - 5.0  # the default head's own


@pytest.mark.parametrize(
    ("row", "told"),
    [
        ("5.3,above,3.7,8.3,3.7,0,0,1", "column view: must be one of front, side, but it is 'above'"),
        ("5.3,front,3.7,8.3,3.7,0,x,1", "column across: must be a number, but it is 'x'"),
        ("5.3,front,3.7", "has 3 cells, but the heading has 8"),
    ],
)
def test_a_damaged_row_is_named(row: str, told: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    table = tmp_path / "wrong.csv"
    table.write_text(f"# a table\npoint,view,origin,from,to,along,across,share\n{row}\n")
    monkeypatch.setattr(proportions, "FILE", table)
    read_proportions.cache_clear()
    try:
        with pytest.raises(FormatError, match=f"wrong.csv, line 3.*{told}"):
            read_proportions()
    finally:
        read_proportions.cache_clear()
