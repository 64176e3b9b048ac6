"""Sound files of every kind, in a few lines each, and the shared samples where they are."""

from __future__ import annotations

import io
import json
import tempfile
import wave
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import risorius.api as api
from places import PRESETS, shared_folder

#: Bytes of a shared sample that are taken: its beginning is like the rest.
TAKEN = 20_000
COUNT = range(5)


def written(suffix: str, write: Callable[[Path], object]) -> bytes:
    """What a writer writes."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"seed{suffix}"
        write(path)
        return path.read_bytes()


@cache
def stream() -> api.FapStream:
    """A second of speech and feeling."""
    frames = api.sequence([api.Cue(api.expression("joy"), onset=0.3, apex=0.3, offset=0.4)], fps=10.0)
    frames[:, 2] = np.linspace(0.0, 400.0, len(frames))
    visemes = {2: api.VisemeField(1, 5, 30)}
    return api.FapStream(frames, fps=10.0, visemes=visemes, expressions={1: api.ExpressionField(1, 40, 2, 10)})


def streams() -> dict[str, bytes]:
    """Files of FAPs over time, of every format, and recordings of every tracker."""
    found = {
        "stream.fap": written(".fap", lambda path: api.write_fap(path, stream())),
        "stream.fba": written(".fba", lambda path: api.write_fba(path, stream())),
        "stream.json": written(".json", lambda path: api.write_fap_json(path, stream())),
        "faps.csv": written(".csv", lambda path: api.write_fap_csv(path, stream())),
    }
    found |= {f"{name}.json": json.dumps(layout).encode() for name, layout in layouts().items()}
    found |= {f"{name}.txt": "\n".join(lines).encode() for name, lines in tables().items()}
    return found | shared("trackers", "csv") | shared("fap", "fap")


def layouts() -> dict[str, Any]:
    """JSON of trackers."""

    def faces(n: int) -> list[dict[str, Any]]:
        return [{"categories": [{"index": 25, "score": n / 10, "categoryName": "jawOpen"}], "headIndex": -1}]

    return {
        "results": [{"timestamp_ms": 40 * n, "results": {"faceBlendshapes": faces(n)}} for n in COUNT],
        "keys": {str(n): {"faceBlendshapes": faces(n)} for n in COUNT},
        "top": [{"timestamp": 0.04 * n, "jawOpen": n / 10, "HeadYaw": 0.1} for n in COUNT],
        "lists": {"fps": 25, "blendshapes": {"jawOpen": [n / 10 for n in COUNT], "eyeBlinkLeft": [0.0] * 5}},
        "audio2face": {
            "exportFps": 25.0, "numPoses": 2, "numFrames": 5, "facsNames": ["browInnerUp", "jawOpen"],
            "weightMat": [[0.0, n / 10] for n in COUNT],
        },
        "columns": {"columns": ["timestamp", "jawOpen"], "data": [[0.04 * n, n / 10] for n in COUNT]},
        "names": {"fps": 25, "names": ["jawOpen", "eyeBlinkLeft"], "frames": [[n / 10, 0.0] for n in COUNT]},
        "timecodes": [{"timecode": f"01:00:00:{n:02d}", "weights": {"jawOpen": n / 10}} for n in COUNT],
        "dates": [{"time": f"2024-01-01T00:00:00.{n}00Z", "weights": {"jawOpen": n / 10}} for n in COUNT],
        "two": [{"time": 0.04 * n, "landmarks": points()} for n in range(2)],
    }  # fmt: skip


def points() -> list[list[float]]:
    """Landmarks without a face in them."""
    found: list[list[float]] = np.random.default_rng(0).normal(0.5, 0.1, (478, 3)).round(3).tolist()
    return found


def tables() -> dict[str, list[str]]:
    """Lines of trackers' tables and logs."""
    names = ("jawOpen", "eyeBlink_L", "eyeBlink_R", "browInnerUp", "mouthSmile_L")
    mocap = ["|".join(f"{name}-{10 * n}" for name in names) + "|=head#1.5,-2.5,3.0,0.1,0.2,0.3|" for n in COUNT]
    pose = "frame, face_id, timestamp, confidence, success, pose_Rx, gaze_0_x, gaze_0_y, gaze_0_z, AU12_r, AU12_c"
    return {
        "openface": [pose, *(f"{n + 1}, 0, {0.04 * n:.3f}, 0.98, 1, 0.1, 0.1, 0.1, -0.9, {n / 2}, 1" for n in COUNT)],
        "pyfeat": ["frame,AU01,AU12,Pitch,Roll,Yaw", *(f"{n},0.{n},0.5,1,2,3" for n in COUNT)],
        "arkit": [
            "Timecode,BlendShapeCount,EyeBlinkLeft,JawOpen,HeadYaw,HeadPitch",
            *(f"16:07:21:{30 + n}.{n},4,0.1,0.{n},0.1,0.2" for n in COUNT),
        ],
        "milliseconds": ["timestamp_ms,jawOpen,eyeBlinkLeft", *(f"{40 * n},0.{n},0" for n in COUNT)],
        "german": ["Zeit;jawOpen;eyeBlinkLeft", *(f"0,{4 * n:02d};0,{n};0,0" for n in COUNT)],
        "audio2face": [",timeCode,blendShapes.JawOpen", *(f"{n},{n / 30:.6f},{n / 10}" for n in COUNT)],
        "facecap": [
            "info,Face Cap,1.0", "bs,browInnerUp,jawOpen,eyeBlink_L",
            *(f"k,{1000 + 17 * n},0,0,0,1,2,3,0,0,0,0,0,{n / 10},0" for n in COUNT),
        ],
        "ifacialmocap": mocap,
        "timed": [f"{0.02 * n:.2f} {line}" for n, line in enumerate(mocap)],
        "vmc": [
            line for n in COUNT for line in (
                f"/VMC/Ext/T ,f {0.04 * n:.2f}", f'/VMC/Ext/Blend/Val ,sf "jawOpen" {n / 10}', "/VMC/Ext/Blend/Apply",
            )
        ],
        "landmarks": [
            "frame,landmark,x,y,z",
            *(f"{f},{n},{x},{y},{z}" for f in range(2) for n, (x, y, z) in enumerate(points())),
        ],
    }  # fmt: skip


