"""The command line: what it prints, its exit codes, and that it only passes on what the API says."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import risorius.api as api
from risorius.cli import main

Run = Callable[..., Any]
VERBS = ("profile", "bake", "render", "measure", "recognise", "fap", "points", "demo")


@pytest.fixture
def run_json(capsys: pytest.CaptureFixture[str]) -> Run:
    """Run one verb with --json, which must succeed, and return the object that it prints."""

    def run(*arguments: object) -> Any:
        assert main([*map(str, arguments), "--json"]) == 0
        return json.loads(capsys.readouterr().out)

    return run


@pytest.fixture
def default_obj(tmp_path: Path) -> Path:
    """The default head as an .obj file."""
    return write_obj(tmp_path / "rest.obj", api.default_face().vertices)


def write_obj(path: Path, vertices: np.ndarray) -> Path:
    """A mesh with the default face's polygons as an .obj file."""
    lines = [f"v {x:.9f} {y:.9f} {z:.9f}" for x, y, z in vertices]
    lines += ["f " + " ".join(str(index + 1) for index in polygon) for polygon in api.default_face().polygons]
    path.write_text("\n".join(lines))
    return path


def test_profile_prints_the_ranges_of_the_api(run_json: Run) -> None:
    said = run_json("profile", "terrified")
    profile = api.expression("terrified")
    assert {int(number): (row["low"], row["high"]) for number, row in said["ranges"].items()} == profile.ranges
    assert said["activation"] == profile.activation
    assert said["ranges"]["3"]["name"] == "open_jaw"


def test_profile_of_a_point_of_the_wheel_and_of_a_variant(run_json: Run) -> None:
    at_angle = run_json("profile", "--angle", 20, "--activation", 5)
    assert {int(n) for n in at_angle["ranges"]} == set(api.expression(angle=20.0, activation=5.0).ranges)
    variant = run_json("profile", "fear", "--variant", 8)
    assert {int(n) for n in variant["ranges"]} == set(api.archetype("fear", 8).ranges)


