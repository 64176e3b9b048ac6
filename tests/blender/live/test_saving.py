"""Saving while a preview shows: nothing of it goes into the file, and it comes back, also where saving failed."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import bpy
import pytest
from risorius.operators.preview import events, live
from risorius.scene.live import preview

pytestmark = pytest.mark.smoke


@pytest.fixture
def listening(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """The preview as in a window, where it hears of what Blender does; its timer is `answer`."""
    monkeypatch.setattr(live, "is_on", lambda: True)
    handlers = events.handlers()
    for event, action in handlers:
        event.append(action)
    yield
    for event, action in handlers:
        event.remove(action)
    live.end()


def answer() -> None:
    """What the timer does until the face shows a sketch."""
    for _ in range(200):
        if live._answer() is None or preview.is_shown(bpy.context.object):
            return


def test_a_preview_comes_back_after_saving_and_is_not_in_the_file(head: Any, listening: None, tmp_path: Path) -> None:
    live.ask(head)
    answer()
    assert preview.is_shown(head)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "saved.blend"), copy=True)
    assert not preview.has_preview(head)
    answer()
    assert preview.is_shown(head)
    with bpy.data.libraries.load(str(tmp_path / "saved.blend")) as (there, _):
        assert not any(name.startswith(preview.NAME) for name in there.node_groups)


def test_a_preview_comes_back_after_saving_has_failed(head: Any, listening: None, tmp_path: Path) -> None:
    live.ask(head)
    answer()
    assert preview.is_shown(head)
    with pytest.raises(RuntimeError, match="Cannot open file"):
        bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "no such folder" / "saved.blend"), copy=True)
    assert not preview.has_preview(head)
    answer()
    assert preview.is_shown(head)
