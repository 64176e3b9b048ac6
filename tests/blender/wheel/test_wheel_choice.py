"""What a hand on the emotion wheel chooses: by pixels, by drags with and without keys, and back again."""

from __future__ import annotations

import math
from contextlib import ExitStack
from types import SimpleNamespace
from typing import Any

import bpy
import numpy as np
import pytest
import risorius.api as api
from risorius.operators.changes import listen
from risorius.operators.emotion.profile import profile_of, wanted_of
from risorius.operators.gizmo_keys import forget_keymap
from risorius.operators.wheel import gizmo, ops, pick
from risorius.operators.wheel.caption import caption, caption_at
from risorius.operators.wheel.choice import Choice, Hand, choose_pixel, choose_point, choose_word, strengthen, turn
from risorius.operators.wheel.geometry import Box, Wheel
from risorius.operators.wheel.places import spots
from risorius.operators.wheel.view import reason_hidden

pytestmark = pytest.mark.smoke

WHEEL = Wheel((200.0, 300.0), 140.0)


class Drag(SimpleNamespace):
    """A drag without a window: the operator's own methods, fed with events."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, operator: Any = ops.RISORIUS_OT_drag_emotion) -> None:
        super().__init__(operator=operator, chooses_on=operator.chooses_on, chooses_by=operator.chooses_by)
        monkeypatch.setattr(ops, "wheel_of", lambda context: WHEEL)
        monkeypatch.setattr(ops, "label_at", lambda wheel, pixel, scale: None)
        monkeypatch.setattr(pick, "free_of", lambda *where: Box(0.0, 0.0, 1000.0, 800.0))
        for name in ("_take_hold", "_emotion", "_choose", "_show", "_help"):
            setattr(self, name, getattr(operator, name).__get__(self))
        self.context = SimpleNamespace(
            object=bpy.context.object,
            area=SimpleNamespace(type="VIEW_3D"),
            region=SimpleNamespace(type="WINDOW", as_pointer=lambda: 0),
            space_data=SimpleNamespace(type="VIEW_3D"),
            preferences=SimpleNamespace(system=SimpleNamespace(ui_scale=1.0)),
            workspace=SimpleNamespace(status_text_set=self._say),
            window_manager=SimpleNamespace(
                modal_handler_add=lambda operator: None, risorius=bpy.context.window_manager.risorius
            ),
        )
        self.said: Any = None

    def _say(self, text: str | None) -> None:
        self.said = text

    def send(self, kind: str, pixel: tuple[float, float], value: str = "PRESS", **keys: bool) -> set[str]:
        """One event."""
        held = {"ctrl": False, "shift": False} | keys
        event = SimpleNamespace(type=kind, value=value, mouse_region_x=pixel[0], mouse_region_y=pixel[1], **held)
        act = self.operator.modal if hasattr(self, "_hand") else self.operator.invoke
        return act(self, self.context, event)


@pytest.fixture
def drag(head: Any, monkeypatch: pytest.MonkeyPatch) -> Drag:
    return Drag(monkeypatch)


def test_a_drag_from_fear_towards_sadness_comes_by_guilty(head: Any, drag: Drag) -> None:
    emotion = head.risorius.emotion
    assert drag.send("LEFTMOUSE", WHEEL.pixel(70.3, 4.9)) == {"RUNNING_MODAL"}
    assert (emotion.by, emotion.word) == ("WORD", "fear")
    drag.send("MOUSEMOVE", WHEEL.pixel(86.0, 4.5))
    assert emotion.by == "WHEEL"
    expected = api.expression(angle=86.0, activation=4.5)
    np.testing.assert_allclose(wanted_of(head).faps, expected.frame(), rtol=1e-4)
    drag.send("MOUSEMOVE", WHEEL.pixel(102.0, 4.05))
    assert (emotion.by, emotion.word) == ("WORD", "guilty")
    np.testing.assert_allclose(wanted_of(head).faps, api.expression("guilty").frame(), rtol=1e-6)
    assert "Guilty" in drag.said
    assert drag.send("LEFTMOUSE", WHEEL.pixel(102.0, 4.05), "RELEASE") == {"FINISHED"}
    assert emotion.word == "guilty"
    assert drag.said is None


@pytest.mark.parametrize("key", ["ESC", "RIGHTMOUSE"])
def test_giving_a_drag_up_leaves_all_as_it_was(head: Any, drag: Drag, key: str) -> None:
    emotion = head.risorius.emotion
    emotion.word = "surprise"
    emotion.variant, emotion.activation = "2", 5.5
    before = Choice.of(emotion)
    drag.send("LEFTMOUSE", WHEEL.pixel(70.3, 4.9))
    drag.send("MOUSEMOVE", WHEEL.pixel(20.0, 3.0))
    assert Choice.of(emotion) != before
    assert drag.send(key, WHEEL.pixel(20.0, 3.0)) == {"CANCELLED"}
    assert Choice.of(emotion) == before


def test_a_click_on_what_is_chosen_is_no_step_of_undo(head: Any, drag: Drag) -> None:
    drag.send("LEFTMOUSE", WHEEL.pixel(323.4, 5.4))
    assert drag.send("LEFTMOUSE", WHEEL.pixel(323.4, 5.4), "RELEASE") == {"CANCELLED"}


def test_a_face_that_is_deleted_meanwhile_ends_the_drag(head: Any, drag: Drag) -> None:
    drag.send("LEFTMOUSE", WHEEL.pixel(70.3, 4.9))
    bpy.data.objects.remove(head)
    assert drag.send("MOUSEMOVE", WHEEL.pixel(20.0, 3.0)) == {"CANCELLED"}
    assert drag.said is None


def test_control_leaves_words_aside(head: Any, drag: Drag) -> None:
    emotion = head.risorius.emotion
    drag.send("LEFTMOUSE", WHEEL.pixel(70.0, 4.9), ctrl=True)
    assert emotion.by == "WHEEL"
    assert math.degrees(emotion.angle) == pytest.approx(70.0, abs=1e-3)


def test_shift_moves_the_point_by_a_tenth(head: Any, drag: Drag) -> None:
    emotion = head.risorius.emotion
    drag.send("LEFTMOUSE", WHEEL.pixel(0.0, 4.0), ctrl=True)
    drag.send("MOUSEMOVE", WHEEL.pixel(0.0, 6.0), shift=True, ctrl=True)
    assert emotion.activation == pytest.approx(4.2)


def test_a_press_on_a_label_is_its_word(head: Any, drag: Drag, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ops, "label_at", lambda wheel, pixel, scale: "bored")
    emotion, (x, y) = head.risorius.emotion, WHEEL.pixel(20.0, 6.0)
    drag.send("LEFTMOUSE", (x, y))
    drag.send("MOUSEMOVE", (x + 2.0, y))
    assert (emotion.by, emotion.word) == ("WORD", "bored")
    drag.send("MOUSEMOVE", (x + 8.0, y))
    assert emotion.by == "WHEEL"


def test_beside_the_wheel_a_press_is_for_others(head: Any, drag: Drag, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ops, "wheel_of", lambda context: None)
    assert drag.send("LEFTMOUSE", (0.0, 0.0)) == {"PASS_THROUGH"}


def test_picking_begins_at_what_is_chosen_and_ends_with_a_click(head: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    emotion = head.risorius.emotion
    before = Choice.of(emotion)
    hand = Drag(monkeypatch, pick.RISORIUS_OT_pick_emotion)
    hand.send("F3", (500.0, 400.0))
    assert Choice.of(emotion) == before
    assert before.pixel(hand._wheel) == pytest.approx((500.0, 400.0))
    fear = hand._wheel.pixel(70.3, 4.9)
    hand.send("LEFTMOUSE", fear, "RELEASE")  # of the click that chose in the menu
    hand.send("MOUSEMOVE", fear)
    assert hand.send("LEFTMOUSE", fear) == {"FINISHED"}
    assert emotion.word == "fear"
    pick._hide()
    assert pick._shown is None


def test_every_word_is_chosen_at_its_place(head: Any) -> None:
    emotion = head.risorius.emotion
    for word, pixel in spots(WHEEL).items():
        choose_pixel(emotion, WHEEL, pixel, reach=5.0)
        assert (emotion.by, emotion.word) == ("WORD", word)
        assert profile_of(emotion) == api.expression(word, activation=emotion.activation)
        assert math.dist(Choice.of(emotion).pixel(WHEEL), pixel) < 1e-3


def test_choosing_what_is_chosen_keeps_its_variant_and_tells_nobody(head: Any) -> None:
    emotion = head.risorius.emotion
    emotion.variant = "1"
    heard: list[Any] = []
    with ExitStack() as undo:
        listen(heard.append, undo)
        choose_word(emotion, "joy")
        Choice.of(emotion).write(emotion)
    assert emotion.variant == "1"
    assert not heard


def test_turning_and_strengthening(head: Any) -> None:
    emotion = head.risorius.emotion
    strengthen(emotion, 0.5)
    assert (emotion.by, emotion.activation) == ("WORD", pytest.approx(5.9))
    turn(emotion, 50.0)
    assert emotion.by == "WHEEL"
    assert math.degrees(emotion.angle) == pytest.approx(13.4, abs=1e-3)
    strengthen(emotion, 9.0)
    assert emotion.activation == 7.0


def test_a_hand_that_was_slow_stays_where_it_was_left() -> None:
    hand = Hand((10.0, 10.0), (10.0, 10.0)).moved((20.0, 10.0), fine=True).moved((25.0, 12.0), fine=False)
    assert hand.at == pytest.approx((16.0, 12.0))


def test_the_caption_says_what_a_click_would_choose(head: Any) -> None:
    emotion = head.risorius.emotion
    for pixel in (WHEEL.pixel(102.3, 4.0), WHEEL.pixel(20.0, 5.0), WHEEL.centre):
        said = caption_at(WHEEL, pixel, 6.0, None)
        choose_pixel(emotion, WHEEL, pixel, reach=6.0)
        assert caption(Choice.of(emotion)) == said
    choose_point(emotion, 20.0, 5.0)
    assert caption(Choice.of(emotion)) == ("Between joy and fear", "Activation 5.0 of 7, direction 20°")


def test_the_wheel_is_there_for_faces_in_object_mode_only(head: Any) -> None:
    wheel = SimpleNamespace(show=True)
    space = SimpleNamespace(type="VIEW_3D", show_gizmo=True)
    manager = SimpleNamespace(risorius=SimpleNamespace(wheel=wheel))
    context = SimpleNamespace(object=head, space_data=space, window_manager=manager)
    assert reason_hidden(context) is None
    wheel.show = False
    assert "Emotion panel" in str(reason_hidden(context))
    wheel.show, space.show_gizmo = True, False
    assert "gizmos are hidden" in str(reason_hidden(context))
    space.show_gizmo = True
    bpy.ops.object.mode_set(mode="EDIT")
    assert head.name in str(reason_hidden(context))
    bpy.ops.object.mode_set(mode="OBJECT")
    context.object = None
    assert "feature points" in str(reason_hidden(context))


def test_the_wheel_has_its_keys_while_it_is_registered() -> None:
    configs = bpy.context.window_manager.keyconfigs
    config = configs.default
    keys = gizmo.RISORIUS_GGT_wheel.setup_keymap(config).keymap_items
    assert {item.idname for item in keys} == {"risorius.drag_emotion", "risorius.nudge_emotion"}
    forget_keymap(gizmo.KEYMAP)
    assert not [one.name for one in configs if gizmo.KEYMAP in one.keymaps]
