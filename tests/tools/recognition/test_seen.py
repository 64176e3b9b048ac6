"""What the page says of pictures: counted from what was seen; photographs are fetched, never kept."""

from __future__ import annotations

import subprocess
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from recognition import photographs
from recognition.seen_page import seen_section


def seen(kind: str, name: str, shows: str, neutral: str, paper: str, robust: str) -> dict[str, Any]:
    """One picture."""
    beliefs = {robust: 0.8, "fear": 0.1, "neutral": 0.05}
    return {
        "kind": kind, "name": name, "shows": shows, "neutral": neutral, "paper": paper, "robust": robust,
        "beliefs": beliefs,
    }  # fmt: skip


def cells(lines: list[str], first: str) -> list[str]:
    """The cells of the row that begins so."""
    row = next(line for line in lines if line.startswith(f"| {first} |"))
    return [cell.strip() for cell in row.strip("|").split("|")][1:]


def test_verdicts_are_counted_by_head_neutral_face_and_rule() -> None:
    found = [
        seen("render", "ict, 0-default", "joy", "own", "sadness", "joy"),
        seen("render", "ict, 0-default", "neutral", "own", "sadness", "neutral"),
        seen("render", "ict, 0-default", "joy", "guessed", "joy", "joy"),
        seen("render", "other, 0-rim", "joy", "guessed", "sadness", "anger"),
        seen("photograph", "her", "joy", "guessed", "sadness", "joy"),
        seen("photograph", "him", "anger", "guessed", "disgust", "disgust"),
        seen("film", "ict-20", "joy", "own", "sadness, joy", "joy, neutral"),
    ]
    lines = "\n".join(seen_section(found)).splitlines()
    assert cells(lines, "ict") == ["1", "0 %", "100 %", "100 %", "100 %"]  # the paper's rule knows no neutral face
    assert cells(lines, "**all**") == ["2", "0 %", "100 %", "50 %", "50 %"]
    assert cells(lines, "her") == ["joy", "sadness", "**joy**", "joy 0.80, fear 0.10, neutral 0.05"]
    assert cells(lines, "**right**")[1:3] == ["0 of 2", "1 of 2"]
    assert any("lips pressed" in line for line in lines)
    assert cells(lines, "ict, 20°")[:2] == ["paper", "sadness, joy"]
    shown = [line for line in lines if line.startswith("| joy |")]
    assert shown[1] == "| joy | 1 | 0 | 0 | 0 | 0 | 0 | 0 |"  # own, robust


def test_without_pictures_the_page_says_nothing_of_them() -> None:
    assert seen_section([]) == []


def test_photographs_that_cannot_be_had_are_left_out(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    asked: list[list[str]] = []
    monkeypatch.setattr(subprocess, "run", lambda command, **_: asked.append(command) or SimpleNamespace(returncode=1))
    monkeypatch.setattr(photographs, "_astronaut", lambda _folder: [])
    monkeypatch.setattr(photographs, "_several", lambda _folder: [])
    assert photographs.gather_photographs(tmp_path) == []
    assert photographs.PACKAGE in asked[0]
    assert "left out" in capsys.readouterr().out


def test_no_photograph_is_kept_in_the_project() -> None:
    root = Path(__file__).parents[3]
    names = {*photographs.PHOTOGRAPHS, photographs.SEVERAL, "astronaut.png"}
    tracked = subprocess.run(["git", "ls-files"], cwd=root, capture_output=True, text=True, check=False).stdout
    assert not names & {Path(line).name for line in tracked.splitlines()}
