"""The script on the page for scripts bakes onto a character's own keys, and takes the clip off again."""

from __future__ import annotations

import re
from typing import Any

import bpy
import pytest
from places import ROOT
from risorius.scene.rig.clips import rig_clips


@pytest.mark.slow
def test_the_script_of_the_page_bakes_and_takes_off(drawn_head: Any, capsys: pytest.CaptureFixture[str]) -> None:
    bpy.context.view_layer.objects.active = drawn_head
    page = (ROOT / "docs" / "scripting.md").read_text(encoding="utf-8")
    blocks = re.findall(r"^```python\n(.*?)^```", page, flags=re.M | re.S)
    (script,) = (block for block in blocks if "bake_expression_onto" in block)
    script = script.replace("bl_ext.user_default.risorius", "risorius")
    bake, _, after = script.partition("remove_rig_clips(head")
    names: dict[str, Any] = {}
    exec(compile(bake, "docs/scripting.md", "exec"), names)
    assert list(rig_clips(drawn_head)) == ["joy"]
    assert names["result"].peaks["smile_L"] > 0.2
    assert "% of the motion shows" in capsys.readouterr().out
    exec(compile("remove_rig_clips(head" + after, "docs/scripting.md", "exec"), names)
    assert rig_clips(drawn_head) == {}
