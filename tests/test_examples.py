"""The examples in docstrings do what they show; each runs in an empty folder and knows `api` and `np`."""

from __future__ import annotations

import doctest
import inspect
import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import risorius.api as api
from places import ROOT

#: Those that take more than about a second.
SLOW = {"arkit_shapes", "Creases", "KeptFaces", "find_points"}


def documented() -> Iterator[tuple[str, Any]]:
    """Everything public that has a docstring of its own, by name: functions, classes and their methods."""
    for name in api.__all__:
        value = getattr(api, name)
        if inspect.isclass(value) and value.__module__.startswith("risorius."):
            yield value.__name__, value
            for method, function in vars(value).items():
                if not method.startswith("_") and is_function(function):
                    yield f"{value.__name__}.{method}", function
        elif is_function(value):
            yield name, value


def is_function(value: Any) -> bool:
    """Whether it is a function or method, cached or not."""
    return inspect.isfunction(inspect.unwrap(getattr(value, "__func__", value)))


DOCUMENTED: dict[str, Any] = dict(documented())
EXAMPLES = {name: text for name, value in DOCUMENTED.items() if ">>>" in (text := inspect.getdoc(value) or "")}


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=pytest.mark.slow if name in SLOW else ()) for name in EXAMPLES]
)
def test_an_example_does_what_it_shows(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    run(EXAMPLES[name], name)


def run(text: str, name: str) -> None:
    """Run the examples in a text; fails with what came instead."""
    example = doctest.DocTestParser().get_doctest(text, {"api": api, "np": np}, name, None, None)
    told: list[str] = []
    found = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS).run(example, out=told.append)
    assert found.attempted
    assert not found.failed, "".join(told)


def test_every_public_function_and_each_method_of_a_face_has_an_example() -> None:
    """So have profiles and streams, which are what faces are given."""
    functions = {name for name, value in DOCUMENTED.items() if not inspect.isclass(value)}
    wanted = {name for name in functions if "." not in name or name.startswith(("Face.", "Profile.", "FapStream."))}
    assert sorted(wanted - set(EXAMPLES)) == []
    assert {"fap", "Face.pose", "Face.from_arrays", "FapStream.expanded", "default_face"} <= functions


@pytest.mark.slow
@pytest.mark.parametrize("page", ["README.md", "docs/scripting.md"])
def test_the_scripts_of_a_page_run(page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    write_what_scripts_read()
    blocks = re.findall(r"^```python\n(.*?)^```", (ROOT / page).read_text(encoding="utf-8"), flags=re.M | re.S)
    scripts = [block for block in blocks if "import risorius.api as api" in block]
    assert len(scripts) == {"README.md": 1, "docs/scripting.md": 2}[page]
    for script in scripts:
        for wide, narrow in (("range(100)", "range(1)"), ("apex=1.0, offset=0.8", "apex=0.0, offset=0.1")):
            script = script.replace(wide, narrow)
        exec(compile(script, page, "exec"), {})
    assert page == "README.md" or api.read_stream("hero_take.csv").frames[-1, 2] > 0.0


def write_what_scripts_read() -> None:
    """A stream; a head with its points and a key; a recording of three frames in which the jaw opens."""
    api.write_fap("speech.fap", api.FapStream(np.zeros((2, 68)), fps=25.0))
    head, face = api.build_default_head(), api.default_face()
    lines = ["v {} {} {}".format(*vertex) for vertex in head.vertices.tolist()]
    lines += ["f " + " ".join(str(index + 1) for index in polygon) for polygon in head.polygons]
    Path("hero.obj").write_text("\n".join(lines))
    Path("hero.json").write_text(json.dumps({name: list(point.position) for name, point in face.points.items()}))
    jaw = np.where(np.arange(68) == 2, 300.0, np.nan)
    moved = face.pose(jaw).positions - face.vertices
    np.savez("hero_keys.npz", names=np.array(["jawOpen"]), displacement=moved[None])
    Path("take.csv").write_text("timestamp,jawOpen\n0.0,0.0\n0.04,0.5\n0.08,1.0\n")


def test_a_wrong_example_fails() -> None:
    with pytest.raises(AssertionError, match=r"Got:\n +4"):
        run(">>> api.fap(4).number\n3\n", "wrong")
