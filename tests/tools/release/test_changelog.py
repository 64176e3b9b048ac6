"""The changelog keeps its form: versions from new to old with their dates, changes by kind."""

from __future__ import annotations

import itertools
import re
from datetime import date

from places import ROOT
from release.sources import VERSION

KINDS = ("Added", "Changed", "Deprecated", "Removed", "Fixed", "Security")
LINES = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8").splitlines()


def versions() -> list[tuple[tuple[int, ...], date]]:
    """Number and date of each version, as they follow each other."""
    headings = [line for line in LINES if line.startswith("## ")]
    assert headings[0] == "## [Unreleased]"
    found = [re.fullmatch(r"## \[(\d+\.\d+\.\d+)\] - (\d{4}-\d{2}-\d{2})", line) for line in headings[1:]]
    assert all(found), headings
    return [(tuple(map(int, each[1].split("."))), date.fromisoformat(each[2])) for each in found if each]


def test_the_manifests_version_comes_first_with_its_date() -> None:
    assert ".".join(map(str, versions()[0][0])) == VERSION


def test_what_names_the_version_names_this_one() -> None:
    """The readme's files, and the citation with the changelog's date."""
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    assert set(re.findall(r"risorius-(\d+\.\d+\.\d+)", readme)) == {VERSION}
    citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert f"\nversion: {VERSION}\n" in citation
    assert f"\ndate-released: {versions()[0][1]}\n" in citation


def test_versions_go_from_new_to_old() -> None:
    for (newer, later), (older, earlier) in itertools.pairwise(versions()):
        assert newer > older
        assert later >= earlier


def test_changes_stand_under_their_kind() -> None:
    kind = ""
    for number, line in enumerate(LINES, 1):
        if line.startswith("#"):
            kind = line.removeprefix("### ") if line.startswith("### ") else ""
            assert not line.startswith("### ") or kind in KINDS, (number, line)
        elif line.startswith("- "):
            assert kind, f"line {number} stands under no kind of change"


def test_what_is_listed_under_unreleased_has_no_empty_kinds() -> None:
    headings = [line for line in LINES if line.startswith(("#", "- "))]
    for one, following in itertools.pairwise(headings):
        assert not (one.startswith("### ") and following.startswith("#")), f"{one} is empty"
