"""Preset files: a user's own words, and errors that name file, key and rule."""

from __future__ import annotations

from pathlib import Path

import pytest
from risorius.errors import FormatError
from risorius.mpeg4 import WORDS, Archetype, expression, load_emotions
from risorius.mpeg4.emotions.words import LazyWords

GOOD = """
[smug]
activation = 3.5
category = "joy"
variants = { joy = 3 }
reason = "half a smile"
source = "a user"
"""


def _write(folder: Path, text: str, name: str = "mine.toml") -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def test_the_page_of_words_names_every_word_with_its_activation() -> None:
    page = (Path(__file__).parents[3] / "docs" / "words.md").read_text(encoding="utf-8")
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in page.splitlines() if line.startswith("| ")]
    said = {name: row for row in rows[1:] for name in row[0].split(", ")}
    assert set(said) == set(WORDS)
    for name, word in WORDS.items():
        assert said[name][1] == ("–" if word.neutral else f"{word.activation:.1f}")


def test_a_users_word_joins_the_bundled_ones(tmp_path: Path) -> None:
    words = load_emotions([_write(tmp_path, GOOD)])
    assert set(words) == {*WORDS, "smug"}
    profile = expression("smug", words=words)
    assert (profile.word, profile.variant, profile.activation) == ("smug", 3, 3.5)
    assert profile.category is Archetype.JOY


def test_a_folder_is_read_in_the_order_of_names_and_later_files_win(tmp_path: Path) -> None:
    _write(tmp_path, GOOD.replace("3.5", "2.0"), "b.toml")
    _write(tmp_path, GOOD, "a.toml")
    _write(tmp_path, "no preset", "notes.txt")
    assert load_emotions([tmp_path], bundled=False)["smug"].activation == 2.0


def test_a_user_may_change_a_bundled_word_and_an_archetypes_default(tmp_path: Path) -> None:
    text = '[afraid]\nactivation = 4.0\nreason = "calmer"\n[fear]\nvariants = { fear = 3 }\nreason = "brows"\n'
    words = load_emotions([_write(tmp_path, text)])
    assert words["afraid"].category is Archetype.FEAR
    assert expression("afraid", words=words).activation == 4.0
    assert expression(angle=75.0, activation=3.0, words=words).variants[Archetype.FEAR] == 3
    assert expression("afraid").activation == 4.9


@pytest.mark.parametrize(
    ("old", "new", "key", "rule"),
    [
        ("activation = 3.5", "activation = 9", "smug.activation", "from 1 to 7, but it is 9"),
        ("activation = 3.5", 'activation = "high"', "smug.activation", "but it is 'high'"),
        ("activation = 3.5", "activation = true", "smug.activation", "must be a number"),
        ("activation = 3.5", "", "smug.activation", "is missing: it must be a number from 1 to 7"),
        ("activation = 3.5", "activation = nan", "smug.activation", "must be a number"),
        ('category = "joy"', 'category = "joyful"', "smug.category", "joy, sadness, anger, fear, disgust, surprise"),
        ('category = "joy"', "", "smug.category", "unless the word has an angle"),
        ('category = "joy"', "angle = 400", "smug.angle", "from 0 to 360"),
        ("{ joy = 3 }", "{ joy = 9 }", "smug.variants.joy", "one of the variants 0, 1, 2, 3"),
        ("{ joy = 3 }", "{ glee = 0 }", "smug.variants.glee", "must name archetypes"),
        ("{ joy = 3 }", "{ joy = [1] }", "smug.variants.joy", "whole number, but it is [1]"),
        ("{ joy = 3 }", "3", "smug.variants", "must be a table"),
        ('reason = "half a smile"', "", "smug.reason", "must be a text"),
        ('source = "a user"', 'source = ""', "smug.source", "must be a text"),
        ("activation = 3.5", "activaton = 3.5", "smug.activaton", "did you mean activation"),
        ('category = "joy"', 'neighbours = ["joy", "fear"]', "smug.neighbours", "with an angle"),
        ('category = "joy"', 'angle = 200\nneighbours = ["fear", "sadness"]', "smug.angle", "shorter arc"),
        ('category = "joy"', 'angle = 0\nneighbours = ["joy"]', "smug.neighbours", "must be two of"),
        ("activation = 3.5", "activation = 3.5\nneutral = 1", "smug.neutral", "true or false"),
        ("activation = 3.5", "activation = 3.5\nevaluation = 8", "smug.evaluation", "from 1 to 7"),
    ],
)
def test_a_wrong_preset_names_file_key_and_rule(tmp_path: Path, old: str, new: str, key: str, rule: str) -> None:
    assert old in GOOD
    path = _write(tmp_path, GOOD.replace(old, new))
    with pytest.raises(FormatError) as caught:
        load_emotions([path])
    assert caught.value.path == path
    assert caught.value.key == key
    assert rule in str(caught.value)
    assert str(path) in str(caught.value)


def test_a_typing_error_names_its_line(tmp_path: Path) -> None:
    path = _write(tmp_path, GOOD.replace("3.5", "3.5.5"))
    with pytest.raises(FormatError, match=r"mine\.toml, line 3: is not valid TOML"):
        load_emotions([path])


def test_what_is_no_table_no_text_or_no_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(FormatError, match="key smug: must be a table"):
        load_emotions([_write(tmp_path, "smug = 3\n")])
    (tmp_path / "mine.toml").write_bytes(b"[smug]\nreason = '\xff'\n")
    with pytest.raises(FormatError, match="UTF-8"):
        load_emotions([tmp_path / "mine.toml"])
    with pytest.raises(FormatError, match="does not exist"):
        load_emotions([tmp_path / "none.toml"])


def test_a_damaged_preset_waits_until_words_are_asked_for(tmp_path: Path) -> None:
    path = _write(tmp_path, "[smug\n")
    words = LazyWords(lambda: load_emotions([path]))
    with pytest.raises(FormatError, match=r"mine\.toml"):
        len(words)
