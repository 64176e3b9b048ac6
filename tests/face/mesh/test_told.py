"""Objects that hold both eyes or both rows of teeth: told apart, and moved as they are where labels say so."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from risorius.api import Face, Part, Told
from risorius.errors import ModelError

EYES, TEETH = (Part.EYEBALL_L, Part.EYEBALL_R), (Part.TEETH_UPPER, Part.TEETH_LOWER)


@pytest.mark.parametrize("name", ["makehuman", "ict"])
def test_both_eyes_and_both_rows_are_told_apart(shared_head: Callable, name: str) -> None:
    head = shared_head(name)
    right = head.parts()
    told = right.copy()
    told[np.isin(right, EYES)] = int(Told.EYES)
    told[np.isin(right, TEETH)] = int(Told.TEETH)
    parts = Face.from_arrays(head.vertices, head.polygons, head.points, told).parts
    assert (parts[np.isin(right, EYES)] == right[np.isin(right, EYES)]).all()
    assert (parts[np.isin(right, TEETH)] == right[np.isin(right, TEETH)]).mean() > 0.97
    rest = ~np.isin(right, (*EYES, *TEETH))
    assert (parts[rest] == right[rest]).all()


def test_what_is_among_eyes_but_off_them_goes_with_the_skin(shared_head: Callable) -> None:
    """An object of eyes with their lashes: the balls turn, and lashes stay with the lids."""
    head = shared_head("ict")
    right = head.parts()
    lashes = head.labels == 6
    told = np.where(np.isin(right, EYES) | lashes, int(Told.EYES), right)
    parts = Face.from_arrays(head.vertices, head.polygons, head.points, told).parts
    assert (parts[lashes] == Part.OTHER).all()
    assert (parts[np.isin(right, EYES)] == right[np.isin(right, EYES)]).all()


def test_flat_eyes_go_to_their_sides(shared_head: Callable) -> None:
    """What no shape tells, as drawn eyes are: each piece goes to the side where it lies."""
    head = shared_head("makehuman")
    right = head.parts()
    eyes = np.isin(right, EYES)
    flat = head.vertices.copy()
    flat[eyes, 1] = flat[eyes, 1].min()
    told = np.where(eyes, int(Told.EYES), right)
    parts = Face.from_arrays(flat, head.polygons, head.points, told).parts
    assert (parts[eyes] == right[eyes]).all()


def test_one_surface_of_both_jaws_is_cut_between_the_lips(shared_head: Callable) -> None:
    head = shared_head("makehuman")
    right = head.parts()
    teeth = np.flatnonzero(np.isin(right, TEETH))
    upper, lower = (np.flatnonzero(right == part)[:2] for part in TEETH)
    bridge = np.array([upper[0], upper[1], lower[1], lower[0]])
    told = np.where(np.isin(right, TEETH), int(Told.TEETH), right)
    parts = Face.from_arrays(head.vertices, [*head.polygons, bridge], head.points, told).parts
    assert (parts[teeth] == right[teeth]).mean() > 0.9


def test_a_part_that_is_neither_known_nor_told_is_refused(shared_head: Callable) -> None:
    head = shared_head("makehuman")
    parts = head.parts()
    parts[7] = min(Told) - 1
    with pytest.raises(ModelError, match=r"numbers of Part \(0 to 7\) or Told \(-3 to -1\)"):
        Face.from_arrays(head.vertices, head.polygons, head.points, parts)
