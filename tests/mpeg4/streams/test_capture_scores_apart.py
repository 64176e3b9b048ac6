"""Recordings that are laid out otherwise than frame by frame: a row, an entry, a message or a curve for each score."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from risorius import api
from risorius.errors import FormatError

OPEN = api.load_shapes()["jawOpen"].frame[2]
BLINK = api.load_shapes()["eyeBlinkLeft"].frame[19 - 1]
COUNT, FPS = 12, 24.0
NAMES = ("jawOpen", "eyeBlinkLeft", "eyeSquintLeft", "eyeWideLeft")


def score(name: str, frame: int) -> float:
    """The jaw opens by a twentieth from frame to frame, the lid closes by a thirtieth."""
    return {"jawOpen": frame / 20, "eyeBlinkLeft": frame / 30}.get(name, 0.0)


def each() -> list[tuple[int, str, float]]:
    """Every score: its frame, its name and what it is."""
    return [(frame, name, score(name, frame)) for frame in range(COUNT) for name in NAMES]


def lines(*texts: str) -> str:
    """Lines of a file."""
    return "\n".join(texts)


def keys(name: str) -> list[dict[str, float]]:
    """A curve as keys; the jaw's needs those of its ends alone."""
    frames = (0, COUNT - 1) if name == "jawOpen" else range(COUNT)
    return [{"time": frame / FPS, "value": score(name, frame)} for frame in frames]


TABLES = {
    "long": lines("timestamp,blendshape,score", *(f"{f / FPS:.5f},{n},{v:.5f}" for f, n, v in each())),
    "long, decimal commas": lines("frame;name;value", *(f"{f};{n};{v:.5f}".replace(".", ",") for f, n, v in each())),
    "long, saved again": lines(
        ",time,shape,weight", *(f"{i},{f / FPS:.5f},{n},{v:.5f}" for i, (f, n, v) in enumerate(each()))
    ),
    "sideways": lines(
        "name," + ",".join(map(str, range(COUNT))),
        *(n + "," + ",".join(f"{score(n, f):.5f}" for f in range(COUNT)) for n in NAMES),
    ),
    "sideways, named": lines(
        "shape," + ",".join(f"frame_{f:03d}" for f in range(COUNT)),
        *(n + "," + ",".join(f"{score(n, f):.5f}" for f in range(COUNT)) for n in NAMES),
    ),
    "sideways, timed": lines(
        "shape," + ",".join(f"{f / FPS:.5f}" for f in range(COUNT)),
        *(n + "," + ",".join(f"{score(n, f):.5f}" for f in range(COUNT)) for n in NAMES),
    ),
    "each row twice": lines(
        "timestamp," + ",".join(NAMES),
        *(f"{f / FPS:.5f}," + ",".join(f"{score(n, f):.5f}" for n in NAMES) for f in range(COUNT) for _ in range(2)),
    ),
}

DOCUMENTS: dict[str, Any] = {
    "entries": [{"timestamp": 7.0 + f / FPS, "blendShapeLocation": n, "value": v} for f, n, v in each()],
    "entries by frame": [{"frame": f, "index": i, "name": n, "score": v} for i, (f, n, v) in enumerate(each())],
    "messages": [{"time": f / FPS, "address": "/VMC/Ext/Blend/Val", "args": [n, v]} for f, n, v in each()],
    "messages with types": [
        message
        for f in range(COUNT)
        for message in (
            {"address": "/VMC/Ext/OK", "args": [{"type": "i", "value": 1}]},
            *(
                {
                    "address": "/VMC/Ext/Blend/Val",
                    "args": [{"type": "s", "value": n}, {"type": "f", "value": score(n, f)}],
                }
                for n in NAMES
            ),
            {"address": "/VMC/Ext/Blend/Apply", "args": []},
        )
    ],
    "names and rows by any name": {
        "blend_shape_keys": list(NAMES),
        "blend_shape_values": [[score(n, f) for n in NAMES] for f in range(COUNT)],
        "fps": FPS,
    },
    "names in what is said of all": {
        "metadata": {"blendshape_names": list(NAMES), "frame_rate": FPS},
        "frames": [{"blendshapes": [score(n, f) for n in NAMES]} for f in range(COUNT)],
    },
    "names and bare rows": {
        "info": {"shapes": list(NAMES), "fps": FPS},
        "frames": [[score(n, f) for n in NAMES] for f in range(COUNT)],
    },
    "names and one row of all": {
        "fps": FPS,
        "blendshapes": list(NAMES),
        "frames": [score(n, f) for f in range(COUNT) for n in NAMES],
    },
    "curves": {"curves": [{"name": n, "keys": keys(n)} for n in NAMES]},
    "tracks": {
        "name": "take",
        "tracks": [
            {
                "name": f"Head.morphTargetInfluences[{n}]",
                "times": [f / FPS for f in range(COUNT)],
                "values": [score(n, f) for f in range(COUNT)],
            }
            for n in NAMES
        ],
    },
}
#: What does not say the rate is read at 30 frames per second.
UNTIMED = ("long, decimal commas", "sideways", "sideways, named", "entries by frame", "messages with types")


