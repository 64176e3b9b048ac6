"""The pages for readers: links lead somewhere, files that are named are there, command lines are understood."""

from __future__ import annotations

import re
import shlex
from functools import cache
from pathlib import Path

import pytest
from places import ROOT
from risorius import cli

PAGES = sorted([*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")])


def prose(page: Path) -> str:
    """A page without its blocks of code."""
    return re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.M | re.S)


def targets(text: str) -> list[str]:
    """What the links of a page lead to, within the repository."""
    found = re.findall(r"\]\(([^()\s]+(?:\([^()]*\))?)\)", text)
    return [target for target in found if not re.match(r"[a-z]+:", target)]


@cache
def anchors(page: Path) -> frozenset[str]:
    """The headings of a page, as links name them."""
    headings = re.findall(r"^#+ +(.+?) *$", prose(page), flags=re.M)
    plain = (re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).lower() for heading in headings)
    return frozenset(re.sub(r"[^\w\- ]", "", heading).replace(" ", "-") for heading in plain)


def broken(page: Path) -> list[str]:
    """Links of a page that lead nowhere."""
    wrong = []
    for target in targets(prose(page)):
        name, _, anchor = target.partition("#")
        file = (page.parent / name).resolve() if name else page
        if not file.exists() or (anchor and anchor not in anchors(file)):
            wrong.append(target)
    return wrong


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_every_link_leads_somewhere(page: Path) -> None:
    assert broken(page) == []


def test_every_page_of_the_manual_is_linked_from_the_readme() -> None:
    """Or from a page that is."""
    seen, waiting = set(), [ROOT / "README.md"]
    while waiting:
        page = waiting.pop()
        seen.add(page)
        files = ((page.parent / target.partition("#")[0]).resolve() for target in targets(prose(page)))
        waiting += [file for file in files if file.suffix == ".md" and file.exists() and file not in seen]
    assert [page.name for page in PAGES if page not in seen | {ROOT / "CHANGELOG.md"}] == []


def command_lines(text: str) -> list[list[str]]:
    """What follows `risorius` in the lines of a page's shell blocks."""
    blocks = re.findall(r"^```sh\n(.*?)^```", text, flags=re.M | re.S)
    lines = (line.strip().partition("||")[0] for block in blocks for line in block.splitlines())
    begun = (re.match(r"(?:python -m |blender --command )?risorius (.+)", line) for line in lines)
    return [shlex.split(found[1], comments=True) for found in begun if found]


def understood(arguments: list[str]) -> bool:
    """Whether the command line takes these arguments; nothing is run."""
    try:
        cli._parser().parse_args(cli.with_action(arguments))
    except SystemExit:
        return False
    return True


def test_every_command_line_of_a_page_is_understood() -> None:
    lines = [line for page in PAGES for line in command_lines(page.read_text(encoding="utf-8"))]
    assert len(lines) > 20
    assert [" ".join(line) for line in lines if not understood(line)] == []
    assert not understood(["profile", "joy", "--loud"])
    block = "```sh\n  risorius bake joy --out 'a b' || exit  # so\n```\n"
    assert command_lines(block) == [["bake", "joy", "--out", "a b"]]


def missing(text: str) -> list[str]:
    """What a page names in code letters as a file, a folder or a command of make, and is not there."""
    targets = set(re.findall(r"^([a-z-]+):", (ROOT / "Makefile").read_text(encoding="utf-8"), flags=re.M))
    rooms = {path.name for path in ROOT.iterdir() if path.is_dir() and not path.name.startswith(".")}
    made_new = re.findall(r"^New file `(.+)`:$", text, flags=re.M)
    named = [name for name in re.findall(r"`([^`\s]+)`", text) if name not in made_new]
    paths = [name for name in named if "/" in name and name.partition("/")[0] in rooms - {"out", "dist"}]
    there = {name for name in paths if any(ROOT.glob(name)) or (ROOT / f"{name}.py").exists()}
    made = [f"make {target}" for target in re.findall(r"`make ([a-z-]+)", text) if target not in targets]
    return [*(name for name in paths if name not in there), *made]


@pytest.mark.parametrize("page", [page for page in PAGES if page.name != "CHANGELOG.md"], ids=lambda page: page.name)
def test_what_a_page_names_is_there(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    assert missing(text) == []
    wrong = f"{text} `tools/nothing.py` `face/motion` `presets/emotions/*.toml` `presets/*.doc` `make haste`"
    assert missing(wrong) == ["tools/nothing.py", "presets/*.doc", "make haste"]


def test_a_broken_link_is_found(tmp_path: Path) -> None:
    (tmp_path / "b.md").write_text("# One: two\n\n## `x` and [y](z)\n", encoding="utf-8")
    page = tmp_path / "a.md"
    page.write_text(
        "[a](b.md) [b](b.md#one-two) [c](b.md#x-and-y) [d](#here) [e](https://x.y)\n\n# Here\n\n```\n[f](g)\n```\n",
        encoding="utf-8",
    )
    assert broken(page) == []
    page.write_text("[a](c.md) [b](b.md#two) [c](#there)", encoding="utf-8")
    assert broken(page) == ["c.md", "b.md#two", "#there"]
