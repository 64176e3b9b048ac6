"""The evidence for recognition: what is posed, how it is counted, what the page says."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import numpy as np
import pytest
import risorius.api as api
from recognition import page as page_of
from recognition import plots, poses, samples, scans, shapes, verdicts
from risorius.mpeg4 import FEATURES, Rule


@dataclass
class PerfectFace:
    """A face that shows exactly what it is asked, and rest elsewhere; its positions are the frame itself."""

    told: list[tuple[str, Any]] = field(default_factory=list)

    def sketcher(self) -> PerfectFace:
        return self

    def sketch(self, frame: np.ndarray, *, drive: str, emotion: Any) -> SimpleNamespace:
        self.told.append((drive, emotion))
        return SimpleNamespace(positions=np.nan_to_num(frame))

    def measure(self, positions: np.ndarray) -> np.ndarray:
        return positions

    def features(self, positions: np.ndarray) -> np.ndarray:
        return np.array([np.mean([positions[n - 1] / share for n, share in f.shares.items()]) for f in FEATURES])


def posed(series: str, *, draws: int = 1, name: str = "default") -> Any:
    """A series on a perfect face."""
    return poses.pose_all(PerfectFace(), poses.Series(series), name=name, draws=draws, seed=len(name))


def test_every_profile_is_posed_at_every_activation() -> None:
    measured = posed("natural", draws=2)
    assert len(measured.faps) == 25 * 4 * 2
    for index in range(0, 200, 2):
        profile = poses.scaled(api.Archetype(measured.asked[index]), measured.variants[index], measured.shares[index])
        for number, (low, high) in profile.ranges.items():
            assert low - 1e-9 <= measured.faps[index, number - 1] <= high + 1e-9
    assert not np.array_equal(measured.faps[0], measured.faps[1])


def test_activations_are_held_to_the_wheel() -> None:
    scaled = poses.scaled
    assert scaled(api.Archetype.SURPRISE, 1, 1.3).activation == 7.0
    assert scaled(api.Archetype.SURPRISE, 1, 0.6).activation == pytest.approx(0.6 * 6.5)


@pytest.mark.parametrize(("series", "drive"), [("natural", "natural"), ("exact", "exact"), ("untold", "natural")])
def test_only_untold_poses_are_not_told_the_emotion(series: str, drive: str) -> None:
    face = PerfectFace()
    measured = poses.pose_all(face, poses.Series(series), name="default", draws=1, seed=0)
    for asked, (used, emotion) in zip(measured.asked, face.told, strict=True):
        assert used == drive
        assert emotion == (None if series == "untold" else {asked: 1.0})


def test_what_was_measured_is_not_measured_again(tmp_path: Path) -> None:
    built = []

    def build() -> PerfectFace:
        built.append(1)
        return PerfectFace()

    faces = {"default": build, "ict identity 0": build}
    first = poses.gather(poses.Series.EXACT, faces, tmp_path)
    again = poses.gather(poses.Series.EXACT, faces, tmp_path)
    assert len(built) == 2
    np.testing.assert_array_equal(first.faps, again.faps)
    assert set(again.faces) == set(faces)
    assert again.asked.tolist() == first.asked.tolist()
    half = again.part(again.faces == "default")
    assert len(half.faps) == len(half.asked) == len(first.faps) / 2


def test_verdicts_are_counted() -> None:
    names = verdicts.EMOTIONS
    asked = np.repeat(names, 4)
    said = asked.copy()
    said[0], said[1] = names[2], verdicts.NOTHING
    assert verdicts.correct(asked, said) == (22 / 24, 0.5)
    shares = verdicts.confusion(asked, said)
    np.testing.assert_allclose(shares.sum(axis=1), 1.0)
    assert shares[0].tolist() == [0.5, 0.0, 0.25, 0.0, 0.0, 0.0, 0.0, 0.25]
    believed = np.zeros((2, 6))
    believed[0, 3] = 0.1
    assert verdicts.verdicts(believed).tolist() == [names[3], verdicts.NOTHING]


def test_every_shape_is_half_one_width_away() -> None:
    for shape in shapes.Shape:
        values = shape.at(np.array([0.0, 0.5, 1.0, 3.0]))
        assert values[0] == 1.0
        assert values[2] == pytest.approx(0.5)
        assert (np.diff(values) < 0.0).all()


@pytest.mark.parametrize("rule", Rule)
def test_with_the_choice_in_use_it_says_what_recognise_says(rule: Rule) -> None:
    random = np.random.default_rng(5)
    faps = random.normal(scale=200.0, size=(30, 68))
    faps[random.random(faps.shape) < 0.3] = np.nan
    expected = [list(api.recognise(row, rule=rule).values()) for row in faps]
    np.testing.assert_allclose(shapes.believed(faps, shapes.own(rule)), expected, atol=1e-12)
    if rule is Rule.ROBUST:
        return  # it has one curve
    flat = shapes.Choice(shapes.Shape.FLAT_NORMAL, 1.0, 80.0, rule)
    more = shapes.believed(faps, flat) - shapes.believed(faps, shapes.own(rule))
    assert more.min() >= 0.0  # inside a range nothing is taken off
    assert more.max() > 0.1


def test_halves_share_no_face_and_no_variant(monkeypatch: Any) -> None:
    monkeypatch.setattr(shapes, "CHOICES", (shapes.own(Rule.PAPER),))
    parts = [posed("exact", name=name) for name in ("a", "b", "c")]
    columns = {key: np.concatenate([vars(part)[key] for part in parts]) for key in vars(parts[0]) if key != "seconds"}
    seen = []
    monkeypatch.setattr(shapes, "score", lambda measured, _: seen.append(measured) or (1.0, 1.0))
    trials = shapes.held_out(poses.Measured(**columns, seconds=0.0))
    assert [trial.split for trial in trials] == ["faces"] * 2 + ["variants"] * 2
    for index in range(len(trials)):
        chosen_on, judged_on, own_on = seen[3 * index : 3 * index + 3]
        key = "faces" if index < 2 else "variants"
        assert not set(vars(chosen_on)[key]) & set(vars(judged_on)[key])
        assert len(chosen_on.faps) + len(judged_on.faps) == 300
        assert len(own_on.faps) == len(judged_on.faps)


def test_combinations_are_made_of_known_units() -> None:
    emotions = {each.emotion for each in scans.combinations()}
    assert emotions == set(verdicts.EMOTIONS)
    for each in scans.combinations():
        assert set(each.units) <= set(scans.units())
    nose = next(each for each in scans.combinations() if str(each) == "9")
    assert nose.missing() == [9]
    assert nose not in scans.shown()


def test_of_two_units_on_one_scan_the_stronger_counts() -> None:
    both = scans.Combination("anger", "here", {23: 0.5, 24: 0.8, 7: 1.0, 25: 1.0, 26: 1.0})
    assert both.weights() == {"mouthPress": 0.8, "jawOpen": 0.5}
    assert both.missing() == [7]
    assert str(both) == "23*0.5+24*0.8+7+25+26"


@pytest.mark.slow
def test_scans_are_named_as_they_are(shared: Path) -> None:
    displacements = scans._displacements(shared / "heads")
    assert len(displacements) == len(scans.shown())
    sizes = [np.linalg.norm(each, axis=1).max() for each in displacements]
    assert 2e-3 < min(sizes) < max(sizes) < 60e-3
    for each in displacements:  # both sides
        left, right = (np.abs(each[side]).max() for side in _sides(scans, shared))
        assert left == pytest.approx(right, rel=0.3)


def _sides(scans: ModuleType, shared: Path) -> tuple[np.ndarray, np.ndarray]:
    """Which vertices lie left and right."""
    across = scans.SharedHeads(shared / "heads").shared("ict").vertices[:, 0]
    return across > 0.005, across < -0.005


@pytest.mark.slow
def test_samples_have_a_strongest_frame(shared: Path) -> None:
    found = {each.name: each for each in samples.read_samples(shared / "samples" / "fap")}
    anger = found["xface_anger.fap"]
    assert anger.emotion == "anger"
    frames = api.read_fap(shared / "samples" / "fap" / anger.name).frames
    assert np.nansum(np.abs(frames[anger.strongest, 2:22])) > 3.0 * np.nansum(np.abs(frames[0, 2:22]))
    for rule in Rule:
        assert anger.believed[rule].shape == (len(frames), 6)
    assert found["vreng_sad.fap"].stated == 18


def figures() -> Any:
    """What a run on a perfect face leaves, with one profile spoilt and scans made up."""
    series = {poses.Series(name): posed(name) for name in ("natural", "exact", "untold")}
    natural = series[poses.Series.NATURAL]
    natural.faces[::2] = "ict"
    natural.faps[natural.asked == "disgust"] = np.nan_to_num(api.archetype("joy", 1).frame())
    asked = [each.emotion for each in scans.shown()]
    faps = np.array([np.nan_to_num(api.archetype(name, 0).frame()) for name in asked])
    scanned = poses.Measured(
        faps=faps,
        features=np.array([PerfectFace().features(row) for row in faps]),
        asked=np.array(asked),
        variants=np.arange(len(asked)),
        shares=np.ones(len(asked)),
        faces=np.full(len(asked), "ict"),
        seconds=0.0,
    )
    course = np.zeros((4, 6))
    course[2, 0] = 0.75
    rules = dict.fromkeys(Rule, course)
    sample = samples.Sample("loud.fap", "joy", 40, 25.0, 2, rules, rules)
    return page_of.Figures(series, posed("words"), scanned, [sample])


def cells(page: str, *first: str) -> list[str]:
    """The cells of the table's row that begins so."""
    line = next(line for line in page.splitlines() if line.startswith("| " + " | ".join(first) + " |"))
    return [cell.strip() for cell in line.strip("|").split("|")][len(first) :]


