"""The manual names every refusal: what Risorius says when it does not do something, and what to do then."""

from __future__ import annotations

import ast
from collections.abc import Iterator

import pytest
from places import DOCS, ROOT

#: Where refusals that users meet are raised, and where in the call their text begins.
RAISED = (
    ("SceneError", 1, ("scene", "operators")),
    ("ModelError", 0, ("face/fit", "face/mesh/points.py", "face/mesh/head_frame.py", "face/mesh/fap_units.py")),
)


def text_of(node: ast.expr) -> str | None:
    """A text with ... where a value stands; None where it is not written there."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return node.value
    if isinstance(node, ast.JoinedStr):
        return "".join(str(part.value) if isinstance(part, ast.Constant) else "..." for part in node.values)
    return None


def phrase_of(text: str) -> str:
    """What of a refusal a reader looks for: the problem, before the remedy."""
    return text.split(": ")[0].split("; ")[0].strip().rstrip(":")


def refusals() -> Iterator[tuple[str, str]]:
    """Place and phrase of every refusal that is written where it is raised."""
    for error, first, rooms in RAISED:
        for room in rooms:
            top = ROOT / room
            for path in sorted(top.rglob("*.py") if top.is_dir() else [top]):
                for call in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                    if not (isinstance(call, ast.Call) and isinstance(call.func, ast.Name) and call.func.id == error):
                        continue
                    text = text_of(call.args[first]) if len(call.args) > first else None
                    if text is not None and len(phrase_of(text).strip(". ")) > 3:
                        yield f"{path.relative_to(ROOT)}:{call.lineno}", phrase_of(text)


@pytest.mark.parametrize(("place", "phrase"), list(refusals()), ids=lambda text: text if ":" in text else "")
def test_the_manual_names_it(place: str, phrase: str) -> None:
    page = (DOCS / "troubleshooting.md").read_text(encoding="utf-8")
    assert f'"{phrase}"' in page, f"{place}: name it in docs/troubleshooting.md with its cause and remedy"


def test_refusals_are_found() -> None:
    found = {phrase for _, phrase in refusals()}
    assert len(found) > 60
    assert {"is half a face with a Mirror modifier", "has ... doubled vertices at the mouth"} <= found
