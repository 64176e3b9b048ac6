"""The follower of recipes does what a page says and nothing else, and says where a recipe cannot be followed."""

from __future__ import annotations

from pathlib import Path

import pytest
from recipes import RecipeError, Step, changed, follow, recipes

PAGE = """# A page

## A recipe

New file `room/new.py`:

```python
print("one")
print("two")
```

In `old.py`:

```diff
 first = 1
-second = 2
+second = 3
@@
 last = 9
+more = 10
```

At the end of `old.py`:

```python
end = 0
```

Then run:

```sh
.venv/bin/python room/new.py
```

It prints:

```text
one
```

## No recipe

Words alone.
"""


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    """A small checkout."""
    (tmp_path / "old.py").write_text("first = 1\nsecond = 2\nbetween = 5\nlast = 9\n", encoding="utf-8")
    return tmp_path


def read(text: str, folder: Path) -> list[Step]:
    """The steps of the one recipe of a page."""
    (folder / "page.md").write_text(text, encoding="utf-8")
    ((name, steps),) = recipes(folder / "page.md").items()
    assert name == "A recipe"
    return steps


def test_a_recipe_is_followed(tree: Path) -> None:
    steps = read(PAGE, tree)
    assert [step.kind for step in steps] == ["file", "diff", "end", "run", "print"]
    follow(steps, tree)
    assert (tree / "room/new.py").read_text(encoding="utf-8") == 'print("one")\nprint("two")\n'
    wanted = "first = 1\nsecond = 3\nbetween = 5\nlast = 9\nmore = 10\n\nend = 0\n"
    assert (tree / "old.py").read_text(encoding="utf-8") == wanted


@pytest.mark.parametrize(
    ("right", "wrong", "told"),
    [
        ("```text\none", "```text\ntwo\none", "'one' was not printed"),
        ("```text\none", "```text\nthree", "'three' was not printed"),
        ("-second = 2", "-second = 4", "old.py has these lines 0 times, not once"),
        (" last = 9", "last = 9", "old.py: 'last = 9' begins with neither"),
        ('print("two")', "raise SystemExit(3)", "new.py ended with 3"),
        ("room/new.py`", "old.py`", "old.py exists already"),
        (".venv/bin/python room", "python room", "begins with none of the checkout's Pythons"),
        ("Then run:", "This is nice.", "'This is nice.' does not say what the block below it is for"),
        ("Then run:", "Then run\n\nit like this:", "'it like this:' does not say"),
    ],
)
def test_a_recipe_that_cannot_be_followed_is_told(tree: Path, right: str, wrong: str, told: str) -> None:
    assert PAGE.count(right) == 1
    with pytest.raises(RecipeError) as refused:
        follow(read(PAGE.replace(right, wrong), tree), tree)
    assert told in str(refused.value)


def test_lines_that_stand_twice_are_refused() -> None:
    step = Step("diff", "a.py", " one\n+two\n")
    assert changed("one\nthree\n", step) == "one\ntwo\nthree\n"
    with pytest.raises(RecipeError, match=r"a\.py has these lines 2 times"):
        changed("one\nthree\none\n", step)
