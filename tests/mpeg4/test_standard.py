"""The standard's tables: invariants over every row, and anchors known from elsewhere."""

from __future__ import annotations

import numpy as np
import pytest
from risorius.errors import ParameterError
from risorius.mpeg4 import (
    ACTION_UNITS,
    ARCHETYPES,
    EXPRESSIONS,
    FAPS,
    FAPU,
    FEATURE_POINTS,
    GROUPS,
    LIP_TWINS,
    PAIRS,
    VISEMES,
    Motion,
    Side,
    Unit,
    fap,
)

# ISO/IEC 14496-2: members of the FAP groups 1..10 and of the feature point groups 2..11.
GROUP_SIZES = (2, 16, 12, 8, 4, 5, 3, 10, 4, 4)
POINT_GROUP_SIZES = {2: 14, 3: 14, 4: 6, 5: 4, 6: 4, 7: 1, 8: 10, 9: 15, 10: 10, 11: 6}

OPPOSITE = {Motion.LEFT: Motion.RIGHT, Motion.RIGHT: Motion.LEFT}


def test_there_are_68_faps_numbered_without_gap() -> None:
    assert list(FAPS) == list(range(1, 69))
    assert all(number == entry.number for number, entry in FAPS.items())
    assert len({entry.name for entry in FAPS.values()}) == 68


def test_groups_partition_the_faps() -> None:
    assert [len(GROUPS[group]) for group in range(1, 11)] == list(GROUP_SIZES)
    assert sorted(number for members in GROUPS.values() for number in members) == list(FAPS)


def test_every_low_level_fap_moves_an_existing_point_of_its_group() -> None:
    for entry in FAPS.values():
        if entry.high_level:
            assert entry.number in (1, 2)
            assert entry.feature_point is None
        else:
            assert entry.feature_point in FEATURE_POINTS
            point = FEATURE_POINTS[entry.feature_point]
            assert point.group == entry.group
            assert point.number == entry.subgroup
            assert entry.number in point.faps


def test_pairs_mirror_one_another() -> None:
    assert len(PAIRS) == 23
    for left, right in PAIRS:
        one, other = FAPS[left], FAPS[right]
        assert other.mirror == left
        assert one.name.replace("_l_", "_r_").replace("_lip_lm", "_lip_rm") == other.name
        assert (one.unit, one.bidirectional, one.quant_step) == (other.unit, other.bidirectional, other.quant_step)
        assert (one.intra_limits, one.inter_limits) == (other.intra_limits, other.inter_limits)
        assert one.feature_point is not None
        assert other.feature_point is not None
        assert FEATURE_POINTS[one.feature_point].mirror == other.feature_point
        if (left, right) == (23, 24):  # both eyes turn to the subject's left, so that equal values are a parallel gaze
            assert one.motion is other.motion is Motion.LEFT
        else:
            assert one.motion is not None
            assert other.motion is OPPOSITE.get(one.motion, one.motion)


def test_faps_without_mirror_move_points_of_the_middle() -> None:
    unpaired = [entry for entry in FAPS.values() if entry.mirror is None and entry.feature_point is not None]
    sided = {entry.number for entry in unpaired if FEATURE_POINTS[str(entry.feature_point)].side is not Side.MIDDLE}
    assert sided == {47}  # tongue roll is bound to the tongue's left border


def test_lip_twins_are_one_motion_on_two_contours() -> None:
    assert len(LIP_TWINS) == 10
    for inner, outer in LIP_TWINS:
        assert FAPS[outer].lip_twin == inner
        assert FAPS[outer].name == FAPS[inner].name + "_o"
        assert (FAPS[inner].unit, FAPS[inner].motion) == (FAPS[outer].unit, FAPS[outer].motion)
        assert (FAPS[inner].group, FAPS[outer].group) == (2, 8)


def test_unidirectional_faps_are_the_known_five() -> None:
    assert {n for n, entry in FAPS.items() if not entry.bidirectional and not entry.high_level} == {3, 14, 41, 42, 47}


def test_coding_limits_hold_zero() -> None:
    for entry in FAPS.values():
        if not entry.high_level:
            assert entry.quant_step is not None
            assert entry.quant_step > 0
            for limits in (entry.intra_limits, entry.inter_limits):
                assert limits is not None
                assert limits[0] < 0 < limits[1]


def test_there_are_84_feature_points_in_their_groups() -> None:
    sizes: dict[int, int] = {}
    for name, point in FEATURE_POINTS.items():
        assert name == f"{point.group}.{point.number}"
        sizes[point.group] = sizes.get(point.group, 0) + 1
        assert point.number == sizes[point.group]
    assert sizes == POINT_GROUP_SIZES
    assert sum(sizes.values()) == 84


