"""A balance that is not reached, in Blender: bake, timeline, drag and batch say how far it is off, and change nothing.

The solver itself gets one iteration where it needs some ten, and judges what it has.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

import bpy
import pytest
from file_state import file_state
from risorius import cli
from risorius.errors import ParameterError, SolverError
from risorius.operators.preview import live
from risorius.operators.session import session
from risorius.scene.bake import ClipTiming
from risorius.scene.faces import forget_faces
from risorius.scene.live import preview

pytestmark = pytest.mark.slow

equilibrium: Any = import_module("risorius.physics.equilibrium")  # the room has a function of that name


@pytest.fixture
def hard(monkeypatch: pytest.MonkeyPatch) -> Callable[[], None]:
    """From when it is called, no equilibrium takes more than one iteration."""
    solved = equilibrium.minimise

    def at_once(*given: Any, **options: Any) -> Any:
        return solved(*given, **{**options, "max_iterations": 1})

    return lambda: monkeypatch.setattr(equilibrium, "minimise", at_once)


@pytest.fixture
def live_preview(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """The live preview, turned on."""
    monkeypatch.setattr(live, "is_on", lambda: True)
    yield
    live.end()


@pytest.mark.parametrize("bake", ["bake_expression", "bake_motion"])
def test_a_bake_says_how_far_it_is_off_and_changes_nothing(bake: str, head: Any, hard: Callable[[], None]) -> None:
    head.risorius.emotion.word = "joy"
    file_state()  # reading makes what Cycles keeps beside materials
    before = file_state()
    hard()
    with pytest.raises(RuntimeError, match=r"no equilibrium .*residual") as refused:
        getattr(bpy.ops.risorius, bake)()
    assert "Traceback" not in str(refused.value)
    assert ("frame" in str(refused.value)) == (bake == "bake_motion")
    assert file_state() == before


def test_a_bake_that_follows_is_as_if_none_had_failed(head: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    head.risorius.emotion.word = "joy"
    with monkeypatch.context() as patch:
        solved = equilibrium.minimise
        patch.setattr(equilibrium, "minimise", lambda *given, **more: solved(*given, **{**more, "max_iterations": 1}))
        with pytest.raises(RuntimeError, match="no equilibrium"):
            bpy.ops.risorius.bake_expression()
    assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
    assert "joy" in head.data.shape_keys.key_blocks


def test_a_drag_says_it_and_leaves_the_face_as_it_is(head: Any, hard: Callable[[], None], live_preview: None) -> None:
    forget_faces()  # one that was in this pose before foretells it without a balance
    previews = session().previews
    live.ask(head)
    while not preview.is_shown(head):
        assert live._answer() is not None, previews.trouble
    shown = preview_of(head)
    hard()
    head.risorius.emotion.word = "fear"
    live.ask(head)
    while live._answer() is not None:
        pass
    assert "no equilibrium" in previews.trouble
    assert "residual" in previews.trouble
    assert preview_of(head) == shown


def preview_of(head: Any) -> bytes:
    """What the preview shows."""
    from risorius.scene.mesh import evaluated_vertices

    return bytes(evaluated_vertices(head).tobytes())


def test_a_batch_tells_it_of_its_row_and_leaves_nothing_half_made(
    tmp_path: Path, hard: Callable[[], None], capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("RISORIUS_CACHE", "off")
    table, out = tmp_path / "jobs.csv", tmp_path / "set"
    table.write_text("id,emotion,apex,outputs,size\na,joy,0.1,film blend fap,64\nb,fear,,still,64\n")
    hard()
    capsys.readouterr()
    assert cli.main(["batch", str(table), "--out", str(out), "--json"]) == 1
    said = capsys.readouterr().out
    told = json.loads(said[said.index("{") :])
    assert set(told["failed"]) == {"a", "b"}
    assert all("no equilibrium" in why and "residual" in why for why in told["failed"].values())
    assert "frame" in told["failed"]["a"]
    assert not told["made"]
    assert not (out / "a").exists()
    assert not (out / "b").exists()


def test_the_error_keeps_frame_and_residual() -> None:
    error = SolverError("no equilibrium", residual=2e-4).in_frame(7)
    assert (error.frame, error.residual) == (7, 2e-4)
    assert error.in_frame(9).frame == 9
    assert str(error.in_frame(9)).count("the motion could not be solved") == 1


@pytest.mark.parametrize("seconds", [1e308, 1e30, 1e6])
def test_an_expression_longer_than_any_scene_is_refused(seconds: float) -> None:
    with pytest.raises(ParameterError, match="must end within 1000000 frames"):
        ClipTiming(onset=0.1, apex=seconds, offset=0.1)
