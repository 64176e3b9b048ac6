"""Muscles set by hand and tissues chosen in the panel: kept with the face, in every bake, and given back."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
import pytest
import risorius.api as api
from risorius.errors import ParameterError
from risorius.face.contractible import contractibles
from risorius.operators.emotion.profile import wanted_of
from risorius.operators.muscles.props import by_hand_of, list_muscles, set_by_hand
from risorius.operators.tissue.props import FIGURES, OWN, tissue_of
from risorius.physics.tissue import Tissue, tissue, tissues


def test_the_list_holds_all_that_a_pose_contracts() -> None:
    assert set(contractibles()) == set(api.default_face().pose(np.full(68, np.nan)).contractions)
    assert all(contractibles()[entry.mirror].mirror == name for name, entry in contractibles().items())


def test_a_slider_sets_a_muscle_and_its_twin_by_hand_until_reset(head: Any) -> None:
    list_muscles()
    names = bpy.context.window_manager.risorius.muscles.names
    names["corrugator_l"].contraction = 0.75
    assert by_hand_of(head) == pytest.approx({"corrugator_l": 0.75, "corrugator_r": 0.75})
    head.risorius.emotion.word = "sadness"
    assert wanted_of(head).contractions == pytest.approx({"corrugator_l": 0.75, "corrugator_r": 0.75})
    assert names["corrugator_r"].contraction == pytest.approx(0.75)
    head.risorius.muscles.linked = False
    assert bpy.ops.risorius.reset_muscles(muscle="corrugator_l") == {"FINISHED"}
    assert list(by_hand_of(head)) == ["corrugator_r"]
    assert bpy.ops.risorius.reset_muscles() == {"FINISHED"}
    assert not by_hand_of(head)
    assert not bpy.ops.risorius.reset_muscles.poll()


def test_no_muscle_of_that_name(head: Any) -> None:
    with pytest.raises(ParameterError, match="zygomaticus_major_l"):
        set_by_hand(head, "biceps", 1.0)


@pytest.mark.slow
def test_what_is_set_by_hand_is_baked(head: Any) -> None:
    set_by_hand(head, "frontalis_med_l", 1.0)
    assert bpy.ops.risorius.bake_expression() == {"FINISHED"}
    keys = head.data.shape_keys.key_blocks
    count = len(head.data.vertices)
    baked, rest = (np.empty(3 * count, dtype=np.float32) for _ in range(2))
    keys["joy"].data.foreach_get("co", baked)
    keys[0].data.foreach_get("co", rest)
    wanted = wanted_of(head)
    posed = api.default_face().pose(wanted.faps, emotion=wanted.profile.weights, contractions=dict(wanted.contractions))
    moved = (baked - rest).reshape(-1, 3)
    np.testing.assert_allclose(moved, posed.positions - api.default_face().vertices, atol=2e-6)


def test_tissues_bring_their_figures_and_edited_ones_are_ones_own(head: Any) -> None:
    chosen = head.risorius.tissue
    for name, figures in tissues().items():
        chosen.kind = name
        assert tissue_of(head) == name
        assert all(getattr(chosen, figure) == pytest.approx(getattr(figures, figure)) for figure in FIGURES)
    chosen.kind = "aged"
    chosen.threshold = 0.3
    assert chosen.kind == OWN
    own = tissue_of(head)
    assert isinstance(own, Tissue)
    assert own.threshold == pytest.approx(0.3)
    assert own.stiffening == pytest.approx(tissue("aged").stiffening)


def test_the_tissues_of_the_panel_are_those_of_the_table(head: Any) -> None:
    items = head.risorius.tissue.bl_rna.properties["kind"].enum_items
    assert [item.identifier for item in items] == [*tissues(), OWN]


def test_a_tissue_preset_is_saved_and_read_as_any_of_blenders(head: Any, tmp_path: Any, monkeypatch: Any) -> None:
    monkeypatch.setattr(bpy.utils, "user_resource", lambda kind, path="", create=False: str(tmp_path / path))
    head.risorius.tissue.threshold = 0.25
    (tmp_path / "presets" / "risorius" / "tissue").mkdir(parents=True)
    assert bpy.ops.risorius.add_tissue_preset(name="Mine") == {"FINISHED"}
    (written,) = (tmp_path / "presets" / "risorius" / "tissue").glob("*.py")
    head.risorius.tissue.kind = "young"
    exec(compile(written.read_text(), str(written), "exec"), {"bpy": bpy})
    assert head.risorius.tissue.kind == OWN
    assert head.risorius.tissue.threshold == pytest.approx(0.25)
