"""What a word means: action units beside the paper's profile."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import risorius.api as api
from risorius.api import Face, Feeling
from risorius.errors import FormatError, ParameterError
from risorius.face.drive.natural.meaning import Meaning
from risorius.face.drive.natural.synergies import load_synergies
from risorius.mpeg4.emotions.prototypes import TABLE, load_prototypes

MEANING = Meaning(load_synergies())


def meant(word: str, activation: float | None = None, **options: object) -> np.ndarray:
    """(68,) FAPs that a word means."""
    profile = api.expression(word, activation=activation, **options)  # type: ignore[arg-type]
    assert isinstance(profile.weights, Feeling)
    return MEANING.meant(profile.frame(), profile.weights)


def test_joy_leaves_the_brows_and_raises_cheeks_and_corners() -> None:
    joy = api.expression("joy")
    assert joy.frame()[33 - 1] > 50.0
    asked = meant("joy")
    assert np.nan_to_num(asked[30:36]) == pytest.approx(0.0, abs=1e-9)
    assert asked[12 - 1] > joy.frame()[12 - 1]
    assert asked[41 - 1] >= joy.frame()[41 - 1]
    assert asked[4 - 1] < -200.0  # teeth show


def test_fear_is_no_gape() -> None:
    fear = api.expression("fear")
    assert fear.frame()[3 - 1] > 400.0
    asked = meant("fear")
    assert 0.0 < asked[3 - 1] < 0.6 * fear.frame()[3 - 1]
    assert asked[6 - 1] > 100.0  # stretched corners tell it from surprise
    assert meant("surprise")[6 - 1] < 20.0


def test_anger_bares_teeth_or_presses_lips_as_it_is_asked() -> None:
    bared, pressed = meant("anger"), meant("anger", variants="pressed")
    assert bared[8 - 1] < -300.0
    assert not pressed[8 - 1] < -100.0
    assert pressed[5 - 1] > 50.0
    assert bared[21 - 1] > 150.0  # tightened lids, either way
    assert pressed[21 - 1] > 150.0


def test_a_variant_of_the_paper_is_shown_as_printed() -> None:
    for variant in (1, 2):
        chosen = api.expression("joy", variants=variant)
        np.testing.assert_allclose(meant("joy", variants=variant), chosen.frame(), rtol=1e-12)
    printed = api.archetype("joy", 1)
    np.testing.assert_allclose(MEANING.meant(printed.frame(), Feeling.of(printed.weights)), printed.frame(), rtol=1e-12)


@pytest.mark.parametrize("word", list(api.ARCHETYPES))
def test_every_emotion_grows_with_its_activation(word: str) -> None:
    """What it shows most of grows from each whole activation to the next, up to 7."""
    frames = np.array([np.nan_to_num(meant(word, activation)) for activation in range(1, 8)])
    metres = frames[:, MEANING.data.numbers - 1] * MEANING.data.per_fap
    size = np.linalg.norm(metres, axis=1)
    assert (np.diff(size) > 0.02 * size[-1]).all(), size


def test_a_slight_smile_is_corners_alone() -> None:
    trace = meant("joy", 1.0)
    assert trace[12 - 1] > 40.0
    assert not trace[4 - 1] < -60.0
    assert abs(np.nan_to_num(trace[41 - 1])) < 0.4 * trace[12 - 1]


def test_what_is_meant_is_continuous_in_activation_and_angle() -> None:
    def steps(frames: list[np.ndarray]) -> float:
        metres = np.array([np.nan_to_num(f)[MEANING.data.numbers - 1] * MEANING.data.per_fap for f in frames])
        return float(np.abs(np.diff(metres, axis=0)).max())

    activations = [meant("anger", a) for a in np.linspace(1.0, 7.0, 241)]
    assert steps(activations) < 0.6e-3
    around = [api.expression(angle=a, activation=5.0) for a in np.linspace(-17.9, 17.9, 181)]
    frames = [MEANING.meant(p.frame(), Feeling.of(p.weights)) for p in around if len(p.weights) > 1]
    assert steps(frames) < 1.5e-3


def test_a_word_with_units_of_its_own_is_no_small_scream() -> None:
    worried, afraid = api.expression("worried"), meant("afraid")
    assert worried.frame()[3 - 1] > 200.0  # the paper opens the jaw
    asked = meant("worried")
    assert asked[3 - 1] < 30.0
    assert asked[31 - 1] > 60.0
    assert asked[37 - 1] > 20.0
    assert afraid[6 - 1] > asked[6 - 1] + 60.0


def test_contempt_raises_one_corner_and_bored_lids_hang(face: Face) -> None:
    contempt = api.expression("contemptuous")
    pose = face.pose(contempt.frame(), emotion=contempt.weights)
    assert pose.achieved[12 - 1] > pose.achieved[13 - 1] + 100.0
    bored = api.expression("bored")
    assert face.pose(bored.frame(), emotion=bored.weights).achieved[19 - 1] > 250.0


def test_what_is_chosen_wins_over_the_units_of_a_word() -> None:
    assert api.expression("worried").shows is not None
    for variants in ({"fear": 8}, 8, "drawn"):
        assert api.expression("worried", variants=variants).shows is None  # type: ignore[arg-type]
    printed = api.expression("worried", variants=8).frame()
    np.testing.assert_allclose(meant("worried", variants=8), printed, rtol=1e-12)


def test_a_word_of_ones_own_has_units_of_its_own(tmp_path: Path) -> None:
    text = '[smug]\nactivation = 3.5\ncategory = "joy"\nreason = "half a smile"\nsource = "own"\n[smug.shows]\n'
    file = tmp_path / "mine.toml"
    file.write_text(text + 'source = "own"\nAU12_r = [0, 0.5, 1.0]\n')
    smug = api.expression("smug", words=api.load_emotions([file]))
    asked = MEANING.meant(smug.frame(), Feeling.of(smug.weights))
    assert asked[13 - 1] > 100.0
    assert abs(np.nan_to_num(asked[12 - 1])) < 1e-9
    file.write_text(text + 'source = "own"\nAU99 = [0, 0.5, 1.0]\n')
    strange = api.expression("smug", words=api.load_emotions([file]))
    with pytest.raises(FormatError, match=r"smug.*AU99"):
        MEANING.meant(strange.frame(), Feeling.of(strange.weights))
    file.write_text(text + 'source = "own"\nAU12 = [4, 0.5, 1.0]\n')
    with pytest.raises(FormatError, match=r"smug\.shows\.AU12: must be the activation .*, from 0 below 3\.5"):
        api.load_emotions([file])


def test_an_unknown_way_lists_those_there_are(face: Face) -> None:
    with pytest.raises(ParameterError, match="bared, pressed"):
        api.expression("anger", variants="icy")
    anger = api.expression("anger")
    with pytest.raises(ParameterError, match="bared, pressed"):
        face.pose(anger.frame(), emotion=Feeling({"anger": 1.0}, prototypes={"anger": "icy"}))
    with pytest.raises(ParameterError, match="expression between two"):
        api.expression("guilty", variants="pressed")


def test_a_pose_says_what_the_emotion_showed_otherwise(face: Face) -> None:
    joy = api.expression("joy")
    pose = face.pose(joy.frame(), emotion=joy.weights)
    assert pose.reasons[33] == "the emotion shows it otherwise than the profile"
    assert pose.reasons[4] == "not in the profile; the emotion shows it"
    assert pose.asked[33 - 1] == joy.frame()[33 - 1]
    assert not pose.unmet
    assert abs(pose.achieved[33 - 1]) < 20.0


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("AU12 = [0, 1.15, 1.5]", "AU12 = [0, 1.0]", "joy.open.AU12"),
        ("AU12 = [0, 1.15, 1.5]", "AU12 = [8, 1.0, 1.3]", "joy.open.AU12: must be the activation"),
        ("still = [31, 32", "still = [99, 32", "names FAP 99"),
    ],
)
def test_a_wrong_row_is_refused(tmp_path: Path, old: str, new: str, said: str) -> None:
    text = TABLE.read_text(encoding="utf-8")
    assert old in text
    (tmp_path / "prototypes.toml").write_text(text.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(FormatError, match=said):
        load_prototypes(tmp_path / "prototypes.toml")


def test_anger_draws_the_brows_heads_down_and_together_and_narrows_the_eyes() -> None:
    for activation in (3.0, None, 7.0):
        asked = meant("anger", activation)
        assert asked[31 - 1] < asked[33 - 1] < asked[35 - 1] < 0.0  # a V: the head of the brow lower than its middle
        assert asked[37 - 1] > 25.0
        assert asked[19 - 1] > 0.0  # raised upper lids read as fear
        assert asked[21 - 1] > 100.0


@pytest.mark.parametrize("way", ["pressed", "glaring"])
def test_pressed_lips_narrow_their_red_and_roll_in(face: Face, way: str) -> None:
    profile = api.expression("anger", variants=way)
    shown = face.pose(profile.frame(), emotion=profile.weights).achieved
    assert shown[51 - 1] - shown[4 - 1] > 90.0  # the upper lip's outer edge nearer to its inner one
    assert shown[52 - 1] - shown[5 - 1] > 90.0
    assert shown[17 - 1] < -80.0  # and back
