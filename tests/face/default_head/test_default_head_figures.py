"""The table of head figures: complete, left half only, and clear about every mistake."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from risorius.errors import FormatError
from risorius.face.default_head.cage import RIGHT_SUFFIX, build_cage, on_midline
from risorius.face.default_head.figures import DEFAULT_FIGURES, read_figures
from risorius.face.default_head.rings import computed_nodes


def test_measured_and_computed_nodes_are_exactly_the_cage() -> None:
    figures = read_figures()
    computed = computed_nodes(figures)
    assert len(figures.nodes) == 501
    assert not set(figures.nodes) & set(computed)
    left = {name for name in build_cage().names if not name.endswith(RIGHT_SUFFIX)}
    assert set(figures.nodes) | set(computed) == left


def test_midline_nodes_and_only_they_lie_on_the_midline() -> None:
    figures = read_figures()
    for name, point in (figures.nodes | computed_nodes(figures)).items():
        assert (abs(point[0]) < 1e-12) == on_midline(name), name


def test_figures_are_metres_of_a_human_head() -> None:
    points = np.array(list(read_figures().nodes.values()))
    size = np.ptp(points, axis=0)
    assert 0.08 < size[0] < 0.10
    assert 0.20 < size[1] < 0.24
    assert 0.25 < size[2] < 0.30


def test_lips_touch_along_the_whole_contact_line() -> None:
    nodes = read_figures().nodes
    for k in range(5):
        upper, lower = nodes[f"mouM1_{k:02d}"], nodes[f"mouM1_{10 - k:02d}"]
        assert -0.5e-3 < upper[2] - lower[2] <= 0.0, k
        assert np.abs(upper - lower)[:2].max() < 0.4e-3, k


def test_the_source_notice_lies_beside_the_table() -> None:
    notice = (DEFAULT_FIGURES.parent / "NOTICE-ICT-FaceKit.txt").read_text(encoding="utf-8")
    assert "Copyright (c) 2020 USC Institute for Creative Technologies" in notice
    assert "NOTICE-ICT-FaceKit.txt" in DEFAULT_FIGURES.read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("before", "after", "key", "problem"),
    [
        ("[eyeball]", "[eyebal]", "eyeball", "must be a table: begin it with [eyeball]"),
        ("radius = 15.1", "radius = -15.1", "eyeball.radius", "a number above 0, but it is -15.1"),
        ("radius = 15.1", 'radius = "15.1"', "eyeball.radius", "must be a number"),
        ("radius = 15.1", "radius = nan", "eyeball.radius", "must be a number"),
        ("thickness = [0.3, 2.6]", "thickness = 0.3", "lid_margin.thickness", "2 finite numbers"),
        ("gap = 0.25", "gap = 0", "lid_margin.gap", "a number above 0, but it is 0"),
        ("furrow = 0.22", "furrow = 22", "tongue.furrow", "a number above 0, 1 or less, but it is 22"),
        ("semi_axes = [19.5, 25.0, 6.5]", "semi_axes = [19.5, 25.0]", "tongue.semi_axes", "3 finite numbers, but"),
        ("semi_axes = [19.5, 25.0, 6.5]", 'semi_axes = ["a", 1, 2]', "tongue.semi_axes", "3 finite numbers"),
        ("skin = { colour = [0.", "skin = { colour = [1.", "materials.skin", "between 0 and 1"),
        ('"2.1" = { nodes = ["r18c00"] }', '"2.1" = { nodes = [] }', '"2.1"', "1, 2 or 4"),
        ("uv = [0.35, 0.06]", "uv = [1.35, 0.06]", "2.13", "between 0 and 1"),
        ('unit = "mm"', "unit = mm", "", "not valid TOML"),
        ('unit = "mm"', 'unit = "m"', "unit", "must be one of mm, but it is 'm'"),
    ],
)
def test_a_mistake_names_file_key_and_rule(tmp_path: Path, before: str, after: str, key: str, problem: str) -> None:
    text = DEFAULT_FIGURES.read_text(encoding="utf-8")
    assert before in text
    path = tmp_path / "head.toml"
    path.write_text(text.replace(before, after, 1), encoding="utf-8")
    with pytest.raises(FormatError) as caught:
        read_figures(path)
    assert str(path) in str(caught.value)
    assert key in str(caught.value)
    assert problem in str(caught.value)


def test_a_point_on_the_wrong_side_is_named(tmp_path: Path) -> None:
    text = DEFAULT_FIGURES.read_text(encoding="utf-8")
    row = text.index("r05 = [")
    second = text.index("], [", row) + 3
    path = tmp_path / "head.toml"
    path.write_text(text[:second] + "[-" + text[second + 1 :], encoding="utf-8")
    with pytest.raises(FormatError, match=r"r05c01: must have x > 0"):
        read_figures(path)


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(FormatError, match="cannot be read"):
        read_figures(tmp_path / "none.toml")
