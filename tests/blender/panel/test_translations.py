"""Names in other languages: tables that fit the names there are, used by Blender, and refused where broken."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import bpy
import pytest
from bl_ui.utils import PresetPanel
from risorius.errors import FormatError
from risorius.operators import translations
from risorius.operators.classes import CLASSES
from risorius.operators.sidebar import LINE

OPERATORS = Path(translations.__file__).parent
#: Letters that fit on a button, which has an icon and may share its row.
BUTTON = 28
#: What a layout writes text with.
LAYOUT = ("label", "menu", "operator", "prop")


def names(properties_of: Callable[[type], Any]) -> set[tuple[str, str]]:
    """Context and text of every panel, button, setting and choice, and of what the panels write themselves."""
    found = set()
    for cls in CLASSES:
        context = "Operator" if issubclass(cls, bpy.types.Operator) else "*"
        if getattr(cls, "bl_label", None) and not issubclass(cls, PresetPanel):  # its label becomes the preset's name
            found.add((context, cls.bl_label))
        if issubclass(cls, (bpy.types.Operator, bpy.types.PropertyGroup, bpy.types.AddonPreferences)):
            ours = [base for base in cls.__mro__ if base.__module__.startswith("risorius.")]
            own = {name for base in ours for name in vars(base).get("__annotations__", {})}
            shown = [prop for prop in properties_of(cls) if prop.identifier in own and prop.name != prop.identifier]
            found |= {("*", prop.name) for prop in shown}
            found |= {("*", item.name) for prop in shown if prop.type == "ENUM" for item in prop.enum_items}
    for path in sorted(OPERATORS.rglob("*.py")):
        found |= set(written(ast.parse(path.read_text(encoding="utf-8"))))
    return found


def written(source: ast.AST) -> Iterator[tuple[str, str]]:
    """Texts of buttons and labels that a panel writes, where they hold no value."""
    for call in ast.walk(source):
        if not (isinstance(call, ast.Call) and isinstance(call.func, ast.Attribute) and call.func.attr in LAYOUT):
            continue
        context = "Operator" if call.func.attr == "operator" else "*"
        for node in (part for word in call.keywords if word.arg == "text" for part in choices(word.value)):
            if isinstance(node, ast.Constant) and node.value:
                yield context, node.value


def choices(text: ast.expr) -> list[ast.expr]:
    """A text, or both of an either-or."""
    return [text.body, text.orelse] if isinstance(text, ast.IfExp) else [text]


def test_every_translated_text_is_a_name_of_ours(properties_of: Callable[[type], Any]) -> None:
    assert "de" in translations.load()
    for language, table in translations.load().items():
        assert sorted(set(table) - names(properties_of)) == [], language


def test_every_name_is_translated(properties_of: Callable[[type], Any]) -> None:
    for language, table in translations.load().items():
        assert sorted(names(properties_of) - set(table)) == [], language


def test_every_text_fits_the_sidebar(properties_of: Callable[[type], Any]) -> None:
    for language, table in {"en": {name: name[1] for name in names(properties_of)}, **translations.load()}.items():
        assert [text for text in table.values() if len(text) > LINE] == [], language
    for context, text in names(properties_of):
        assert context != "Operator" or len(text) <= BUTTON, text


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
