"""Polygons as arrays are the polygons that were given, however they were given."""

from __future__ import annotations

import numpy as np
import pytest
from risorius.polygons import PolygonTable

MIXED = [(0, 1, 2), (2, 1, 3, 4), (4, 3, 5), (0, 2, 4, 5, 6)]


def as_tuples(table: PolygonTable) -> list[tuple[int, ...]]:
    return [tuple(polygon.tolist()) for polygon in table]


@pytest.mark.parametrize("given", [MIXED, [np.array(polygon) for polygon in MIXED], PolygonTable.of(MIXED)])
def test_a_table_is_the_polygons_that_were_given(given: list[tuple[int, ...]]) -> None:
    table = PolygonTable.of(given)
    assert as_tuples(table) == MIXED
    assert [tuple(table[number].tolist()) for number in range(len(table))] == MIXED
    assert tuple(table[-1].tolist()) == MIXED[-1]
    assert as_tuples(table[1:3]) == MIXED[1:3]


def test_an_array_and_no_polygons_are_tables_too() -> None:
    quads = np.arange(8).reshape(2, 4)
    assert as_tuples(PolygonTable.of(quads)) == [(0, 1, 2, 3), (4, 5, 6, 7)]
    empty = PolygonTable.of([])
    assert len(empty) == 0
    assert not empty.within(np.ones(3, dtype=bool)).size
    assert empty.by_size == ()


def test_the_corner_after_the_last_is_the_first() -> None:
    table = PolygonTable.of(MIXED)
    expected = [corner for polygon in MIXED for corner in polygon[1:] + polygon[:1]]
    assert table.after.tolist() == expected
    assert table.owners.tolist() == [n for n, polygon in enumerate(MIXED) for _ in polygon]


def test_gathered_by_size_every_polygon_is_there_once() -> None:
    gathered = {
        int(face): tuple(row.tolist())
        for faces, index in PolygonTable.of(MIXED).by_size
        for face, row in zip(faces, index, strict=True)
    }
    assert gathered == dict(enumerate(MIXED))


def test_polygons_within_marked_vertices_are_kept_and_renumbered() -> None:
    table = PolygonTable.of(MIXED)
    marked = np.arange(7) < 5
    kept = table.kept(table.within(marked))
    assert as_tuples(kept) == MIXED[:2]
    assert as_tuples(kept.numbered(np.arange(7) + 10)) == [(10, 11, 12), (12, 11, 13, 14)]
    assert as_tuples(PolygonTable.joined([kept, kept])) == MIXED[:2] * 2


def test_polygons_that_touch_marked_vertices_are_those_with_a_corner_there() -> None:
    table = PolygonTable.of(MIXED)
    assert as_tuples(table.kept(table.touching(np.arange(7) == 1))) == MIXED[:2]
    assert not table.touching(np.zeros(7, dtype=bool)).any()


def test_what_is_read_once_cannot_be_changed() -> None:
    given = np.array([[0, 1, 2]])
    table = PolygonTable.of(given)
    given[0, 0] = 7
    assert as_tuples(table) == [(0, 1, 2)]
    with pytest.raises(ValueError, match="read-only"):
        table.loops[0] = 7
