"""The neutral face guessed from pictures that may show none: what is learnt from it, and how wrong it says it is."""

from __future__ import annotations

import numpy as np
import pytest
import risorius.api as api
from risorius.errors import FormatError, ModelError
from risorius.face.tracked.mediapipe_landmarks import landmark_numbers, stable_points
from risorius.mpeg4.streams.capture import Landmarks
from risorius.track import generic_landmarks, people, track_landmarks

MOUTH = [landmark_numbers()[name] for name in ("8.1", "8.2", "8.3", "8.4", "2.2", "2.3", "2.4", "2.5", "2.8", "2.9")]


def pictures(*faces: np.ndarray) -> Landmarks:
    """Faces (478, 3) in mm as pictures."""
    return Landmarks(np.arange(len(faces)) / 25.0, np.array(faces) / 300.0)


def spread(guess: people.Guess) -> np.ndarray:
    """(478,) root mean square error of each point, mm."""
    return np.asarray(1e3 * np.sqrt((guess.errors**2).sum(axis=(0, 2))))


def test_the_usual_face_is_guessed_to_be_its_own_neutral_one() -> None:
    guess = people.guess_neutral(pictures(generic_landmarks()))
    known = ~np.isnan(guess.face[:, 0])
    away = 1e3 * guess.face[known] - generic_landmarks()[known]
    np.testing.assert_allclose(away - away.mean(axis=0), 0.0, atol=0.2)
    assert 1.0 < spread(guess)[MOUTH].mean() < 6.0


def test_an_expression_does_not_move_the_guess() -> None:
    smiling = generic_landmarks().copy()
    smiling[MOUTH] += (0.0, 8.0, 0.0)
    at_rest, moved = (people.guess_neutral(pictures(face)).face for face in (generic_landmarks(), smiling))
    np.testing.assert_allclose(moved, at_rest, atol=1e-9)


def test_points_that_do_not_move_tell_of_those_that_do() -> None:
    """A face that differs in a way that is known is guessed better from its steady points than by the mean."""
    known = people._people()
    numbers = [landmark_numbers()[name] for name in known.names]
    sizes, ways = np.linalg.eigh(known.covariance)
    better = []
    for number in (1, 2, 3, 4):
        away = 2.0 * np.sqrt(sizes[-number]) * ways[:, -number].reshape(-1, 3)
        face = np.full((478, 3), np.nan)
        face[numbers] = 1e3 * (known.mean + away)
        guess = people.guess_neutral(pictures(face)).face[numbers]
        free = [index for index, name in enumerate(known.names) if name not in stable_points()]
        better.append(
            np.linalg.norm((guess - known.mean - away)[free]) / max(np.linalg.norm(away[free]), 1e-9),
        )
    assert min(better) < 0.7
    assert max(better) < 1.1


def test_several_pictures_of_one_person_leave_less_doubt() -> None:
    face = generic_landmarks().copy()
    face[MOUTH] += (0.0, 4.0, 0.0)  # the mouth stands high
    expressions = []
    for shift in ((0.0, 6.0, 0.0), (0.0, -6.0, 0.0), (0.0, 0.0, 0.0), (3.0, 1.0, 0.0), (-3.0, 0.0, 0.0)):
        shown = face.copy()
        shown[MOUTH] += shift
        expressions.append(shown)
    one, many = people.guess_neutral(pictures(expressions[0])), people.guess_neutral(pictures(*expressions))
    assert spread(many)[MOUTH].mean() < 0.7 * spread(one)[MOUTH].mean()
    higher = 1e3 * (many.face - people.guess_neutral(pictures(generic_landmarks())).face)[MOUTH, 1]
    assert (higher > 1.5).all()
    assert (higher < 4.5).all()


def test_few_pictures_are_read_against_the_guess_and_many_against_the_usual_face() -> None:
    faces = [generic_landmarks()] * 12
    assert track_landmarks(pictures(*faces[:4])).generic
    assert not track_landmarks(pictures(*faces)).generic
    assert track_landmarks(pictures(*faces[:4]), neutral=(0.0, 0.04)).doubt.shape == (68, 0)


def test_the_doubt_says_which_faps_the_guess_may_have_wrong() -> None:
    doubt = np.sqrt((track_landmarks(pictures(generic_landmarks())).doubt ** 2).sum(axis=1))
    assert (doubt[[12 - 1, 13 - 1, 5 - 1, 18 - 1]] > 40.0).all()  # mouth and chin
    assert (doubt[[31 - 1, 33 - 1]] > 10.0).all()
    assert (doubt[[43 - 1, 48 - 1, 65 - 1]] == 0.0).all()  # what no landmark shows


def test_another_person_s_neutral_face_is_neutral() -> None:
    """A high mouth and chin, as some people have: by its FAPs alone an expression, within the doubt none."""
    face = generic_landmarks().copy()
    numbers = landmark_numbers()
    lower = [numbers[name] for name in numbers if name.split(".")[0] in ("2", "8")]
    face[lower] += (0.0, 4.0, 0.0)
    track = track_landmarks(pictures(face))
    assert track.recognise().best == (api.NEUTRAL,)
    assert api.recognise(track.stream.frames[0], rule="robust").best != api.NEUTRAL


def test_a_smile_is_a_smile_against_the_guess() -> None:
    face = generic_landmarks().copy()
    numbers = landmark_numbers()
    for name, aside in (("8.3", 1.0), ("2.4", 1.0), ("8.4", -1.0), ("2.5", -1.0)):
        face[numbers[name]] += (7.0 * aside, 9.0, 0.0)
    for name in ("2.2", "2.6", "2.7", "8.1", "8.5", "8.6", "8.9", "8.10"):
        face[numbers[name]] += (0.0, 4.0, 0.0)
    for name in ("3.3", "3.4", "5.3", "5.4"):
        face[numbers[name]] += (0.0, 3.0, 0.0)
    assert track_landmarks(pictures(face)).recognise().best == ("joy",)


def test_without_a_whole_face_there_is_no_guess() -> None:
    with pytest.raises(ModelError, match="whole face"):
        people.guess_neutral(pictures(np.full((478, 3), np.nan)))


def test_a_damaged_table_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    rows = dict(people._rows())
    rows.pop(("2.1", "up"))
    monkeypatch.setattr(people, "_rows", lambda: rows)
    people._people.cache_clear()
    with pytest.raises(FormatError, match=r"people\.csv"):
        people._people()
    people._people.cache_clear()
