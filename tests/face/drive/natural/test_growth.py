"""From a trace at activation 1 to all a face can do at 7: evenly, and in an order of its own."""

from __future__ import annotations

import numpy as np
import pytest
import risorius.api as api
from risorius.api import Face
from risorius.arrays import Floats
from risorius.face.drive.natural.planning import Natural
from risorius.face.drive.request import Request
from risorius.mpeg4 import Feeling

NATURAL = Natural()
ACTIVATIONS = tuple(float(activation) for activation in range(1, 8))
WAYS = [(emotion, way) for emotion, ways in api.load_prototypes().items() for way in ways]

#: No step from one activation to the next is more or less than these times the mean step.
MOST, LEAST = 1.6, 0.5


def requested(emotion: str, activation: float, way: str | None = None) -> Request:
    """An emotion as a face is asked for it."""
    profile = api.expression(emotion, activation=activation, variants=way)
    return Request(profile.frame(), emotion=Feeling.of(profile.weights))


def steps(shown: Floats) -> tuple[Floats, Floats]:
    """(6,) each, over their mean: steps towards what 7 shows, and their own lengths; shown (7, n)."""
    full = shown[-1]
    towards, lengths = np.diff(shown @ full), np.linalg.norm(np.diff(shown, axis=0), axis=1)
    return towards / towards.mean(), lengths / lengths.mean()


@pytest.mark.parametrize(("emotion", "way"), WAYS)
def test_every_way_of_showing_an_emotion_grows_evenly(emotion: str, way: str) -> None:
    data = NATURAL.data
    goals = np.array([NATURAL.plan(requested(emotion, a, way)).goal[data.numbers - 1] for a in ACTIVATIONS])
    towards, lengths = steps(np.nan_to_num(goals * data.per_fap))
    assert towards.min() > LEAST
    assert lengths.min() > LEAST
    assert towards.max() < MOST
    assert lengths.max() < MOST


@pytest.mark.parametrize("word", [name for name, word in api.WORDS.items() if word.shows is not None])
def test_every_word_with_units_of_its_own_grows_evenly(word: str) -> None:
    data = NATURAL.data
    goals = np.array([NATURAL.plan(requested(word, a)).goal[data.numbers - 1] for a in ACTIVATIONS])
    for over_mean in steps(np.nan_to_num(goals * data.per_fap)):
        assert LEAST < over_mean.min() <= over_mean.max() < MOST


@pytest.mark.slow
@pytest.mark.parametrize("emotion", list(api.ARCHETYPES))
def test_skin_moves_evenly_further(face: Face, emotion: str) -> None:
    shown, largest = [], []
    for activation in ACTIVATIONS:
        profile = api.expression(emotion, activation=activation)
        moved = (face.pose(profile.frame(), emotion=profile.weights).positions - face.vertices)[face.outer_skin]
        shown.append(moved.ravel())
        largest.append(float(np.linalg.norm(moved, axis=1).max()))
    towards, lengths = steps(np.array(shown))
    assert towards.min() > LEAST
    assert towards.max() < MOST
    assert lengths.min() > LEAST
    assert lengths.max() < MOST
    assert (np.diff(largest) > 0.0).all()


@pytest.mark.parametrize("activation", [None, 6.0, 7.0])
@pytest.mark.parametrize("emotion", list(api.ARCHETYPES))
def test_an_emotion_at_its_strongest_is_taken_for_no_other(emotion: str, activation: float | None) -> None:
    own = api.expression(emotion).activation
    goal = NATURAL.plan(requested(emotion, own if activation is None else activation)).goal
    assert api.recognise(goal, rule="robust").best == emotion


@pytest.mark.parametrize(
    ("emotion", "first", "later"),
    [("joy", 12, (21, 4)), ("surprise", 33, (3,)), ("fear", 31, (3, 5)), ("anger", 31, (4,))],
)
def test_an_emotion_begins_with_what_gives_it_away(emotion: str, first: int, later: tuple[int, ...]) -> None:
    """Share of what 7 shows, at activation 1."""
    trace, full = (np.abs(NATURAL.plan(requested(emotion, a)).goal) for a in (1.0, 7.0))
    for number in later:
        assert trace[first - 1] / full[first - 1] > 1.3 * trace[number - 1] / full[number - 1]


@pytest.mark.parametrize(("emotion", "way"), [p for p in WAYS if p[0] in ("sadness", "fear", "anger")])
def test_inner_brows_never_come_back_as_an_emotion_grows(emotion: str, way: str) -> None:
    goals = np.array([NATURAL.plan(requested(emotion, a, way)).goal for a in ACTIVATIONS])
    inner, middle = goals[:, 31 - 1], goals[:, 33 - 1]
    assert (np.diff(np.abs(inner)) > -0.5).all()
    assert abs(inner[-1]) > 1.5 * abs(inner[1])
    if emotion != "anger":  # they rise alone, or most
        assert (inner > middle + 15.0).all()
