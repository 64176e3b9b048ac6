"""Figures of anatomy stand in tables, each once, with unit and source, and code holds only what its algorithms need."""

from __future__ import annotations

import ast
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
import risorius.face
from risorius.errors import FormatError
from risorius.face.figures import ANATOMY, UNITS, Extent, Length, Pair, Share, read_figures
from risorius.tables import read_toml

FACE = Path(risorius.face.__file__).parent

#: Where all figures are anatomy, but for the numbers below.
ROOMS = (".", "mesh", "muscles", "skin", "mechanisms", "response", "bodies", "drive", "drive/natural")

#: Numbers that are no figures: parts of formulas, and what keeps a division from nothing.
FORMULAS = (0.0, 0.5, 1.0, 2.0)
EPSILON = 1e-5

#: What algorithms of the rooms need: steps, tolerances, least counts, shapes of filters, parts of formulas.
OF_ALGORITHMS: dict[str, tuple[float, ...]] = {
    "bodies/contact.py": (0.02e-3,),  # when repeating stops
    "bodies/dental_arch.py": (1.5, 0.5e-3),  # steps of a grid
    "bodies/eyeball.py": (0.9, 0.1, 0.05, 1.02),  # bounds of an arc sine; which vertices are measured
    "bodies/eyeball_surface.py": (0.25e-3, 0.5e-3),  # distance of samples; what is another shell
    "bodies/margins.py": (0.05e-3,),  # what counts as equally near
    "bodies/tongue.py": (0.1,),  # when points are not believed
    "drive/inverse.py": (0.05e-3, 8e-3),  # when the skin is left the rest; when the jaw is taken about its opening
    "drive/lip_middles.py": (4.0,),  # makes the peak of a parabola 1
    "drive/natural/mixture.py": (10.0,),  # a bound that is never met
    "drive/natural/planning.py": (0.01,),  # units that are not worth naming
    "drive/natural/recognition.py": (0.01,),  # shares that are not worth naming
    "drive/plan.py": (0.02, 0.1, 5.0, 0.1),  # when a goal is told as it was asked; when an emotion is against it
    "face.py": (25.0, 25.0, 25.0),  # frames per second
    "figures.py": (1e-3, 1e6, 180.0),  # units
    "long_motion.py": (12.0, 0.1, 3.0, 12.0, 1e-3, 0.7),  # a kernel: how far it reaches; a millimetre; work done
    "mechanisms/bulge.py": (6.0,),  # a triangle's share of a divergence
    "mechanisms/hood.py": (1e-3,),  # what is too faint to be read
    "mechanisms/lids.py": (0.3,),  # shortest lever
    "mesh/checks.py": (0.01, 0.01),  # weight of a row of least squares
    "mesh/head_frame.py": (10.0, 1e-3),  # when axes and points are believed
    "mesh/points.py": (0.02,),  # how far off the surface a point may lie
    "mesh/own_lip.py": (4.0,),  # how far a search goes
    "mesh/sewn.py": (4.0,),  # how far a search goes
    "mesh/sphere.py": (0.8,),  # share of points that a fit keeps
    "mesh/template.py": (1e-3, 3.0),  # a millimetre; smoothing of the warp
    "mesh/weld.py": (1e-3, 1e-4, 0.25),  # how near copies lie; what has no length; when covered polygons are doubles
    "unmet.py": (0.02,),  # what counts as nothing
    "response/actuators.py": (1e-3,),  # a step of a difference
    "response/folds.py": (
        1.3,
        1.4,
        1.75,
        5.0,
        0.1,
        0.1,
        3.0,
        1.5,
    ),  # how coarse a mesh may be; averages over vertices
    "clip_balance.py": (0.2,),  # how far the work has come
    "pose.py": (7.0, 4.0, 5.0),  # which archetypes are explored
    "meeting_lips.py": (1e-4,),  # when lips feel each other
    "reduced_motion.py": (0.8,),  # how far the work has come
    "response/followers.py": (1e-4, 4.0),  # a tie that keeps a matrix regular; a kernel's norm
    "response/recollection.py": (0.02, 0.8, 2e-3, 5.0, 3.0),  # a kernel; how it learns to be trusted
    "response/relaxation.py": (2e-5, 5e-5, 2e-4, 0.25),  # how near a sketch is; how fast corrections shrink
    "response/rotations.py": (3e-5,),  # when an iteration that converges quadratically ends
    "response/sampled.py": (2e-3, 2e-5, 1e-4, 0.25, 1.5),  # how near it comes; how many are tried; a kernel
    "response/rooted.py": (0.02, 1e-3),  # ties that keep matrices regular
    "response/spring_skin.py": (3e-3,),  # when a sheet buckles
    "skin/coarse.py": (
        0.8,
        0.04,
        2.2,
        0.7,
        0.3,
        0.12,
        0.05,
        2.4,
        0.05,
        1e-3,
    ),  # how skin is thinned out; weights of its vertices
    "skin/fine.py": (6.0, 3.5),  # how finely skin is split
    "skin/lines.py": (0.1,),  # which place of a line is nearest
    "skin/outer.py": (3.0,),  # the smooth step
    "skin/stiffness.py": (0.02, 0.25),  # how narrow a triangle counts; the mean of four
}


