"""The rooms of tools/: scripts that are thin, packages beside them, and one place that says where things lie."""

from __future__ import annotations

import ast

from places import ROOT

TOOLS = ROOT / "tools"
MODULES = {path.relative_to(TOOLS).as_posix(): path.read_text(encoding="utf-8") for path in TOOLS.rglob("*.py")}


def reads_environment(text: str, name: str) -> bool:
    """Whether a module asks the environment for this variable."""
    calls = (node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Call | ast.Subscript))
    return any("environ" in ast.unparse(node) and name in ast.unparse(node) for node in calls)


def test_the_shared_data_are_found_in_one_place() -> None:
    assert [name for name, text in MODULES.items() if reads_environment(text, "RISORIUS_SHARED")] == ["places.py"]


def test_the_checkout_is_found_in_one_place() -> None:
    """Others may look beside themselves. `in_blender.py` runs before it can import from here."""
    found = {name for name, text in MODULES.items() if "__file__).resolve()" in text}
    assert found == {"places.py", "in_blender.py"}


def test_no_script_hides_a_package() -> None:
    """Scripts run with tools/ first on the path: a script and a package of one name would be told apart by luck."""
    packages = {path.parent.name for path in TOOLS.glob("*/__init__.py")}
    scripts = {path.stem for path in TOOLS.glob("*.py")}
    assert packages >= {"fit", "recognition", "release"}
    assert not packages & scripts


def test_every_script_and_package_stands_in_the_page_on_architecture() -> None:
    page = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    folders = [path for path in TOOLS.iterdir() if path.is_dir() and any(path.glob("*.py"))]
    named = [path for path in [*TOOLS.glob("*.py"), *folders] if path.name not in SERVANTS]
    missing = [path.name for path in named if f"`tools/{path.name}{'/' if path.is_dir() else ''}`" not in page]
    assert sorted(missing) == []


#: What others call, and no developer does.
SERVANTS = {"system_libraries.py", "in_blender.py"}


def test_rules_find_what_breaks_them() -> None:
    assert reads_environment('import os\nx = os.environ.get("RISORIUS_SHARED") or 1', "RISORIUS_SHARED")
    assert not reads_environment('print("set RISORIUS_SHARED")', "RISORIUS_SHARED")
