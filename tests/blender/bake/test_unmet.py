"""What is requested and does not show is said: by bakes, by engine shapes and by the panel."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import bpy
import numpy as np
import pytest
import risorius.api as api
from risorius.operators.preview import live
from risorius.operators.session import begin_session
from risorius.progress import run
from risorius.scene import bake
from risorius.scene import mesh as meshes
from risorius.scene.bake.action import Curve
from risorius.scene.bake.motion import FapMotion
from risorius.scene.bake.strips import ClipShape, bake_strips
from risorius.scene.blendshape_keys import write_blendshapes

SAID = "F44 raise_tongue_tip requested, but nothing shows: the face has no tongue"


@pytest.fixture
def tongueless(head: Any) -> Any:
    """The default head, its tongue a thing without a part of its own."""
    parts = meshes.read_parts(head.data)
    assert parts is not None
    meshes.write_parts(head.data, np.where(parts == api.Part.TONGUE, int(api.Part.OTHER), parts))
    return head


@pytest.fixture
def faps() -> np.ndarray:
    """(68,) an opened jaw and a raised tongue."""
    asked = np.full(68, np.nan)
    asked[[2, 43]] = 200.0, 300.0
    return asked


@pytest.mark.slow
def test_bakes_say_what_does_not_show(tongueless: Any, faps: np.ndarray) -> None:
    target = bake.Target(tongueless)
    timing = bake.ClipTiming(onset=0.2, apex=0.2, offset=0.2, start=1.0, fps=25.0)
    posed = run(bake.bake_expression(target, faps, clip="la", timing=timing, drive="exact"))
    assert f"la: {SAID}" in posed.remarks
    stream = np.linspace(0.0, 1.0, 4)[:, None] * faps
    moved = run(bake.bake_motion(target, FapMotion(stream), clip="moving", drive="exact"))
    assert f"moving: {SAID}" in moved.remarks
    curve = Curve(np.array([1.0, 5.0]), np.array([0.0, 1.0]))
    strips = run(bake_strips(target, [ClipShape("strip", faps, curve)], drive="exact"))
    assert f"strip: {SAID}" in strips.remarks
    silent = faps.copy()
    silent[43] = np.nan
    whole = run(bake.bake_expression(target, silent, clip="ah", timing=timing, drive="exact"))
    assert not [remark for remark in whole.remarks if "nothing shows" in remark]


@pytest.mark.slow
def test_engine_shapes_say_what_does_not_show(tongueless: Any, tmp_path: Path) -> None:
    table = tmp_path / "few.toml"
    table.write_text("[keys.open]\nfaps = { 3 = 200 }\n[keys.la]\nfaps = { 3 = 200, 44 = 300 }\n")
    written = run(write_blendshapes(bake.Target(tongueless), table))
    assert written.keys == ("open", "la")
    assert written.remarks == (f"la: {SAID}",)


@pytest.mark.slow
def test_the_panel_says_what_does_not_show(tongueless: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    begin_session()
    monkeypatch.setattr(live, "is_on", lambda: True)
    wanted = live.wanted_of(tongueless)
    faps = np.full(68, np.nan)
    faps[43] = 300.0
    changed = SimpleNamespace(faps=faps, drive="exact", profile=wanted.profile, contractions={})
    monkeypatch.setattr(live, "wanted_of", lambda obj: changed)
    face = live.LiveFace(bake.Target(tongueless))
    live.show(tongueless, face, exact=True)
    assert live.why_not(tongueless) == SAID
    live.rest(tongueless)
    bpy.context.view_layer.update()