def timings() -> dict[str, bytes]:
    """What aligners and lip-sync tools write."""
    cues = [(0.0, 0.2, "X"), (0.2, 0.35, "A"), (0.35, 0.8, "D"), (0.8, 1.0, "X")]
    rows = "".join(f'<mouthCue start="{s}" end="{e}">{v}</mouthCue>' for s, e, v in cues)
    head = '<?xml version="1.0" encoding="utf-8"?><rhubarbResult><metadata><duration>1.00</duration></metadata>'
    documents: dict[str, Any] = {
        "rhubarb": {
            "metadata": {"duration": 1.0}, "mouthCues": [{"start": s, "end": e, "value": v} for s, e, v in cues],
        },
        "list": [{"start": 0.1, "end": 0.2, "phoneme": "p"}, {"start": 0.2, "end": 0.45, "phoneme": "a"}],
        "durations": {"phonemes": [{"start": 0.1, "duration": 0.1, "phoneme": "p"}]},
        "aligner": {"start": 0, "end": 0.5, "tiers": {
            "anna - words": {"type": "interval", "entries": [[0.1, 0.45, "pa"]]},
            "anna - phones": {"type": "interval", "entries": [[0, 0.1, ""], [0.1, 0.2, "p"], [0.2, 0.45, "a"]]},
        }},
        "gentle": {"words": [{"word": "pa", "start": 0.1, "end": 0.45, "phones": [{"phone": "p_B", "duration": 0.1}]}]},
    }  # fmt: skip
    texts = {
        "rhubarb.xml": f"{head}<mouthCues>{rows}</mouthCues></rhubarbResult>",
        "rhubarb.tsv": "".join(f"{s}\t{v}\n" for s, _, v in cues),
        "marks.json": '{"time":100,"type":"viseme","value":"p"}\n{"time":200,"type":"viseme","value":"sil"}\n',
        "audacity.txt": "0.10\t0.20\tp\n0.20\t0.45\ta\n",
        "htk.lab": "1000000 2000000 p\n2000000 4500000 a\n",
        "timit.phn": "1600 3200 p\n3200 7200 aa\n",
        "aligned.csv": "Begin,End,Label,Type,Speaker\n0.1,0.45,pa,words,anna\n0.1,0.2,p,phones,anna\n",
        "milliseconds.csv": "start_ms,end_ms,phoneme\n100,200,p\n200,450,a\n",
        "visemes.csv": "start,end,viseme\n0.1,0.2,1\n0.2,0.4,10\n",
        "short.TextGrid": TEXTGRID_SHORT,
        "long.TextGrid": TEXTGRID_LONG,
    }
    found = {name: text.encode() for name, text in texts.items()}
    found |= {f"{name}.json": json.dumps(document).encode() for name, document in documents.items()}
    spoken = api.FapStream(np.full((5, 68), np.nan), fps=10.0, visemes={n: api.VisemeField(n % 3) for n in range(5)})
    found["visemes.fap"] = written(".fap", lambda path: api.write_fap(path, spoken))
    found["sound.wav"] = _sound()
    return found | shared("speech", "TextGrid") | shared("speech", "json", whole=True)