def expect_all(recording: api.Recording, layout: str) -> None:
    """Every frame, at the rate that the layout states."""
    assert recording.stream.fps == pytest.approx(30.0 if layout in UNTIMED else FPS)
    frames = recording.stream.frames
    assert len(frames) == COUNT
    np.testing.assert_allclose(frames[:, 2], OPEN * np.arange(COUNT) / 20, atol=0.1)
    np.testing.assert_allclose(frames[:, 18], BLINK * np.arange(COUNT) / 30, atol=0.1)


@pytest.mark.parametrize("layout", TABLES)
def test_tables_in_every_layout(layout: str, tmp_path: Path) -> None:
    (tmp_path / "take.csv").write_text(TABLES[layout])
    expect_all(api.read_recording(tmp_path / "take.csv"), layout)


@pytest.mark.parametrize("layout", DOCUMENTS)
def test_documents_in_every_layout(layout: str, tmp_path: Path) -> None:
    (tmp_path / "take.json").write_text(json.dumps(DOCUMENTS[layout]))
    expect_all(api.read_recording(tmp_path / "take.json"), layout)


@pytest.mark.parametrize("layout", [name for name, value in DOCUMENTS.items() if isinstance(value, list)])
def test_entries_a_line_each(layout: str, tmp_path: Path) -> None:
    (tmp_path / "take.jsonl").write_text(lines(*map(json.dumps, DOCUMENTS[layout])))
    expect_all(api.read_recording(tmp_path / "take.jsonl"), layout)


def test_a_missing_score_is_unknown_in_its_frame(tmp_path: Path) -> None:
    kept = [(f, n, v) for f, n, v in each() if (f, n) != (4, "jawOpen")]
    (tmp_path / "a.csv").write_text(lines("frame,name,score", *(f"{f},{n},{v}" for f, n, v in kept)))
    frames = api.read_stream(tmp_path / "a.csv").frames
    assert np.isnan(frames[:, 2]).nonzero()[0].tolist() == [4]


def test_several_faces_score_by_score_are_refused_or_chosen(tmp_path: Path) -> None:
    of_frame = [each()[4 * frame : 4 * frame + 4] for frame in range(COUNT)]
    rows = [f"{f},{face},{n},{v * (1 - face)}" for scores in of_frame for face in (0, 1) for f, n, v in scores]
    path = tmp_path / "a.csv"
    path.write_text(lines("frame,face_id,name,score", *rows))
    with pytest.raises(FormatError, match="2 faces"):
        api.read_stream(path)
    assert api.read_stream(path, face=0).frames[-1, 2] > 0.0 == api.read_stream(path, face=1).frames[-1, 2]


@pytest.mark.parametrize("base", [25, 30])
def test_seconds_that_begin_anew_with_the_frames(base: int, tmp_path: Path) -> None:
    """A public logger counts every field of its timecodes to the frames per second."""

    def stamp(count: int) -> str:
        fields = [count // base**power % base for power in (3, 2, 1, 0)]
        return ":".join(f"{field:02d}" for field in fields)

    count = 3 * base * base
    rows = [f"{stamp(1 + n)},1,{n / count:.4f}" for n in range(count)]
    (tmp_path / "a.csv").write_text(lines("Timecode,BlendShapeCount,JawOpen", *rows))
    recording = api.read_recording(tmp_path / "a.csv")
    assert len(recording.stream.frames) == count
    assert recording.stream.fps == base
    assert f"its timecode has {base} seconds in a minute" in recording.assumed


def test_what_python_prints_is_refused_with_the_remedy(tmp_path: Path) -> None:
    (tmp_path / "a.json").write_text(str([{"t": 0.0, "blendshapes": {"jawOpen": 0.5}}]))
    with pytest.raises(FormatError, match=r"json\.dumps"):
        api.read_stream(tmp_path / "a.json")
