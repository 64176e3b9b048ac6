"""What is read, and what is done with what was read: as the product does it, up to figures that can be checked."""

from __future__ import annotations

import contextlib
import hashlib
import importlib.util
import io
from pathlib import Path

import numpy as np
import risorius.api as api
from risorius.cli.exports import _controls_of
from risorius.errors import RisoriusError
from risorius.face.default_head.figures import read_figures
from risorius.face.kept.entries import DIGEST, MARK, Entries
from risorius.face.muscles.table import read_muscles
from risorius.face.products.crease_table import read_creases
from risorius.face.response.folds import read_folds
from risorius.mpeg4.emotions.prototypes import TABLE, load_prototypes
from risorius.mpeg4.preset_file import read_preset
from risorius.mpeg4.variation import load_habits
from risorius.physics.tissue import load_tissues
from risorius.polygons import PolygonTable
from risorius.progress import run
from risorius.track.confidence_file import COLUMNS, read_confidence

from . import seeds
from .attempts import Reader
from .batches import batch_readers

#: Frames up to which a stream is written again.
WRITTEN = 2000


def readers() -> list[Reader]:
    """All readers that there are here: with Blender's module, those of what lies in a .blend, too."""
    found = [
        Reader("stream", stream, seeds.streams()),
        Reader("timings", timings, seeds.timings()),
        Reader("mesh", mesh, _meshes()),
        Reader("points", lambda path: dict(api.read_point_file(path)), _points()),
        Reader("tables", lambda path: vars(api.read_animation_tables(path)), _animation_tables()),
        Reader("shapes", shapes, _shapes()),
        Reader("confidence", read_confidence, _confidence()),
        Reader("emotions", emotions, seeds.presets("emotions/*.toml")),
        Reader("timeline", timeline, _presets()),
        Reader("habits", load_habits, seeds.presets("variation.toml")),
        Reader("timing", lambda path: dict(api.load_timings(path)), seeds.presets("timing.toml")),
        Reader("capture", lambda path: dict(api.load_shapes(path)), seeds.presets("capture/arkit.toml")),
        Reader("keys", lambda path: dict(api.load_key_names(path)), seeds.presets("capture/keys/*.toml")),
        Reader("topology", topology, seeds.presets("topologies/default_head.toml", "topologies/mediapipe_468.toml")),
        Reader("kept", kept, _kept()),
        Reader("tissue", lambda path: dict(load_tissues(path)), seeds.presets("tissue.toml")),
        Reader("muscles", read_muscles, seeds.presets("anatomy/muscles/*.toml")),
        Reader("folds", read_folds, seeds.presets("anatomy/folds.toml")),
        Reader("creases", read_creases, seeds.presets("anatomy/creases.toml")),
        Reader("ways", lambda path: dict(load_prototypes(path)), _ways()),
        Reader("head_figures", read_figures, seeds.presets("heads/default.toml")),
        *batch_readers(),
    ]
    if importlib.util.find_spec("bpy") is not None:
        from .blend import blend_readers

        found += blend_readers()
    return found


def stream(path: Path) -> object:
    """A recording, played, and written in every format."""
    found = api.read_recording(path)
    played, said = found.played()
    assert all(isinstance(line, str) for line in (*said, *found.assumed))
    stated = np.where(np.isnan(played), 0.0, played)
    if len(played) <= WRITTEN:
        again = path.with_name("again.json")
        api.write_stream(again, found.stream)
        back = api.read_stream(again)
        assert np.array_equal(back.frames, found.stream.frames, equal_nan=True), "JSON does not keep the stream"
    return found, stated


def timings(path: Path) -> object:
    """What is said, as motion of a mouth."""
    found = api.read_timings(path)
    saying = api.say(found) if found.duration < 60.0 else None
    return found, saying


def mesh(path: Path) -> object:
    """A mesh, as a face takes it; most of them are no heads."""
    found = api.read_mesh(path)
    with contextlib.suppress(RisoriusError):
        api.Face.from_arrays(found.vertices, found.polygons, {"9.3": 0, "8.4": 1, "8.3": 2})
    return found


def shapes(path: Path) -> object:
    """Shape keys as `export shapes` writes them, of a face of three vertices."""

    class Small:
        vertices = np.zeros((3, 3))

    return vars(_controls_of(path, Small()))  # type: ignore[arg-type]


def emotions(path: Path) -> object:
    """A vocabulary, each word as an expression of its own."""
    words = api.load_emotions([path], bundled=False)
    return dict(words)


