"""The built extension in a real Blender window: installed, seen, used, unregistered."""

from __future__ import annotations

import json
import shutil
import struct
import time
import zlib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from places import ROOT
from window.driver import call

PICTURE = ROOT / "out" / "test-reports" / "window.png"
PATIENCE = 200.0  # s for the script in the window to get done


@pytest.fixture(scope="session")
def seen(blender: Path, settings: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[dict[str, Any]]:
    """What the script in the window found, after a picture was taken; the window is closed at the end."""
    folder = tmp_path_factory.mktemp("window")
    report = folder / "report.json"
    script = str(ROOT / "tests" / "gui" / "in_window.py")
    started = call(blender, "start", "--python", script, "--", str(report), settings=settings)
    try:
        assert started.returncode == 0, started.stdout + started.stderr
        found = wait_for(report, lambda said: "shown" in said or "error" in said, blender, settings)
        shot = call(blender, "shot", str(folder / "shot.png"), settings=settings)
        assert shot.returncode == 0, shot.stderr
        PICTURE.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(folder / "shot.png", PICTURE)
        if "error" not in found:
            shutil.copyfile(folder / "shot.png", report.with_suffix(".png"))
            found = wait_for(report, lambda said: "after" in said or "error" in said, blender, settings)
        log = call(blender, "log", settings=settings).stdout
        yield {**found, "picture": folder / "shot.png", "log": log}
    finally:
        call(blender, "stop", settings=settings)


def wait_for(
    report: Path, done: Callable[[dict[str, Any]], bool], blender: Path, settings: Path
) -> dict[str, Any]:  # fmt: skip
    """The report of the script in the window, as soon as it says what is asked."""
    until = time.monotonic() + PATIENCE
    while time.monotonic() < until:
        if report.exists():
            said: dict[str, Any] = json.loads(report.read_text())
            if done(said):
                return said
        time.sleep(0.5)
    log = call(blender, "log", settings=settings).stdout
    pytest.fail(f"the script in the window did not get there within {PATIENCE:g} s; Blender said:\n{log[-3000:]}")


def colours(picture: Path) -> set[bytes]:
    """The distinct pixel values of an 8-bit RGB PNG without filters (as the tool writes it)."""
    data = picture.read_bytes()
    width, height = struct.unpack(">II", data[16:24])
    body, at = b"", 8
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at : at + 8])
        body += data[at + 8 : at + 8 + length] if kind == b"IDAT" else b""
        at += length + 12
    raw = zlib.decompress(body)
    rows = (raw[y * (3 * width + 1) + 1 : (y + 1) * (3 * width + 1)] for y in range(height))
    return {row[x : x + 3] for row in rows for x in range(0, 3 * width, 3)}


def test_blender_takes_the_command_line(blender: Path, settings: Path, tmp_path: Path) -> None:
    command = ("--command", "risorius")
    said = call(blender, "background", *command, "profile", "joy", "--json", settings=settings)
    assert said.returncode == 0, said.stdout + said.stderr
    assert json.loads(said.stdout[said.stdout.index("{") : said.stdout.rindex("}") + 1])["word"] == "joy"
    assert call(blender, "background", *command, "profile", "joyous-ish", settings=settings).returncode == 1
    assert call(blender, "background", *command, "dance", settings=settings).returncode == 2
    blend = tmp_path / "joy.blend"
    baked = call(blender, "background", *command, "bake", "joy", "--out", str(blend), settings=settings)
    assert baked.returncode == 0, baked.stdout + baked.stderr
    assert blend.stat().st_size > 0


def test_nothing_went_wrong_in_the_window(seen: dict[str, Any]) -> None:
    assert "error" not in seen, seen.get("error")
    assert seen["registered"]


def test_head_is_added_and_baked_while_the_window_lives(seen: dict[str, Any]) -> None:
    assert seen["add_head"] == ["FINISHED"]
    assert seen["bake_begun"] == ["RUNNING_MODAL"]
    assert seen["baked"]
    assert max(seen["values"][1:]) > 0.9, "the apex is not shown"


def test_tab_is_open_and_the_picture_is_not_blank(seen: dict[str, Any]) -> None:
    assert seen["shown"] == "Risorius"
    assert len(colours(seen["picture"])) > 1000


def test_points_and_parts_are_drawn_without_a_complaint(seen: dict[str, Any]) -> None:
    assert seen["find_points"] == seen["use_drag_tool"] == ["FINISHED"]
    assert seen["tool"] == "risorius.drag_points"
    assert seen["listed"] == 84
    assert "Traceback" not in seen["log"], seen["log"]


def test_unregister_leaves_nothing_registered(seen: dict[str, Any]) -> None:
    assert seen["after"] == []