def test_feature_points_mirror_one_another() -> None:
    other_side = {Side.LEFT: Side.RIGHT, Side.RIGHT: Side.LEFT}
    for name, point in FEATURE_POINTS.items():
        if point.side is Side.MIDDLE:
            assert point.mirror is None
        else:
            assert point.mirror is not None
            twin = FEATURE_POINTS[point.mirror]
            assert twin.mirror == name
            assert twin.side is other_side[point.side]


def test_faps_move_45_points() -> None:
    assert sum(bool(point.faps) for point in FEATURE_POINTS.values()) == 45


def test_units_are_measured_between_existing_points() -> None:
    assert set(FAPU) == set(Unit)
    for unit, definition in FAPU.items():
        if unit is Unit.AU:
            assert definition.radians == 1e-5
            assert definition.pairs == ()
        else:
            assert definition.divisor == 1024
            assert {point for pair in definition.pairs for point in pair} <= set(FEATURE_POINTS)
            assert len(definition.pairs) == (2 if unit is Unit.IRISD else 1)
            assert definition.axis in ("vertical", "lateral")


@pytest.mark.parametrize(
    ("name", "number", "unit", "motion", "point"),
    [
        ("open_jaw", 3, Unit.MNS, Motion.DOWN, "2.1"),
        ("raise_b_midlip", 5, Unit.MNS, Motion.UP, "2.3"),
        ("stretch_r_cornerlip", 7, Unit.MW, Motion.RIGHT, "2.5"),
        ("depress_chin", 18, Unit.MNS, Motion.UP, "2.10"),
        ("close_t_l_eyelid", 19, Unit.IRISD, Motion.DOWN, "3.1"),
        ("squeeze_l_eyebrow", 37, Unit.ES, Motion.RIGHT, "4.1"),
        ("head_yaw", 49, Unit.AU, Motion.LEFT, "7.1"),
        ("raise_l_cornerlip_o", 59, Unit.MNS, Motion.UP, "8.3"),
    ],
)
def test_anchors_of_the_standard(name: str, number: int, unit: Unit, motion: Motion, point: str) -> None:
    entry = fap(name)
    assert entry is fap(number) is fap(np.int64(number))
    assert (entry.number, entry.unit, entry.motion, entry.feature_point) == (number, unit, motion, point)


def test_motions_point_where_they_say() -> None:
    assert Motion.LEFT.direction == (1.0, 0.0, 0.0)
    assert Motion.DOWN.direction == (0.0, 0.0, -1.0)
    assert Motion.FORWARD.direction == (0.0, -1.0, 0.0)
    assert Motion.GROWING.direction is None


@pytest.mark.parametrize("wrong", [0, 69, -3, 3.5, None])
def test_a_fap_number_outside_is_refused(wrong: object) -> None:
    with pytest.raises(ParameterError, match=r"1\.\.68"):
        fap(wrong)  # type: ignore[arg-type]


def test_a_misspelt_fap_is_refused_with_a_suggestion() -> None:
    with pytest.raises(ParameterError, match="did you mean open_jaw"):
        fap("open_jav")


def test_visemes_and_expressions() -> None:
    assert list(VISEMES) == list(range(15))
    assert VISEMES[1].phonemes == ("p", "b", "m")
    assert all(viseme.phonemes and viseme.examples for number, viseme in VISEMES.items() if number)
    assert list(EXPRESSIONS) == list(range(7))
    assert EXPRESSIONS[0].archetype is None
    assert tuple(EXPRESSIONS[code].archetype for code in range(1, 7)) == ARCHETYPES


def test_table_1_names_faps_of_the_standard() -> None:
    assert list(ACTION_UNITS) == list(range(1, 21))
    assert {unit for unit, terms in ACTION_UNITS.items() if not terms} == {3, 8, 11, 13, 14, 16, 18, 19}
    unknown = [term.printed for terms in ACTION_UNITS.values() for term in terms if term.fap is None]
    assert unknown == ["lower_lowerlip"]
    misprinted = {
        term.printed
        for terms in ACTION_UNITS.values()
        for term in terms
        if term.fap and FAPS[term.fap].name != term.printed
    }
    assert misprinted == {"stetch_r_nose", "Push_b_lip", "lower_l_cornerlip", "lower_r_cornerlip"}
    assert [term.fap for term in ACTION_UNITS[5]] == [19, 20]
    assert [term.fap for term in ACTION_UNITS[10] if term.optional] == [61, 62]


def test_table_1_is_symmetric_but_for_the_middle() -> None:
    for unit, terms in ACTION_UNITS.items():
        numbers = {term.fap for term in terms if term.fap is not None}
        mirrored = {FAPS[number].mirror or number for number in numbers}
        assert mirrored == numbers, f"AU {unit}"
