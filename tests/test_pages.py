"""The pages for readers: every link from one to another, to a heading or to a picture leads somewhere."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import pytest
from places import ROOT

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
