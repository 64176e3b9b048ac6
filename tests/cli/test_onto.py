"""Options of bakes onto a rig that do not go together, or mean nothing, are refused before Blender is looked for."""

from __future__ import annotations

import pytest
from risorius.cli import main

BAKE = ["bake", "joy", "--out", "o.blend"]
ONTO = [*BAKE, "--mesh", "face.blend", "--onto", "keys"]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ([*BAKE, "--onto", "keys"], "--onto keys needs --mesh"),
        ([*BAKE, "--mesh", "face.blend", "--symmetric"], "--symmetric needs --onto"),
        ([*BAKE, "--mesh", "face.blend", "--into-action"], "--into-action needs --onto"),
        ([*BAKE, "--mesh", "face.blend", "--dynamic", "--smooth", "2"], "--smooth needs --onto"),
        ([*ONTO, "--smooth", "2"], "--smooth needs --dynamic"),
        ([*ONTO, "--creases"], "--creases needs --onto new"),
        ([*BAKE, "--onto", "hands"], "--onto"),
        ([*BAKE, "--max-keys", "8"], "--max-keys needs --dynamic"),
        ([*BAKE, "--dynamic", "--max-keys", "0"], "--max-keys must be 1 or more"),
        ([*ONTO, "--dynamic", "--max-keys", "8"], "--max-keys needs --onto new"),
    ],
)
def test_what_does_not_go_together_exits_with_2(
    arguments: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(arguments) == 2
    assert said in capsys.readouterr().err


def test_an_unknown_timing_names_those_there_are(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*ONTO, "--timing", "leisurely"]) == 1
    assert "natural, posed, spontaneous" in capsys.readouterr().err
