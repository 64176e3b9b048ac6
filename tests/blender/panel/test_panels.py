"""Every panel drawn by a spy that records what a user would see."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import bpy
import numpy as np
import pytest
from risorius.operators import requirements
from risorius.operators.classes import CLASSES
from risorius.operators.sidebar import LINE, Sidebar

pytestmark = pytest.mark.smoke


class Spy:
    """A layout that records: labels, properties and operators, whatever box or row they are in."""

    def __init__(self, seen: list[tuple[str, str]] | None = None) -> None:
        self.seen = [] if seen is None else seen

    def _nested(self, **options: Any) -> Spy:
        return Spy(self.seen)

    row = column = box = split = _nested

    def label(self, *, text: str = "", icon: str = "NONE") -> None:
        assert len(text) <= LINE, f"{text!r} is cut off in the sidebar"
        self.seen.append(("label", text))

    def prop(self, data: Any, name: str, **options: Any) -> None:
        assert name in data.bl_rna.properties, f"{data} has no {name}"
        unknown = set(options) - {"text", "icon", "slider", "expand", "toggle", "placeholder", "emboss"}
        assert not unknown
        self.seen.append(("prop", name))

    def prop_search(self, data: Any, name: str, within: Any, collection: str, **options: Any) -> None:
        assert collection in within.bl_rna.properties
        self.prop(data, name, **options)

    def template_list(self, kind: str, _id: str, data: Any, name: str, active: Any, index: str, **options: Any) -> None:
        assert hasattr(bpy.types, kind)
        assert name in data.bl_rna.properties
        assert index in active.bl_rna.properties
        self.seen.append(("list", name))

    def progress(self, *, factor: float, text: str, type: str) -> None:
        assert type == "BAR"
        assert 0.0 <= factor <= 1.0
        self.seen.append(("progress", text))

    def menu(self, name: str, **options: Any) -> None:
        assert hasattr(bpy.types, name)
        self.seen.append(("menu", name))

    def popover(self, panel: str, **options: Any) -> None:
        assert hasattr(bpy.types, panel)
        self.seen.append(("popover", panel))

    def operator(self, name: str, **options: Any) -> Any:
        assert name.partition(".")[2] in dir(bpy.ops.risorius)
        self.seen.append(("operator", name))
        return SimpleNamespace()


def drawn() -> dict[str, list[tuple[str, str]]]:
    """What each panel shows now; panels that do not show are missing."""
    context = bpy.context
    shown = {}
    for cls in CLASSES:
        if not issubclass(cls, bpy.types.Panel) or not issubclass(cls, Sidebar):
            continue  # Blender itself draws the popovers of presets
        if not getattr(cls, "poll", lambda _: True)(context):
            continue
        spy = Spy()
        panel = SimpleNamespace(layout=spy)
        for name in vars(cls):
            if name.startswith("_draw_"):
                setattr(panel, name, getattr(cls, name).__get__(panel))
        cls.draw(panel, context)
        shown[cls.__name__] = spy.seen
    return shown


def test_without_an_object_the_way_in_is_shown() -> None:
    shown = drawn()
    assert set(shown) == {"RISORIUS_PT_main"}
    assert ("operator", "risorius.add_head") in shown["RISORIUS_PT_main"]


def test_a_mesh_without_points_is_told_what_it_needs(cube: Any) -> None:
    shown = drawn()
    assert ("operator", "risorius.import_points") in shown["RISORIUS_PT_main"]
    assert ("label", "The face is found first") in shown["RISORIUS_PT_bake"]


def test_all_panels_for_a_head_in_order_of_work(head: Any) -> None:
    shown = drawn()
    first = "main followers parts points topologies emotion muscles tissue timeline variation speech bake"
    last = "read read_faps read_features film"
    assert list(shown) == [f"RISORIUS_PT_{name}" for name in f"{first} {last}".split()]
    assert ("label", head.name) in shown["RISORIUS_PT_main"]
    asked = [name for kind, name in shown["RISORIUS_PT_emotion"] if kind in {"prop", "popover"}]
    assert asked[:6] == ["show", "show", "RISORIUS_PT_wheel", "by", "word", "activation"]
    assert ("label", "Joy's own: 5.4") in shown["RISORIUS_PT_emotion"]
    head.risorius.emotion.by = "WHEEL"
    assert ("label", "Joy") in drawn()["RISORIUS_PT_emotion"]
    head.risorius.emotion.angle = 0.2
    assert ("label", "Between joy and fear") in drawn()["RISORIUS_PT_emotion"]


def test_a_face_with_clips_shows_them_and_bakes_them(head: Any) -> None:
    assert ("operator", "risorius.bake_expression") in drawn()["RISORIUS_PT_bake"]
    bpy.ops.risorius.add_clip()
    shown = drawn()
    assert ("list", "clips") in shown["RISORIUS_PT_timeline"]
    assert ("label", "Edits the clip joy") in shown["RISORIUS_PT_emotion"]
    assert ("operator", "risorius.bake_strips") in shown["RISORIUS_PT_bake"]
    assert ("operator", "risorius.bake_expression") not in shown["RISORIUS_PT_bake"]
    head.risorius.timeline.linked = False
    assert not [text for _, text in drawn()["RISORIUS_PT_emotion"] if "clip" in text]


def test_missing_scipy_is_said_with_the_remedy(monkeypatch: pytest.MonkeyPatch) -> None:
    from risorius.operators.face import panel

    monkeypatch.setattr(panel, "has_scipy", lambda: False)
    labels = [text for kind, text in drawn()["RISORIUS_PT_main"] if kind == "label"]
    assert labels[0] == requirements.MISSING
    assert any("python3-scipy" in text for text in labels)


def test_a_new_word_brings_its_own_activation_and_variants(head: Any) -> None:
    emotion = head.risorius.emotion
    emotion.variant = "1"
    emotion.activation = 2.0
    emotion.word = "fear"
    assert emotion.activation == pytest.approx(4.9)
    assert emotion.variant == "DEFAULT"
    emotion.variant = "8"
    emotion.activation = 6.0
    bpy.ops.risorius.reset_activation()
    assert emotion.activation == pytest.approx(4.9)
    assert not bpy.ops.risorius.reset_activation.poll()


def test_all_words_can_be_chosen_and_keep_their_number(head: Any) -> None:
    from risorius.mpeg4 import WORDS
    from risorius.operators.emotion.props import word_items

    items = word_items(head.risorius.emotion, bpy.context)
    assert {item[0] for item in items} == set(WORDS)
    assert len({item[4] for item in items}) == len(items)
    for name, *_ in items:
        head.risorius.emotion.word = name
        assert head.risorius.emotion.word == name


def test_a_face_with_keys_of_its_own_is_asked_once_and_shows_how_to_bake_to_them(head: Any) -> None:
    for number in range(12):
        head.shape_key_add(name=f"morph {number}")
    assert ("label", "Has 11 shape keys: try My Keys") in drawn()["RISORIUS_PT_bake"]
    assert ("prop", "creases") in drawn()["RISORIUS_PT_bake"]
    head.risorius.bake.onto = "KEYS"
    shown = drawn()["RISORIUS_PT_bake"]
    assert [name for kind, name in shown if kind == "prop"][:5] == ["clip", "onto", "above", "symmetric", "smooth"]
    assert ("prop", "creases") not in shown
    head.risorius.bake.onto = "NEW"
    assert "try My Keys" not in str(drawn()["RISORIUS_PT_bake"])
    assert ("prop", "above") not in drawn()["RISORIUS_PT_bake"]


def test_what_keeps_a_face_from_being_baked_to_its_keys_is_said(head: Any) -> None:
    head.risorius.bake.onto = "KEYS"
    assert ("label", "Has no shape keys of its own") in drawn()["RISORIUS_PT_bake"]


def test_clips_on_the_rig_say_how_far_it_follows_and_each_can_be_taken_off(head: Any) -> None:
    from risorius.scene.rig.channels import Channel, Place
    from risorius.scene.rig.clips import Keyframes, write_rig_clip
    from risorius.scene.rig.kept import Followed, keep
    from risorius.scene.shape_mix import data_path

    head.shape_key_add(name="Basis")
    head.shape_key_add(name="smile").value = 0.0
    channel = Channel("smile", Place(head.data.shape_keys, data_path("smile")), 0.0, 1.0)
    frames = Keyframes(np.array([1.0, 10.0, 20.0]), {channel: np.array([0.0, 1.0, 0.0])})
    carriers = ("mouthSmileLeft", "mouthSmileRight", "browInnerUp", "cheekPuff")
    missing = ("open_jaw", "depress_chin", "raise_b_midlip_o")
    keep(write_rig_clip(head, "joy", frames).actions, Followed(0.934, 0.00102, carriers, missing))
    shown = drawn()["RISORIUS_PT_bake"]
    assert ("label", "93%, 1.0 mm off") in shown
    at = shown.index(("label", "Mostly: mouthSmileLeft,"))
    lines = ["mouthSmileRight, browInnerUp +1", "Too little: open_jaw,", "depress_chin, raise_b_midlip_o"]
    assert [text for _, text in shown[at + 1 : at + 4]] == lines
    assert [name for kind, name in shown if kind == "operator"].count("risorius.clear") == 2
    keep(write_rig_clip(head, "late", Keyframes(frames.frames + 100.0, frames.values)).actions, Followed(0.5, 0.0))
    assert "mouthSmileLeft" in str(drawn()["RISORIUS_PT_bake"])
    bpy.context.scene.frame_set(60)
    shown = drawn()["RISORIUS_PT_bake"]
    assert ("label", "93%, 1.0 mm off") in shown
    assert "mouthSmileLeft" not in str(shown), "of several clips, those at the current frame say more"


def test_speech_on_the_timeline_shows_its_words(head: Any, tmp_path: Path) -> None:
    assert "RISORIUS_PT_words" not in drawn()
    path = tmp_path / "line.txt"
    path.write_text("0.0 0.2 m\n0.2 0.4 a\n", encoding="utf-8")
    head.risorius.speech.source, head.risorius.speech.timings = "TIMINGS", str(path)
    assert bpy.ops.risorius.add_speech() == {"FINISHED"}
    shown = drawn()
    assert ("list", "strips") in shown["RISORIUS_PT_speech"]
    assert {("list", "words"), ("list", "sounds")} <= set(shown["RISORIUS_PT_words"])
    assert ("prop", "with_feeling") in shown["RISORIUS_PT_speech"]
    bpy.ops.risorius.add_clip()
    assert ("prop", "with_feeling") not in drawn()["RISORIUS_PT_speech"]