def numbers_of(path: Path) -> tuple[float, ...]:
    """Every float of a file that is a figure, and every whole number of millimetres, in order."""
    found = []
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        match node:
            case ast.BinOp(left=ast.Constant(value=int() as value), right=ast.Name(id="MM")):
                found.append((node.lineno, node.col_offset, float(value)))
            case ast.Constant(value=float() as value) if value not in FORMULAS and value >= EPSILON:
                found.append((node.lineno, node.col_offset, value))
    return tuple(value for _, _, value in sorted(found))


@pytest.mark.parametrize("room", ROOMS)
def test_code_holds_only_what_its_algorithms_need(room: str) -> None:
    """Add a figure of anatomy to presets/anatomy; add a number here only where no anatomist would know it."""
    for path in sorted((FACE / room).glob("*.py")):
        name = path.relative_to(FACE).as_posix()
        assert numbers_of(path) == OF_ALGORITHMS.get(name, ()), name


def sections() -> set[str]:
    """Every "file.section" of the tables that holds rows with a value."""
    found = set()
    for path in ANATOMY.glob("*.toml"):
        for name, section in read_toml(path).cells.items():
            if isinstance(section, dict) and any("value" in row for row in section.values() if isinstance(row, dict)):
                found.add(f"{path.stem}.{name}")
    return found


def readings() -> list[tuple[str, str]]:
    """The constant and the section of every reading in the code."""
    return [
        reading
        for path in FACE.rglob("*.py")
        for reading in re.findall(r'^(\w+) = read_figures\("([\w.]+)"', path.read_text(encoding="utf-8"), re.M)
    ]


def test_every_section_of_the_tables_is_read_once() -> None:
    assert sorted(section for _, section in readings()) == sorted(sections())
    assert len(sections()) > 30


@pytest.mark.slow
def test_every_figure_of_the_tables_is_used() -> None:
    code = "\n".join(path.read_text(encoding="utf-8") for path in FACE.rglob("*.py"))
    for name, section in readings():
        file, _, part = section.partition(".")
        for figure in set(read_toml(ANATOMY / f"{file}.toml").table(part)) - {"source"}:
            assert re.search(rf"\b{name}\.{figure}\b", code), f"nothing uses {section}.{figure}"


@dataclass(frozen=True)
class Example:
    """A section of a table."""

    far: Length
    part: Share
    span: Pair
    size: Extent
    tie: float
    turn: float


ROWS = {
    "far": ("12", "mm"),
    "part": ("0.25", "1"),
    "span": ("[-3, 4]", "mm"),
    "size": ("[1, 2, 3]", "mm"),
    "tie": ("0.5", "1/mm^2"),
    "turn": ("180", "deg"),
}


def written(folder: Path, old: str = "", new: str = "", *, source: str = "own choice") -> Path:
    """A folder with a table of the rows above, in which one text is exchanged for another."""
    rows = [f'[some.{n}]\nvalue = {v}\nunit = "{u}"\nmeaning = "of {n}"\n' for n, (v, u) in ROWS.items()]
    text = (f'[some]\nsource = "{source}"\n' if source else "") + "\n".join(rows)
    assert text.count(old) >= 1
    (folder / "mine.toml").write_text(text.replace(old, new, 1) if old else text, encoding="utf-8")
    return folder


def test_figures_are_read_in_si_units(tmp_path: Path) -> None:
    read = read_figures("mine.some", Example, written(tmp_path))
    assert (read.far, read.part, read.span, read.tie) == (0.012, 0.25, (-0.003, 0.004), 0.5e6)
    np.testing.assert_allclose(read.size, [1e-3, 2e-3, 3e-3])
    assert read.turn == pytest.approx(np.pi)
    assert set(UNITS) >= {unit for _, unit in ROWS.values()}


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("value = 12", "value = 0", r"some\.far\.value: must be a number above 0"),
        ("value = 12", "value = nan", r"some\.far\.value: must be a number above 0"),
        ("value = 0.25", "value = 1.5", r"some\.part\.value: must be a number from 0 to 1"),
        ("[-3, 4]", "[-3, 4, 5]", r"some\.span\.value: must be 2 finite numbers"),
        ("[1, 2, 3]", "[1, 0, 3]", r"some\.size\.value: must be numbers above 0"),
        ('unit = "deg"', 'unit = "inch"', r"some\.turn\.unit: must be one of 1, mm, .*'inch'"),
        ('unit = "deg"\n', "", r"some\.turn\.unit: is missing"),
        ('meaning = "of tie"\n', "", r"some\.tie\.meaning: is missing"),
        ("[some.tie]", "[some.tee]", r"some\.tee: is unknown: did you mean tie"),
        ('unit = "deg"', 'unit = "deg"\nsauce = "x"', r"some\.turn\.sauce: is unknown: did you mean source"),
        ('source = "own choice"', "", r"some\.far\.source: is missing"),
    ],
)
def test_a_wrong_row_is_refused_by_file_and_key(tmp_path: Path, old: str, new: str, said: str) -> None:
    with pytest.raises(FormatError, match=rf"mine\.toml, key {said}"):
        read_figures("mine.some", Example, written(tmp_path, old, new))


def test_a_missing_row_is_named(tmp_path: Path) -> None:
    text = (written(tmp_path) / "mine.toml").read_text(encoding="utf-8")
    (tmp_path / "short").mkdir()
    (tmp_path / "short" / "mine.toml").write_text(text[: text.index("[some.turn]")], encoding="utf-8")
    with pytest.raises(FormatError, match=r"some\.turn: must be a table: begin it with \[some\.turn\]"):
        read_figures("mine.some", Example, tmp_path / "short")