TEXTGRID_SHORT = (
    'File type = "ooTextFile"\nObject class = "TextGrid"\n\n0\n0.5\n<exists>\n1\n"IntervalTier"\n"phones"\n0\n0.5\n3\n'
    '0\n0.1\n""\n0.1\n0.2\n"p"\n0.2\n0.5\n"a"\n'
)
TEXTGRID_LONG = (
    'File type = "ooTextFile"\nObject class = "TextGrid"\n\nxmin = 0\nxmax = 0.5\ntiers? <exists>\nsize = 1\nitem []:\n'
    '    item [1]:\n        class = "IntervalTier"\n        name = "phones"\n        xmin = 0\n        xmax = 0.5\n'
    "        intervals: size = 2\n"
    '        intervals [1]:\n            xmin = 0\n            xmax = 0.2\n            text = "p"\n'
    '        intervals [2]:\n            xmin = 0.2\n            xmax = 0.5\n            text = "a"\n'
)


def _sound() -> bytes:
    """A second of three syllables."""
    times = np.arange(8000) / 8000.0
    samples = 12000.0 * np.sin(2.0 * np.pi * 150.0 * times) * np.sin(3.0 * np.pi * times) ** 2
    held = io.BytesIO()
    with wave.open(held, "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(8000)
        file.writeframes(samples.astype("<i2").tobytes())
    return held.getvalue()


def presets(*names: str) -> dict[str, bytes]:
    """Tables that come with Risorius."""
    return {path.name: path.read_bytes() for name in names for path in sorted(PRESETS.glob(name))}


def shared(room: str, ending: str, *, whole: bool = False) -> dict[str, bytes]:
    """Samples of other people; of tables their beginning, cut at the end of a line."""
    found = {}
    for path in sorted((shared_folder() / "samples" / room).rglob(f"*.{ending}")):
        content = path.read_bytes()
        if len(content) > TAKEN and not whole and ending == "csv":
            content = content[: content.rindex(b"\n", 0, TAKEN) + 1]
        if len(content) <= 3 * TAKEN and "words" not in path.name:
            found[path.name] = content
    return found


def words(texts: Mapping[str, str]) -> dict[str, bytes]:
    """Files by their text."""
    return {name: text.encode() for name, text in texts.items()}