def timeline(path: Path) -> object:
    """A preset and what it plays."""
    preset = read_preset(path)
    profiles = [choice.profile() for choice in (preset.emotion, *(clip.emotion for clip in preset.clips)) if choice]
    cues = [
        api.Cue(clip.emotion.profile(), onset=clip.onset, apex=clip.apex, offset=clip.offset, start=clip.start,
                peak=clip.peak, ramp=clip.ramp, seed=clip.emotion.seed or None)
        for clip in preset.clips
    ]  # fmt: skip
    frames = np.nan_to_num(api.sequence(cues, fps=5.0)) if cues else np.zeros(0)
    return preset, [np.nan_to_num(profile.frame()) for profile in profiles], frames


def topology(path: Path) -> object:
    """A topology."""
    return vars(api.read_topology(path))


def kept(path: Path) -> object:
    """A thing kept in a file: as it was, or none; also where the digest fits what somebody else has made of it."""
    content = path.read_bytes()
    begin = len(MARK) + DIGEST
    path.write_bytes(MARK + hashlib.sha256(content[begin:]).digest() + content[begin:])
    found = Entries(path.parent).read(path.stem)
    assert found is None or isinstance(found, dict | list | tuple | int | float | str | bool | np.ndarray), type(found)
    return None


def _meshes() -> dict[str, bytes]:
    """A few meshes in both formats."""
    square = "# square\no square\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1 4/1\nf -4 -3 -2\n"
    arrays = {"vertices": np.random.default_rng(0).normal(size=(6, 3)), "polygons": np.array([[0, 1, 2], [3, 4, 5]])}
    loops = {"vertices": arrays["vertices"], "loops": np.arange(6), "face_sizes": np.array([3, 3])}
    return {"square.obj": square.encode(), "a.npz": _npz(**arrays), "b.npz": _npz(**loops)}


def _npz(**arrays: object) -> bytes:
    held = io.BytesIO()
    np.savez(held, **arrays)  # type: ignore[arg-type]
    return held.getvalue()


def _points() -> dict[str, bytes]:
    return seeds.words({
        "plain.json": '{"8.4": 6207, "3.5": [0.03, -0.1, 0.04]}',
        "told.json": '{"points": {"8.4": 17, "2.1": null}, "no_vertex": ["2.1"], "xyz": {"2.1": [0, 1.5, 2]}}',
    })  # fmt: skip


def _animation_tables() -> dict[str, bytes]:
    return {"tables.json": seeds.written(".json", lambda path: api.write_animation_tables(path, _tables()))}


def _tables() -> api.AnimationTables:
    slopes = np.zeros((2, 2, 3))
    slopes[..., 2] = 1e-5
    table = api.AnimationTable(3, 1e-3, np.array([-100, 0, 100]), np.array([0, 2]), slopes)
    return api.AnimationTables(np.random.default_rng(0).normal(size=(4, 3)), {3: table})


def _shapes() -> dict[str, bytes]:
    return {"keys.npz": _npz(names=np.array(["joy", "a"]), displacement=np.zeros((2, 3, 3)))}


def _confidence() -> dict[str, bytes]:
    rows = [",".join(["frame", *COLUMNS]), *(",".join([name, *["0.5"] * len(COLUMNS)]) for name in ("0", "1", "doubt"))]
    return {"confidence.csv": "\n".join(rows).encode()}


def _presets() -> dict[str, bytes]:
    found = seeds.presets("timelines/*.toml")
    emotion, by_hand = "[emotion]\nangle = 20.5\nactivation = 5.0\nseed = 3\n", "[contractions]\nrisorius_l = 0.5\n"
    found["joy.toml"] = f'risorius = "expression"\n{emotion}{by_hand}'.encode()
    clip = '[[clips]]\nword = "joy"\nactivation = 5.0\nstart = 0.0\nonset = 0.2\napex = 0.2\noffset = 0.3\n'
    return found | {"said.toml": f'risorius = "timeline"\n{clip}{SPEECH}'.encode()}


SPEECH = """[[speech]]
name = "Hello"
start = 0.5
stretch = 1.2

[[speech.words]]
name = "Hello"
start = 0.0
end = 0.4
sounds = ["p", "a"]
visemes = [1, 10]
times = [0.0, 0.1, 0.1, 0.4]
"""


def _ways() -> dict[str, bytes]:
    """Ways of showing emotions."""
    return {TABLE.name: TABLE.read_bytes()}


def _kept() -> dict[str, bytes]:
    """Something of all that faces are made of, in a file whose name is its key."""
    key = "a" * 64
    thing = {
        "numbers": np.arange(30.0).reshape(5, 3, 2).transpose(2, 0, 1), "empty": np.zeros((0, 3)),
        "polygons": PolygonTable.of([[0, 1, 2], [0, 2, 3, 4]]), "pair": (1, 2.5, None, frozenset({"a"})),
    }  # fmt: skip

    def write(path: Path) -> None:
        entries = Entries(path.parent)
        assert run(entries.write(key, thing)), entries.trouble
        (path.parent / f"{key}.face").replace(path)

    return {f"{key}.face": seeds.written(".face", write)}
