"""Clicking in a window, as far as it can be tried without one: who listens, and when."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import bpy
import numpy as np
import pytest
from risorius.operators.points import click, view
from risorius.scene.points import bound as points_bound
from risorius.scene.points import seen as points_seen

pytestmark = pytest.mark.smoke


def test_an_operator_that_clicks_and_then_works_listens_once(head: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """Twice, and Blender calls it again after it has ended and is gone."""
    listeners: list[Any] = []
    removed: list[str] = []
    manager = SimpleNamespace(
        event_timer_add=lambda *_, **__: "timer",
        event_timer_remove=removed.append,
        progress_begin=lambda *_: None,
        progress_end=lambda: None,
        modal_handler_add=listeners.append,
    )
    context = SimpleNamespace(window_manager=manager, window=None, workspace=None, object=head, scene=None)
    operator = SimpleNamespace(work=lambda _: (step for step in ()), title="Working")
    click.RISORIUS_OT_click_points.begin(operator, context)
    operator._held.close()
    assert removed == ["timer"]
    assert listeners == []


def test_a_click_just_beside_the_outline_means_the_outline(head: Any) -> None:
    visible = points_seen.Visible.of(head, bpy.context.evaluated_depsgraph_get())
    surface = points_bound.Surface.of(head.data)
    lowest = surface.vertices[:, 2].min()

    def ray(pixel: tuple[float, float]) -> tuple[np.ndarray, np.ndarray]:
        """A millimetre for each pixel, from the front."""
        return np.array([pixel[0] / 1000.0, -1.0, lowest + pixel[1] / 1000.0]), np.array([0.0, 1.0, 0.0])

    viewport: Any = SimpleNamespace(ray=ray)
    assert visible.hit(*ray((0.0, -5.0)), surface) is None
    place = view.hit_near(visible, viewport, (0.0, -5.0), surface, 14.0)
    assert place is not None
    assert place[2] < lowest + 0.01
    assert view.hit_near(visible, viewport, (0.0, -20.0), surface, 14.0) is None