@pytest.mark.slow
def test_the_page_says_what_was_measured(monkeypatch: Any) -> None:
    monkeypatch.setattr(shapes, "CHOICES", page_of.CHOICES[::9])
    monkeypatch.setattr(page_of, "best_of", lambda measured, choices: (choices[0], page_of.score(measured, choices[0])))
    page = page_of.page(figures())
    right, least = cells(page, "natural")[1].split(" / ")
    assert (right, least) == ("96", "0")  # 4 of 100 poses are spoilt
    assert cells(page, "exact")[1] == "100 / 100"
    assert cells(page, "natural", "robust", "disgust 0") == ["0", "joy 100 %"]
    assert cells(page, "default")[1] == "96"
    assert cells(page, "joy", "prototype", "6+12")[:2] == ["–", "1"]
    assert cells(page, "disgust", "FACS table", "4+10+17")[0] == "17"
    assert "A combination of AU 9 alone is left out." in page
    assert "(natural: 100 poses, 1 draws each; exact: 100" in page
    assert cells(page, "loud.fap")[:6] == ["40", "2", "joy", "paper", "**joy** 0.75", "**joy** 0.19"]
    assert cells(page, "guilty")[0] == "100"
    for part in page.split("\n\n"):
        if part.startswith("|"):
            assert len({line.count(" | ") for line in part.splitlines() if not line.startswith("|---")}) <= 2


def test_pictures_are_drawn(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    drawn = figures()
    asked = next(iter(drawn.posed.values())).asked
    plots.draw_confusions({"one": (asked, asked), "two": (asked, asked)}, tmp_path / "confusion.png")
    plots.draw_samples([*drawn.samples, *drawn.samples], tmp_path / "samples.png")
    assert {path.name for path in tmp_path.iterdir()} == {"confusion.png", "samples.png"}
