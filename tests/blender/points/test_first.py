"""One button: the face is found, asked about where it is doubtful, and baked on."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import bpy
import numpy as np
import pytest
from risorius import api
from risorius.errors import ModelError, SceneError
from risorius.operators.points import first, look, overlay, question
from risorius.progress import Progress, run
from risorius.scene import bake, mesh
from risorius.scene.bake import performance, shape_keys, tracks
from risorius.scene.points import bound as points_bound
from risorius.scene.points import kept as points_kept
from risorius.scene.points.found import Finding

TIMING = bake.ClipTiming(0.2, 0.2, 0.2)


def questioned(obj: Any, score: float = 1.2) -> Finding:
    """The points of an object as if they had been found with that score."""
    kept = replace(points_kept.read_kept(obj), score=score)
    points_kept.write_kept(obj, kept)
    return Finding(kept, score, None)


@pytest.mark.slow
def test_six_emotions_stand_one_after_another_on_the_timeline(head: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(performance, "ARCHETYPES", ("joy", "fear"))
    points_kept.forget_points(head)
    bpy.context.scene.frame_start, bpy.context.scene.frame_end = 11, 20
    assert bpy.ops.risorius.bake_six() == {"FINISHED"}
    assert points_kept.has_points(head)
    (track,) = head.data.shape_keys.animation_data.nla_tracks
    assert [strip.action[tracks.CLIP_TAG] for strip in track.strips] == ["joy", "fear"]
    assert head.data.shape_keys.animation_data.action is None
    for strip, name in zip(track.strips, ("joy", "fear"), strict=True):
        bpy.context.scene.frame_set(round((strip.frame_start + strip.frame_end) / 2.0))
        values = {key.name: round(key.value, 3) for key in head.data.shape_keys.key_blocks[1:]}
        assert values == {other: float(other == name) for other in ("joy", "fear")}
    assert (bpy.context.scene.frame_start, bpy.context.scene.frame_end) == (11, 20)
    assert track.strips[0].frame_start >= 11


@pytest.mark.slow
def test_lining_up_again_takes_the_place_of_what_was_there(head: Any) -> None:
    made = run(bake.bake_expression(bake.Target(head), api.expression("joy").frame(), clip="joy", timing=TIMING))
    for _ in range(2):
        assert performance.line_up(bake.Target(head), [made]) == np.ceil(made.frame_range[1])
        (track,) = head.data.shape_keys.animation_data.nla_tracks
        assert len(track.strips) == 1


@pytest.mark.slow
def test_a_bake_finds_the_face_itself(head: Any) -> None:
    points_kept.forget_points(head)
    assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
    assert points_kept.has_points(head)
    assert shape_keys.has_own(head)


def test_a_bake_on_what_is_no_face_is_refused_and_changes_nothing(cube: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    def found(*_: Any, **__: Any) -> Any:
        yield Progress(0.5, "Looking")
        raise ModelError("Cube: no face found: click its feature points")

    monkeypatch.setattr(first, "find_points", found)
    for button in (bpy.ops.risorius.bake_expression, bpy.ops.risorius.bake_six):
        with pytest.raises(RuntimeError, match="no face found: click its feature points"):
            button()
    assert not points_kept.has_points(cube)
    assert cube.data.shape_keys is None


def test_a_doubtful_face_is_asked_about_before_anything_is_baked(head: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    finding = questioned(head)
    points_kept.forget_points(head)

    def found(*_: Any, **__: Any) -> Any:
        yield Progress(0.5, "Looking")
        return finding

    def bake() -> Any:
        yield Progress(0.5, "Baking")
        return "baked"

    monkeypatch.setattr(first, "find_points", found)
    assert run(first.with_points(head, bake, scene=bpy.context.scene)) == "baked", "a script has nobody to ask"
    monkeypatch.setattr(first, "bpy", SimpleNamespace(app=SimpleNamespace(background=False)))
    assert run(first.with_points(head, bake, scene=bpy.context.scene)) is finding
    points_kept.write_kept(head, finding.kept)
    assert run(first.with_points(head, bake, scene=bpy.context.scene)) == "baked", "what is there is not found again"


def test_a_bake_that_is_closed_early_leaves_no_points_behind(head: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    kept = points_kept.read_kept(head)
    points_kept.forget_points(head)

    def found(*_: Any, **__: Any) -> Any:
        yield Progress(0.5, "Looking")
        points_kept.write_kept(head, kept)
        return Finding(kept, 0.0, None)

    def bake() -> Any:
        yield Progress(0.5, "Baking")

    monkeypatch.setattr(first, "find_points", found)
    work = first.with_points(head, bake, scene=bpy.context.scene)
    next(work)
    assert next(work).text == "Baking"
    assert points_kept.has_points(head)
    work.close()
    assert not points_kept.has_points(head)


def test_a_bake_that_is_refused_leaves_neither_points_nor_a_list_behind(
    head: Any, cube: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A refused button makes no undo step: what it left could not be taken back. The user's own rows stay."""
    kept = points_kept.read_kept(head)
    points_kept.forget_points(head)
    head.risorius.face.followers.clear()
    head.risorius.face.followers_listed = False
    own = head.risorius.face.followers.add()
    own.object, own.by_hand = cube, True

    def found(*_: Any, **__: Any) -> Any:
        points_kept.write_kept(head, kept)
        yield Progress(0.5, "Looking")
        return Finding(kept, 0.0, None)

    def listed(obj: Any, scene: Any) -> None:
        obj.risorius.face.followers.add().by_hand = False
        obj.risorius.face.followers_listed = True

    def bake() -> Any:
        yield Progress(0.5, "Baking")
        raise SceneError("Head", "cannot be baked")

    monkeypatch.setattr(first, "find_points", found)
    monkeypatch.setattr(first, "list_once", listed)
    with pytest.raises(SceneError, match="cannot be baked"):
        run(first.with_points(head, bake, scene=bpy.context.scene))
    assert not points_kept.has_points(head)
    assert [row.object for row in head.risorius.face.followers] == [cube]
    assert not head.risorius.face.followers_listed