def test_people_read_a_line_per_fap(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["profile", "joy"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 1 + len(api.expression("joy").ranges)
    assert lines[0].startswith("joy: activation 5.4")


def test_fap_writes_an_expression_that_is_read_back_and_recognised(run_json: Run, tmp_path: Path) -> None:
    path = tmp_path / "surprise.fap"
    written = run_json("fap", "surprise", "--out", path, "--fps", 30)
    looked_into = run_json("fap", path)
    assert written["faps"] == looked_into["faps"] == sorted(api.expression("surprise").ranges)
    assert looked_into["fps"] == 30
    beliefs = run_json("recognise", path)
    assert next(iter(beliefs)) == "surprise"
    assert beliefs["surprise"] == pytest.approx(max(beliefs.values()))


def test_recognise_sees_a_stream_that_names_its_expression(run_json: Run, tmp_path: Path) -> None:
    """FAP 2 alone: expression 4 (fear) at full intensity."""
    path = tmp_path / "fear.fap"
    mask = " ".join("1" if number == 2 else "0" for number in range(1, 69))
    path.write_text(f"2.1 fear 25 1\n{mask}\n0 4 63 0 0 0 0\n", encoding="ascii")
    assert next(iter(run_json("recognise", path))) == "fear"


def test_fap_converts_a_file(run_json: Run, tmp_path: Path) -> None:
    run_json("fap", "anger", "--out", tmp_path / "a.fap")
    run_json("fap", tmp_path / "a.fap", "--out", tmp_path / "b.fap")
    one, other = api.read_fap(tmp_path / "a.fap"), api.read_fap(tmp_path / "b.fap")
    np.testing.assert_array_equal(one.frames, other.frames)


def test_measure_reads_faps_off_a_deformed_mesh(run_json: Run, tmp_path: Path) -> None:
    face = api.default_face()
    moved = face.pose(api.expression("joy").frame()).positions
    path = write_obj(tmp_path / "moved.obj", moved)
    said = run_json("measure", path, "--out", tmp_path / "moved.fap")[str(path)]
    measured = face.measure(moved)
    expected = {api.fap(i + 1).name: value for i, value in enumerate(measured) if not np.isnan(value)}
    expected |= {f"f{i + 1}": value for i, value in enumerate(face.features(moved))}
    assert said == pytest.approx(expected, abs=0.05)
    assert said["raise_l_cornerlip"] > 50.0
    stored = api.read_fap(tmp_path / "moved.fap").frames[0]
    np.testing.assert_allclose(stored[2:], measured[2:], atol=1.0)


def test_recognise_reads_a_deformed_mesh(run_json: Run, tmp_path: Path) -> None:
    surprise = api.expression("surprise")
    posed = api.default_face().pose(surprise.frame(), emotion=surprise.weights).positions
    beliefs = run_json("recognise", write_obj(tmp_path / "surprised.obj", posed))
    assert set(beliefs) == {str(name) for name in api.ARCHETYPES}
    assert max(beliefs, key=beliefs.get) == "surprise"


@pytest.fixture
def rising(tmp_path: Path) -> Path:
    """A stream of surprise, from none to all of it."""
    frames = np.linspace(0.0, 1.0, 4)[:, None] * api.archetype("surprise", 0).frame()
    api.write_fap(tmp_path / "rising.fap", api.FapStream(frames, fps=10.0, first_frame=1))
    return tmp_path / "rising.fap"


def test_recognise_by_either_rule(run_json: Run, rising: Path) -> None:
    frame = api.read_fap(rising).frames[2]
    for rule in ("paper", "robust"):
        said = run_json("recognise", rising, "--rule", rule, "--frame", 2)
        beliefs = api.recognise(frame, rule=rule)
        rest = {} if beliefs.neutral is None else {"neutral": beliefs.neutral}
        assert ("neutral" in rest) == (rule == "robust")
        assert said == pytest.approx({str(name): b for name, b in beliefs.items()} | rest)


def test_recognise_says_more_where_words_are_asked_for(run_json: Run, rising: Path) -> None:
    said = run_json("recognise", rising, "--words", "astonished", "guilty", "--rule", "robust")
    frame = api.read_fap(rising).frames[-1]
    assert said["best"] == "surprise"
    assert said["frame"] == 3
    assert said["words"] == pytest.approx(api.recognise_words(frame, ["astonished", "guilty"]))
    assert list(said["words"]) == list(api.recognise_words(frame, ["astonished", "guilty"]))
    assert said["strength"] == pytest.approx(1.0, abs=0.01)
    assert next(iter(said["decisive"])) == api.fap(next(iter(api.recognise(frame, rule="robust").decisive))).name
    assert len(run_json("recognise", rising, "--words")["words"]) == 10


def test_recognise_over_time_prints_and_writes_every_frame(run_json: Run, rising: Path, tmp_path: Path) -> None:
    said = run_json("recognise", rising, "--over-time", "--out", tmp_path / "t.csv")
    track = api.recognise_over_time(api.read_fap(rising).frames, fps=10.0, first_frame=1)
    assert said["frames"] == [1, 2, 3, 4]
    assert said["beliefs"]["surprise"] == pytest.approx(track.beliefs[:, 5])
    assert said["best"][-1] == "surprise"
    api.write_belief_csv(tmp_path / "expected.csv", track)
    assert (tmp_path / "t.csv").read_text() == (tmp_path / "expected.csv").read_text()


def test_recognise_over_time_of_meshes(capsys: pytest.CaptureFixture[str], default_obj: Path) -> None:
    assert main(["recognise", str(default_obj), str(default_obj), "--over-time"]) == 0
    assert len(capsys.readouterr().out.splitlines()) == 3


def test_long_streams_tell_their_progress(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    api.write_fap(tmp_path / "long.fap", api.FapStream(np.zeros((501, 68))))
    assert main(["recognise", str(tmp_path / "long.fap"), "--over-time", "--json"]) == 0
    assert "100 %  501 of 501 frames" in capsys.readouterr().err


def test_points_fit_their_mesh(run_json: Run, shared: Path) -> None:
    heads = shared / "heads"
    said = run_json("points", heads / "ict.fp.json", "--mesh", heads / "ict.npz")
    assert said["points"] > 80
    assert said["fapu_m"]["mw0"] == pytest.approx(0.0507, abs=1e-4)


@pytest.mark.parametrize(
    "arguments",
    [
        [],
        ["dance"],
        ["profile"],
        ["profile", "joy", "--angle", "20"],
        ["profile", "--angle", "20"],
        ["profile", "joy", "--activation", "much"],
        ["measure"],
        ["measure", "a.obj", "--mesh", "b.obj"],
        ["recognise", "a.fap", "--over-time", "--words"],
        ["recognise", "a.fap", "--out", "a.csv"],
        ["recognise", "a.fap", "b.fap"],
        ["recognise", "a.fap", "--rule", "mine"],
        ["bake", "joy"],
        ["render", "joy", "--out", "a.mp4", "--engine", "pencil"],
    ],
)
def test_wrong_usage_exits_with_2(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(arguments) == 2
    said = capsys.readouterr()
    assert said.out == ""
    assert "risorius" in said.err


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (["profile", "joyous-ish"], "joyous-ish"),
        (["profile", "joy", "--activation", "0"], "activation"),
        (["profile", "joy", "--activation", "99"], "activation"),
        (["fap", "gone.fap"], "gone.fap"),
        (["measure", "gone.obj"], "gone.obj"),
        (["recognise", "face.fbx"], ".obj"),
        (["recognise", "gone.fap", "--over-time"], "gone.fap"),
        (["points", "gone.json", "--mesh", "gone.obj"], "gone"),
    ],
)
def test_errors_exit_with_1_and_name_the_thing(
    arguments: list[str], named: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(arguments) == 1
    said = capsys.readouterr()
    assert said.out == ""
    assert named in said.err


def test_unwritable_output_exits_with_1(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["fap", "joy", "--out", str(tmp_path / "no" / "such" / "folder" / "joy.fap")]) == 1
    assert "joy.fap" in capsys.readouterr().err


def test_a_mesh_with_other_vertices_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "small.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    assert main(["measure", str(tmp_path / "small.obj")]) == 1
    assert "small.obj" in capsys.readouterr().err


@pytest.mark.parametrize("verb", ["bake joy --out a.blend", "render joy --out a.mp4", "demo"])
def test_verbs_that_need_blender_say_so_without_it(verb: str, tmp_path: Path) -> None:
    """In an interpreter where bpy cannot be imported, wherever the tests run."""
    code = "import sys; sys.modules['bpy'] = None; from risorius.cli import main; sys.exit(main(sys.argv[1:]))"
    command = [sys.executable, "-c", code, *verb.split()]
    done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, check=False)
    assert done.returncode == 1
    assert "pip install bpy" in done.stderr
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("verb", VERBS)
def test_every_verb_explains_itself(verb: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([verb, "--help"]) == 0
    assert f"risorius {verb}" in capsys.readouterr().out


@pytest.mark.slow
def test_module_and_installed_command_are_the_same() -> None:
    module = subprocess.run([sys.executable, "-m", "risorius", "profile", "fear"], capture_output=True, check=True)
    command = Path(sys.executable).parent / "risorius"
    installed = subprocess.run([command, "profile", "fear"], capture_output=True, check=True)
    assert module.stdout == installed.stdout != b""


def test_points_are_found_and_written(run_json: Run, shared: Path, tmp_path: Path) -> None:
    said = run_json("points", "--mesh", shared / "heads" / "ict_narrow.npz", "--out", tmp_path / "p.json")
    assert said["topology"].startswith("ICT")
    checked = run_json("points", tmp_path / "p.json", "--mesh", shared / "heads" / "ict_narrow.npz")
    assert checked["points"] == len(said["points"]) + 2  # the pupils are added


def test_a_trackers_table_is_recognised(run_json: Run, tmp_path: Path) -> None:
    frame = np.nan_to_num(api.archetype("surprise", 0).frame())
    stream = api.FapStream(frames=np.stack([0.0 * frame, frame]), fps=25.0, name="take")
    api.write_fap_csv(tmp_path / "take.csv", stream)
    said = run_json("recognise", tmp_path / "take.csv")
    assert max(said, key=said.get) == "surprise"
