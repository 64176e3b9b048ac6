"""Each recipe of docs/extending.md is followed as it stands, in a copy of the checkout, and works."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from recipes import changes, copy_checkout, follow, recipes

RECIPES = recipes()

#: Followed inside Blender (tests/blender/panel/test_extending.py).
IN_BLENDER = {"An operator with its panel"}

#: Recipes that go on from others.
AFTER = {"A kind of muscle": ("A muscle",)}


def test_there_are_recipes_for_whatever_is_added_most() -> None:
    wanted = {"An emotion word", "A muscle", "A kind of muscle", "A mechanism", "A tracker's format"}
    assert set(RECIPES) == wanted | IN_BLENDER


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(set(RECIPES) - IN_BLENDER))
def test_a_recipe_works_word_for_word(name: str, tmp_path: Path) -> None:
    tree = copy_checkout(tmp_path)
    for earlier in AFTER.get(name, ()):
        follow(changes(RECIPES[earlier]), tree)
    assert "run" in {step.kind for step in RECIPES[name]}
    follow(RECIPES[name], tree)


@pytest.mark.slow
def test_what_the_recipes_make_keeps_the_rules_of_style_and_layers(tmp_path: Path) -> None:
    tree = copy_checkout(tmp_path)
    for steps in RECIPES.values():
        follow(changes(steps), tree)
    touched = [step for steps in RECIPES.values() for step in steps if step.path.endswith(".py")]
    changed = " ".join({step.path: None for step in touched})
    new = " ".join(step.path for step in touched if step.kind == "file")
    for command in (f"ruff check {changed}", f"ruff format --diff {new}", "lint-imports --no-cache"):
        program, *arguments = command.split()
        path = Path(sys.executable).with_name(program)
        variables = {**os.environ, "PYTHONPATH": str(tmp_path)}
        done = subprocess.run([path, *arguments], cwd=tree, env=variables, capture_output=True, text=True, check=False)
        assert done.returncode == 0, f"{command}\n{done.stdout}{done.stderr}"
