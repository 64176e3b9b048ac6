"""Names in other languages: tables that fit the names there are, used by Blender, and refused where broken."""

from __future__ import annotations

from pathlib import Path

import bpy
import pytest
from risorius.errors import FormatError
from risorius.operators import translations
from risorius.operators.classes import CLASSES


def names() -> set[tuple[str, str]]:
    """Context and text of every panel, button and setting."""
    found = set()
    for cls in CLASSES:
        if getattr(cls, "bl_label", None):
            found.add(("Operator" if issubclass(cls, bpy.types.Operator) else "*", cls.bl_label))
        own = getattr(cls, "__annotations__", {})
        found |= {("*", prop.name) for prop in cls.bl_rna.properties if prop.identifier in own}
    return found


def test_every_translated_text_is_a_name_of_ours() -> None:
    for language, table in translations.load().items():
        assert sorted(set(table) - names()) == [], language


@pytest.mark.skipif(not bpy.app.build_options.international, reason="this Blender was built without languages")
def test_blender_speaks_german(monkeypatch: pytest.MonkeyPatch) -> None:
    view = bpy.context.preferences.view
    before = view.language, view.use_translate_interface
    try:
        view.language, view.use_translate_interface = "de_DE", True
        assert bpy.app.translations.pgettext_iface("Natural Variation") == "Natürliche Vielfalt"
    except TypeError:
        pytest.skip("this Blender has no German")
    finally:
        view.language, view.use_translate_interface = before


@pytest.mark.parametrize("text", ["a,b\n", "context,text,translation\n*,Bake,\n"])
def test_a_broken_table_is_refused(text: str, tmp_path: Path) -> None:
    (tmp_path / "xx.csv").write_text(text)
    with pytest.raises(FormatError, match=r"xx\.csv"):
        translations.load(tmp_path)
