"""The recipe of docs/extending.md for an operator with its panel is followed in a copy of the checkout, and works."""

from __future__ import annotations

from pathlib import Path

import pytest
from recipes import copy_checkout, follow, recipes


@pytest.mark.slow
def test_the_recipe_of_an_operator_works_word_for_word(tmp_path: Path) -> None:
    steps = recipes()["An operator with its panel"]
    assert [step.kind for step in steps].count("run") == 1
    follow(steps, copy_checkout(tmp_path))
