"""Long speech: worked out bit by bit, cancelled at any time, and seen at one moment before all of it is known."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import risorius.api as api
from risorius.cli import main, speech
from risorius.face.drive.over_time import cue_goals, cue_plans
from risorius.face.drive.request import Drive
from risorius.progress import Progress, run
from risorius.speech.glimpse import glimpse

from ..long_speech import lasting

FPS = 10.0
JOY, FEAR = api.expression("joy"), api.expression("fear")
CUES = [
    api.Cue(JOY, start=0.0, onset=0.4, apex=1.0, offset=0.6),
    api.Cue(FEAR, start=1.5, onset=0.4, apex=1.0, offset=0.6, seed=3),
    api.Cue(JOY, start=5.0, onset=0.4, apex=1.0, offset=0.6),
]


def test_longer_speech_tells_more_of_its_progress() -> None:
    steps = [list(api.say_steps(lasting(seconds), emotion=JOY, fps=FPS)) for seconds in (30.0, 300.0, 900.0)]
    counts = [len(told) for told in steps]
    assert counts[0] < counts[1] < counts[2]
    for told in steps:
        fractions = [step.fraction for step in told]
        assert fractions == sorted(fractions)
        assert all(step.text for step in told)


def test_bit_by_bit_it_is_what_is_said_at_once() -> None:
    told = list[float]()
    lively = api.Liveliness.usual(2)
    asked = {"cues": CUES, "fps": FPS, "liveliness": lively}
    said = api.say(lasting(20.0), progress=lambda step: told.append(step.fraction), **asked)
    stepped = run(api.say_steps(lasting(20.0), **asked))
    np.testing.assert_array_equal(said.stream.frames, stepped.stream.frames)
    assert told


def test_feelings_are_planned_as_a_face_plans_them() -> None:
    plans = np.array([plan.goal for plan in cue_plans(CUES, FPS, Drive.NATURAL)])
    np.testing.assert_allclose(run(cue_goals(CUES, FPS)), plans, atol=1e-9)


def test_one_moment_is_what_all_of_it_has_there() -> None:
    said = lasting(20.0)
    frames = api.say(said, cues=CUES, fps=FPS).stream.frames
    for step in (0, 3, 17, 60, 61, 130, len(frames) - 1):
        seen = glimpse(said, CUES, step / FPS, FPS)
        np.testing.assert_allclose(seen, frames[step], atol=1.0, err_msg=str(step))  # FAP units: 0.06 mm of a jaw


def test_ctrl_c_leaves_no_file_and_no_traceback(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    table, told = tmp_path / "a.csv", list[str]()
    table.write_text("start,end,phoneme\n0.0,0.1,m\n0.1,0.2,a\n", encoding="utf-8")

    def stop(step: Progress) -> None:
        told.append(step.text)
        if len(told) == 3:
            raise KeyboardInterrupt

    monkeypatch.setattr(speech, "when_slow", lambda: stop)
    assert main(["say", "--timings", str(table), "--out", str(tmp_path / "a.fap")]) == 130
    assert capsys.readouterr().err.splitlines()[-1] == "risorius say: stopped"
    assert [path.name for path in tmp_path.iterdir()] == ["a.csv"]
