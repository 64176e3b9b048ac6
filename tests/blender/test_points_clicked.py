"""Clicking in a window, as far as it can be tried without one: who listens, and when."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from risorius.operators.points import click

pytestmark = pytest.mark.smoke


def test_an_operator_that_clicks_and_then_works_listens_once(head: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """Twice, and Blender calls it again after it has ended and is gone."""
    listeners: list[Any] = []
    manager = SimpleNamespace(
        event_timer_add=lambda *_, **__: "timer",
        progress_begin=lambda *_: None,
        modal_handler_add=listeners.append,
    )
    context = SimpleNamespace(window_manager=manager, window=None, workspace=None, object=head, scene=None)
    operator = SimpleNamespace(work=lambda _: iter(()), title="Working")
    click.RISORIUS_OT_click_points.start(operator, context)
    assert operator._timer == "timer"
    assert listeners == []
