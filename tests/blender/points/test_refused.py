"""What is no face is searched once; the next button says the same at once."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
import pytest
from risorius import api
from risorius.errors import ModelError
from risorius.progress import run
from risorius.scene.points import refused
from risorius.scene.points.found import find_points


@pytest.fixture
def searches(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """How many vertices each search was given; none of them finds a face."""
    made: list[int] = []

    def searched(vertices: Any, *_: Any, **__: Any) -> Any:
        made.append(len(vertices))
        yield from ()
        raise ModelError("no face here: click one")

    monkeypatch.setattr(api, "find_points_steps", searched)
    monkeypatch.setattr(refused, "_refusals", {})
    return made


@pytest.fixture
def cube(empty_file: None) -> Any:
    """A cube."""
    bpy.ops.mesh.primitive_cube_add()
    return bpy.context.object


def refusal(obj: Any, clicks: Any = None) -> str:
    """In what words no face is found."""
    with pytest.raises(ModelError) as said:
        run(find_points(obj, clicks))
    return str(said.value)


def test_a_refused_mesh_is_not_searched_again(cube: Any, searches: list[int]) -> None:
    words = {refusal(cube) for _ in range(3)}
    assert words == {f"{cube.name}: no face here: click one"}
    assert len(searches) == 1


def test_the_next_button_says_it_too(cube: Any, searches: list[int]) -> None:
    for button in (bpy.ops.risorius.find_points, bpy.ops.risorius.bake_six):
        with pytest.raises(RuntimeError, match="no face here: click one"):
            button()
    assert len(searches) == 1


def test_another_object_of_the_mesh_is_named(cube: Any, searches: list[int]) -> None:
    other = bpy.data.objects.new("Other", cube.data)
    assert refusal(cube).startswith(f"{cube.name}: ")
    assert refusal(other).startswith("Other: ")
    assert len(searches) == 1


def test_a_changed_mesh_and_clicks_are_searched(cube: Any, searches: list[int]) -> None:
    refusal(cube)
    cube.data.vertices[0].co.x += 0.1
    refusal(cube)
    refusal(cube, {"9.3": np.zeros(3)})
    refusal(cube, {"9.3": np.ones(3)})
    assert len(searches) == 4


def test_only_the_newest_refusals_are_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(refused, "_refusals", {})
    for number in range(refused.KEPT + 2):
        refused.keep_refusal(str(number), "no")
    assert refused.refusal_of("1") is None
    assert refused.refusal_of("2") == "no"
