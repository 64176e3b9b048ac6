"""What reviewers of extensions look for in the sources of the zip, read as syntax trees.

A rule is a function from a tree to the offences in it. Each is shown an offender first, so that it is known to bite.
"""

from __future__ import annotations

import ast
import tomllib
import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

#: Modules of which nothing may be imported, with all that lies in them.
THREADS = {"threading", "_thread", "concurrent", "multiprocessing", "asyncio"}
PROCESSES = {"subprocess", "pip", "ensurepip", "venv", "pty"}
NETWORK = {"socket", "ssl", "http", "urllib", "ftplib", "smtplib", "requests", "webbrowser"}
HIDDEN_CODE = {"marshal", "pickle", "shelve", "code", "runpy", "imp"}
CAMERAS = {"cv2", "imageio", "mediapipe"}

#: The module that finds its tables beside itself. All else asks it, and nothing is written there.
READ_BESIDE_ITSELF = {"resources.py"}


def dotted(node: ast.AST) -> str:
    """`sys.path.append` as text; empty for anything but names and attributes."""
    if isinstance(node, ast.Attribute):
        owner = dotted(node.value)
        return f"{owner}.{node.attr}" if owner else ""
    return node.id if isinstance(node, ast.Name) else ""


def imported(tree: ast.AST) -> Iterator[str]:
    """The names of all modules that are imported, wherever the import stands, and of what is taken out of them."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and not node.level:
            yield from (f"{node.module}.{alias.name}" for alias in node.names)
        elif isinstance(node, ast.Call) and dotted(node.func).endswith(("import_module", "find_spec")):
            yield from (word.value for word in node.args[:1] if isinstance(word, ast.Constant))


def imports_of(modules: set[str]) -> Callable[[ast.AST], list[str]]:
    """The rule against imports of these modules."""
    return lambda tree: [name for name in imported(tree) if name.partition(".")[0] in modules]


def executed_text(tree: ast.AST) -> list[str]:
    """Text run as code, by Python or by the system."""
    named = {"eval", "exec", "compile", "__import__", "os.system", "os.popen", "bpy.ops.script.python_file_run"}
    started = ("os.exec", "os.spawn", "os.fork", "os.posix_spawn", "builtins.")
    calls = [dotted(node.func) for node in ast.walk(tree) if isinstance(node, ast.Call)]
    return [name for name in calls if name in named or name.startswith(started)]


def changes_to_imports(tree: ast.AST) -> list[str]:
    """Any touch of sys.path and its kin, and changes to sys.modules, which may be looked into."""
    touched = [dotted(node) for node in ast.walk(tree) if isinstance(node, ast.Attribute)]
    places = {"sys.path", "sys.meta_path", "sys.path_hooks", "site.addsitedir"}
    changed = {f"sys.modules.{way}" for way in ("pop", "popitem", "update", "setdefault", "clear")}
    offences = [name for name in touched if name in places | changed]
    offences += [name for name in imported(tree) if name in {"sys.path", "sys.modules", "sys.meta_path", "site"}]
    for node in ast.walk(tree):
        if isinstance(node, ast.Subscript) and not isinstance(node.ctx, ast.Load):
            offences += [name for name in (dotted(node.value),) if name == "sys.modules"]
    return offences


def clipboard(tree: ast.AST) -> list[str]:
    """Uses of the system's clipboard."""
    return [dotted(node) for node in ast.walk(tree) if isinstance(node, ast.Attribute) and node.attr == "clipboard"]


def files_written(tree: ast.AST) -> list[str]:
    """Places where a file is written: what the permission `files` is for."""
    writes = {"write_text", "write_bytes", "write_whole", "save", "savez", "savez_compressed", "mkdir", "unlink"}
    calls = [node.func for node in ast.walk(tree) if isinstance(node, ast.Call)]
    names = [func.attr if isinstance(func, ast.Attribute) else dotted(func) for func in calls]
    return [name for name in names if name in writes]


def own_place(tree: ast.AST) -> list[str]:
    """Uses of `__file__`."""
    return [node.id for node in ast.walk(tree) if isinstance(node, ast.Name) and node.id == "__file__"]


RULES: dict[str, tuple[Callable[[ast.AST], list[str]], tuple[str, ...]]] = {
    "no text is run as code": (
        executed_text,
        ("eval('1')", "exec(text)", "os.system('ls')", "os.execv(a, b)", "builtins.eval('1')", "__import__('os')"),
    ),
    "no code is hidden in data": (imports_of(HIDDEN_CODE), ("import pickle", "from marshal import loads")),
    "no threads": (imports_of(THREADS), ("import threading", "from concurrent.futures import ThreadPoolExecutor")),
    "no processes, no pip": (imports_of(PROCESSES), ("def f():\n import subprocess", "import_module('pip')")),
    "no network": (imports_of(NETWORK), ("import urllib.request", "from http import client")),
    "no camera": (imports_of(CAMERAS), ("import cv2", "importlib.import_module('cv2')")),
    "no change of what Python imports": (
        changes_to_imports,
        ("sys.path.append(p)", "sys.path += [p]", "from sys import path", "import site",
         "sys.modules['a'] = b", "del sys.modules['a']", "sys.modules.pop('a')"),
    ),
    "no clipboard": (clipboard, ("context.window_manager.clipboard = 'a'",)),
}  # fmt: skip


@pytest.fixture(scope="module")
def trees(small_zip: Path) -> dict[str, ast.AST]:
    """Every module of the zip by its name."""
    with zipfile.ZipFile(small_zip) as archive:
        names = [name for name in archive.namelist() if name.endswith(".py")]
        return {name: ast.parse(archive.read(name), name) for name in names}


def offences(rule: Callable[[ast.AST], list[str]], trees: dict[str, ast.AST]) -> list[str]:
    """What a rule finds, with the module."""
    return [f"{name}: {found}" for name, tree in trees.items() for found in rule(tree)]


@pytest.mark.parametrize(("rule", "offenders"), RULES.values(), ids=RULES)
def test_sources_keep_the_rule(
    rule: Callable[[ast.AST], list[str]], offenders: tuple[str, ...], trees: dict[str, ast.AST]
) -> None:
    assert [text for text in offenders if not rule(ast.parse(text))] == []
    assert len(trees) > 200
    assert offences(rule, trees) == []


def test_nothing_is_written_beside_the_sources(trees: dict[str, ast.AST]) -> None:
    assert {name for name, tree in trees.items() if own_place(tree)} == READ_BESIDE_ITSELF


def test_the_only_permission_is_the_one_that_is_used(small_zip: Path, trees: dict[str, ast.AST]) -> None:
    with zipfile.ZipFile(small_zip) as archive:
        manifest = tomllib.loads(archive.read("blender_manifest.toml").decode())
    assert set(manifest["permissions"]) == {"files"}
    assert offences(files_written, trees) != []


def test_all_code_can_be_read(small_zip: Path) -> None:
    with zipfile.ZipFile(small_zip) as archive:
        names = archive.namelist()
    assert [name for name in names if name.endswith((".pyc", ".pyd", ".so", ".dll", ".dylib", ".exe"))] == []
    assert small_zip.stat().st_size < 5e6


def test_imports_of_its_own_modules_are_relative(trees: dict[str, ast.AST]) -> None:
    """Installed, the package is `bl_ext.<repository>.risorius`, and any other name would be another add-on's."""
    tops = {name.partition("/")[0].removesuffix(".py") for name in trees}
    own = imports_of({"risorius", *tops} - {"__init__"})
    assert own(ast.parse("from risorius import api")) != []
    assert offences(own, trees) == []