def test_the_question_stays_until_it_is_answered(head: Any) -> None:
    assert not bpy.ops.risorius.accept_points.poll()
    questioned(head)
    assert points_kept.read_kept(head).is_questioned
    assert points_bound.followed(points_kept.read_kept(head), head.data).kept.is_questioned
    assert bpy.ops.risorius.accept_points() == {"FINISHED"}
    assert not points_kept.read_kept(head).is_questioned
    assert not bpy.ops.risorius.accept_points.poll()


def test_the_question_offers_to_keep_to_click_and_to_forget(head: Any) -> None:
    asked: list[str] = []
    layout = SimpleNamespace(
        label=lambda *, text, icon="NONE": asked.append(text), operator=lambda name, **_: asked.append(name)
    )
    question.draw_question(layout, questioned(head, 1.37).kept)
    assert any("1.37" in line for line in asked)
    assert asked[-3:] == ["risorius.accept_points", "risorius.click_points", "risorius.forget_points"]


def test_the_front_of_a_face_is_where_it_looks(head: Any) -> None:
    local = points_bound.places(points_kept.read_kept(head), mesh.rest_vertices(head.data))
    front = look.front_of(local)
    assert front is not None
    left, up, towards = np.array(front).T
    np.testing.assert_allclose(left, (1.0, 0.0, 0.0), atol=1e-3)
    assert up[2] > 0.95
    assert towards[1] < -0.95
    assert look.front_of({"9.3": np.zeros(3)}) is None


def test_the_name_under_the_mouse_says_number_place_and_how_sure() -> None:
    assert overlay.words_of("8.4", 0.5) == ("8.4  outer lip, right corner", "50% confidence")
