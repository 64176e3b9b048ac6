"""The tables that scores of trackers and names of shape keys go by: signs, sides, and what is refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from risorius.errors import FormatError
from risorius.mpeg4.streams.capture import load_columns, load_key_names, load_shapes

SHAPES = load_shapes()


def test_there_are_the_52_blend_shapes_and_each_says_something() -> None:
    assert len(SHAPES) == 52
    assert all(np.isfinite(shape.frame).any() and shape.source for shape in SHAPES.values())
    assert len([name for name in SHAPES if name.endswith(("Left", "Right"))]) == 40


@pytest.mark.parametrize("name", sorted(SHAPES))
def test_every_shape_says_the_mirrored_of_its_other_side(name: str) -> None:
    """Mirrored twice is itself; the pair of both sides is symmetric."""
    shape = SHAPES[name]
    twice = shape.mirrored("x").mirrored(name)
    np.testing.assert_array_equal(twice.frame, shape.frame)
    assert twice.contractions == dict(shape.contractions)
    if name.endswith("Left"):
        np.testing.assert_array_equal(SHAPES[name[:-4] + "Right"].frame, shape.mirrored("x").frame)


@pytest.mark.parametrize(
    ("shape", "number", "sign"),
    [
        ("jawOpen", 3, 1), ("eyeBlinkLeft", 19, 1), ("eyeBlinkRight", 20, 1), ("eyeWideLeft", 19, -1),
        ("browInnerUp", 31, 1), ("browDownLeft", 33, -1), ("browOuterUpRight", 36, 1), ("mouthSmileLeft", 59, 1),
        ("mouthSmileLeft", 53, 1), ("mouthFrownRight", 60, -1), ("mouthPucker", 17, 1), ("jawLeft", 15, -1),
        ("jawRight", 15, 1), ("mouthLeft", 53, 1), ("mouthRight", 54, 1), ("mouthUpperUpLeft", 8, -1),
        ("mouthLowerDownLeft", 10, -1), ("cheekPuff", 39, 1), ("cheekSquintLeft", 41, 1), ("noseSneerLeft", 55, -1),
        ("tongueOut", 45, 1), ("eyeLookInLeft", 23, -1), ("eyeLookInRight", 24, 1), ("eyeLookOutLeft", 23, 1),
        ("eyeLookUpLeft", 25, -1), ("eyeLookDownRight", 26, 1), ("jawForward", 14, 1), ("mouthShrugLower", 18, 1),
        ("mouthStretchLeft", 53, 1), ("mouthDimpleRight", 54, 1), ("mouthRollLower", 16, -1),
    ],
)  # fmt: skip
def test_dominant_faps_have_the_signs_of_facs(shape: str, number: int, sign: int) -> None:
    assert SHAPES[shape].frame[number - 1] * sign > 0.0


@pytest.mark.parametrize(
    ("unit", "number", "sign"),
    [(1, 31, 1), (2, 35, 1), (4, 33, -1), (4, 37, 1), (5, 19, -1), (6, 41, 1), (7, 21, 1), (9, 63, 1), (10, 8, -1),
     (12, 59, 1), (15, 59, -1), (17, 18, 1), (20, 53, 1), (25, 5, -1), (26, 3, 1), (45, 20, 1)],
)  # fmt: skip
def test_action_units_have_the_signs_of_facs(unit: int, number: int, sign: int) -> None:
    assert load_columns().gains[f"au{unit:02d}_r"][number - 1] * sign > 0.0


@pytest.mark.parametrize(
    ("text", "key"),
    [
        ("[shapes.a]\nfaps = { 3 = 1 }", "shapes.a.source"),
        ('[shapes.a]\nfaps = { 2 = 1 }\nsource = "x"', "shapes.a.faps"),
        ('[shapes.a]\nfaps = { 3 = "much" }\nsource = "x"', "shapes.a.faps.3"),
        ('[shapes.a]\ncontractions = { risorius_l = 2 }\nsource = "x"', "shapes.a.contractions.risorius_l"),
        ('[shapes.a]\nover = "b"\nsource = "x"', "shapes.a.over"),
        ('[shapes.a]\nfap = { 3 = 1 }\nsource = "x"', "shapes.a.fap"),
        ("x = 1", "shapes"),
    ],
)
def test_a_table_of_shapes_that_breaks_a_rule_is_refused(text: str, key: str, tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(text)
    with pytest.raises(FormatError) as refused:
        load_shapes(path)
    assert refused.value.key == key


def test_key_names_of_every_preset_and_of_a_users_file(tmp_path: Path) -> None:
    assert set(load_key_names("arkit")) == set(SHAPES)
    assert len(load_key_names("ict_facekit")) == 52
    visemes = load_key_names("oculus_visemes")
    assert len(visemes) == 15
    assert visemes["viseme_sil"].parts == ()
    assert visemes["viseme_PP"].parts[0][0].frame[16] < 0.0  # the upper lip pressed back
    (tmp_path / "own.toml").write_text("[keys.grin]\nshapes = { mouthSmileLeft = 0.5, mouthSmileRight = 0.5 }\n")
    own = load_key_names(tmp_path / "own.toml")
    assert [(shape.name, share) for shape, share in own["grin"].parts] == [
        ("mouthSmileLeft", 0.5), ("mouthSmileRight", 0.5),
    ]  # fmt: skip


def test_expressions_of_vrm_and_extras_of_talkinghead() -> None:
    vrm = load_key_names("vrm1")
    assert set(vrm) == {
        "happy", "angry", "sad", "relaxed", "surprised", "neutral", "aa", "ih", "ou", "ee", "oh", "blink", "blinkLeft",
        "blinkRight", "lookUp", "lookDown", "lookLeft", "lookRight",
    }  # fmt: skip
    assert vrm["neutral"].parts == ()
    gaze = sum(share * shape.frame[23 - 1] for shape, share in vrm["lookLeft"].parts if shape.name.endswith("Left"))
    assert gaze > 0.0  # the left eye turns to the character's left
    (happy, share), *others = vrm["happy"].parts
    assert (vrm["happy"].natural, share, others) == (True, 1.0, [])
    assert happy.frame[12 - 1] > 0.0  # a corner of the lips rises
    assert vrm["aa"].parts[0][0].frame[2] > 0.0  # the jaw opens
    together = load_key_names("arkit,oculus_visemes,talkinghead_extras")
    assert len(together) == 52 + 15 + 5
    assert [(shape.name, share) for shape, share in together["mouthOpen"].parts] == [("jawOpen", 0.7)]


def test_presets_that_contradict_one_another_are_refused(tmp_path: Path) -> None:
    own = tmp_path / "own.toml"
    own.write_text("[keys.jawOpen]\nshapes = { jawOpen = 0.5 }\n")
    with pytest.raises(FormatError, match="key jawOpen: means something else in an earlier preset"):
        load_key_names(f"arkit,{own}")
    own.write_text("[keys.jawOpen]\nshapes = { jawOpen = 1.0 }\n[keys.more]\nrest = true\n")
    assert len(load_key_names(f"arkit,{own}")) == 53


@pytest.mark.parametrize(
    ("row", "key"),
    [
        ('emotion = "hunger"', "keys.a.emotion"),
        ("shapes = { grinning = 1 }", "keys.a.shapes.grinning"),
        ("shapes = { jawOpen = 9 }", "keys.a.shapes.jawOpen"),
        ("viseme = 15", "keys.a.viseme"),
        ("visem = 1", "keys.a.visem"),
        ("", "keys.a"),
    ],
)
def test_key_names_that_break_a_rule_are_refused(row: str, key: str, tmp_path: Path) -> None:
    (tmp_path / "own.toml").write_text(f"[keys.a]\n{row}\n")
    with pytest.raises(FormatError) as refused:
        load_key_names(tmp_path / "own.toml")
    assert refused.value.key == key
