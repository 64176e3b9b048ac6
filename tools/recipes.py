"""The recipes of docs/extending.md, followed in a copy of the checkout: what the page says is what is done.

A recipe is a section of the page. A line that ends in a colon says what the block below it is for:

    New file `path`:               the file
    At the end of `path`:          what is added to the file
    In `path`:                     a diff: lines with + and - between lines that stay; @@ parts places of the file
    Then run:                      commands, one a line
    It prints:                     lines that the commands before have printed, in this order
"""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from places import DOCS, shared_folder
from release.sources import copy_sources

PAGE = DOCS / "extending.md"

#: Seconds for one command. On a quiet machine the slowest takes a tenth of it.
TIME_LIMIT = 120.0

_BLOCK = re.compile(r"^(?P<lead>[^\n]*)\n+```\w+\n(?P<text>.*?)^```$", re.M | re.S)
_LEADS = {
    re.compile(r"New file `(.+)`:"): "file",
    re.compile(r"At the end of `(.+)`:"): "end",
    re.compile(r"In `(.+)`:"): "diff",
    re.compile(r"(?:.* )?run:"): "run",
    re.compile(r"(?:.* )?prints:"): "print",
}


class RecipeError(Exception):
    """A recipe that cannot be followed, and where."""


@dataclass(frozen=True)
class Step:
    """One block of a recipe: what it is for ("file", "end", "diff", "run" or "print"), its file and its text."""

    kind: str
    path: str
    text: str


def recipes(page: Path = PAGE) -> Mapping[str, list[Step]]:
    """Heading -> the steps of its section, of every section that has any.

    Raises
    ------
    RecipeError : a block below a line that does not say what it is for.
    """
    found = {}
    for section in re.split(r"^## ", page.read_text(encoding="utf-8"), flags=re.M)[1:]:
        heading, _, body = section.partition("\n")
        if steps := list(_steps(body)):
            found[heading.strip()] = steps
    return found


def _steps(body: str) -> Iterator[Step]:
    """The blocks of a section."""
    for block in _BLOCK.finditer(body):
        for pattern, kind in _LEADS.items():
            if match := pattern.fullmatch(block["lead"]):
                yield Step(kind, match[1] if match.groups() else "", block["text"])
                break
        else:
            raise RecipeError(f"{block['lead']!r} does not say what the block below it is for")


def changes(steps: list[Step]) -> list[Step]:
    """What a recipe changes in files, without its commands."""
    return [step for step in steps if step.path]


def copy_checkout(folder: Path) -> Path:
    """A copy of the project in `folder`, called as the package is."""
    copy_sources(folder / "risorius")
    return folder / "risorius"


def follow(steps: list[Step], tree: Path) -> None:
    """Do all that a recipe says, in a copy of the checkout. Commands are run by the Python that runs this.

    Raises
    ------
    RecipeError : lines that a file does not have (or not once); a command that fails or prints something else.
    """
    printed = ""
    for step in steps:
        path = tree / step.path
        if step.kind == "file":
            if path.exists():
                raise RecipeError(f"{step.path} exists already")
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(step.text, encoding="utf-8")
        elif step.kind == "end":
            path.write_text(f"{path.read_text(encoding='utf-8').rstrip()}\n\n{step.text}", encoding="utf-8")
        elif step.kind == "diff":
            path.write_text(changed(path.read_text(encoding="utf-8"), step), encoding="utf-8")
        elif step.kind == "run":
            printed = "".join(_run(line, tree) for line in step.text.splitlines())
        else:
            _expect(step.text, printed)


def changed(text: str, step: Step) -> str:
    """A file's text after a diff."""
    for part in re.split(r"^@@.*\n", step.text, flags=re.M):
        if wrong := [line for line in part.splitlines() if line and line[0] not in " +-"]:
            raise RecipeError(f"{step.path}: {wrong[0]!r} begins with neither a space nor + nor -")
        before, after = ("".join(f"{line[1:]}\n" for line in part.splitlines() if line[:1] != sign) for sign in "+-")
        if (count := f"\n{text}".count(f"\n{before}")) != 1:
            raise RecipeError(f"{step.path} has these lines {count} times, not once:\n{before}")
        text = f"\n{text}".replace(f"\n{before}", f"\n{after}")[1:]
    return text


def _run(line: str, tree: Path) -> str:
    """What one command prints. What does not end is stopped."""
    program, *arguments = shlex.split(line)
    if not re.fullmatch(r"\.venv(-[\w.-]+)?/bin/python", program):
        raise RecipeError(f"{line}: begins with none of the checkout's Pythons")
    variables = {"PYTHONPATH": str(tree.parent), "RISORIUS_SHARED": str(shared_folder())}
    done = subprocess.run(
        [sys.executable, *arguments],
        cwd=tree,
        env={**os.environ, **variables},
        capture_output=True,
        text=True,
        timeout=TIME_LIMIT,
        check=False,
    )
    if done.returncode:
        raise RecipeError(f"{line} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


def _expect(text: str, printed: str) -> None:
    """Lines are among those that were printed, in their order; ... stands for any."""
    lines = iter(printed.splitlines())
    for line in text.splitlines():
        if line.strip() != "..." and not any(line.rstrip() == there.rstrip() for there in lines):
            raise RecipeError(f"{line!r} was not printed (here) by the command, which printed:\n{printed}")
