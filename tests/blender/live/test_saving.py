"""Saving while a preview shows: nothing of it goes into the file, and it comes back, also where saving failed."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import bpy
import numpy as np
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


@pytest.fixture
def laid_out(head: Any, listening: None) -> Any:
    """The head, as a clip that is not baked shows it at its apex; something else is chosen in the panel meanwhile."""
    head.risorius.emotion.word = "joy"
    bpy.ops.risorius.add_clip()
    head.risorius.timeline.linked = False
    head.risorius.emotion.word = "fear"
    live.session().previews.due.clear()
    live.ask_to_play(head)
    bpy.context.scene.frame_set(20)
    until_shown(head)
    bpy.context.scene.frame_set(20)  # a sketch showed, and its motion is worked out by now
    return head


def until_shown(head: Any) -> None:
    """What the timer does until all is shown that is asked for."""
    while live._answer() is not None:
        pass
    assert preview.is_shown(head)


def shown(head: Any) -> np.ndarray:
    """(3 V,) what the preview shows."""
    places = np.empty(3 * len(head.data.vertices))
    head.data.attributes[preview.ATTRIBUTE].data.foreach_get("vector", places)
    return places


@pytest.mark.slow
@pytest.mark.parametrize("how", ["saved", "refused", "cut short"])
def test_what_is_laid_out_shows_again_and_not_what_is_chosen(laid_out: Any, tmp_path: Path, how: str) -> None:
    before = shown(laid_out)
    path = tmp_path / "saved.blend"
    if how == "saved":
        bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)
    elif how == "refused":
        with pytest.raises(RuntimeError, match="Cannot open file"):
            bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "no such folder" / "saved.blend"), copy=True)
    else:
        path.write_bytes(b"what was there")
        with no_room_left(), pytest.raises(RuntimeError, match=r"(?i)no space|too large|cannot write|error"):
            bpy.ops.wm.save_as_mainfile(filepath=str(path))
        assert path.read_bytes() == b"what was there"
    assert not preview.has_preview(laid_out)
    until_shown(laid_out)
    np.testing.assert_array_equal(shown(laid_out), before)
    assert len(laid_out.risorius.timeline.clips) == 1
    assert laid_out.data.shape_keys is None


@contextmanager
def no_room_left() -> Iterator[None]:
    """No file grows beyond a few kilobytes, as on a disk that is full."""
    resource = pytest.importorskip("resource")
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    ignored = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (8192, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
        signal.signal(signal.SIGXFSZ, ignored)
