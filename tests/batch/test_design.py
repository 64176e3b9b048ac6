"""Designs: grids, draws and balance, and the tables they stand for."""

from __future__ import annotations

from collections import Counter
from itertools import combinations
from pathlib import Path

import pytest
from risorius.batch.design import Design, Drawn, Kind, read_design, rows_of, write_design
from risorius.batch.table import read_jobs
from risorius.errors import FormatError, ParameterError, RisoriusError

LEVELS = {"emotion": ("joy", "fear", "anger"), "activation": ("3", "5"), "yaw": ("-20", "0", "20", "40")}


def test_a_grid_is_every_cell_as_often() -> None:
    rows = list(rows_of(Design({**LEVELS, "seed": Drawn(0, 9999, True)}, {"size": "64"}, repeats=2)))
    cells = Counter(tuple(row[name] for name in LEVELS) for row in rows)
    assert len(cells) == 24
    assert set(cells.values()) == {2}
    assert len({row["id"] for row in rows}) == 48
    assert {row["size"] for row in rows} == {"64"}


@pytest.mark.parametrize("count", [1, 7, 12, 24, 31, 60])
def test_a_counterbalanced_design_has_every_level_as_often_after_any_number_of_rows(count: int) -> None:
    design = Design({**LEVELS, "seed": Drawn(0, 9999, True)}, {}, Kind.COUNTERBALANCED, count)
    rows = list(rows_of(design))
    assert len(rows) == count
    for name, levels in LEVELS.items():
        times = Counter(row[name] for row in rows)
        counts = [times[level] for level in levels]
        assert max(counts) - min(counts) <= 1, name
    for first, second in combinations(LEVELS, 2):
        times = Counter((row[first], row[second]) for row in rows)
        counts = [times[a, b] for a in LEVELS[first] for b in LEVELS[second]]
        assert max(counts) - min(counts) <= 2, (first, second)


@pytest.mark.parametrize("draw", range(5))
def test_levels_come_as_often_where_pairs_leave_it_open(draw: int) -> None:
    levels = {
        "emotion": ("joy", "fear", "anger", "sad", "disgust"),
        "yaw": tuple(map(str, range(7))),
        "pitch": ("1", "2"),
    }
    for count in (4, 5, 6, 9, 13):
        rows = list(rows_of(Design(levels, {}, Kind.COUNTERBALANCED, count, draw=draw)))
        for name, each in levels.items():
            times = Counter(row[name] for row in rows)
            counts = [times[level] for level in each]
            assert max(counts) - min(counts) <= 1


def test_a_random_design_gives_each_cell_once_before_any_comes_again() -> None:
    rows = list(rows_of(Design({**LEVELS, "pitch": Drawn(-5.0, 5.0, False)}, {}, Kind.RANDOM, 30)))
    cells = [tuple(row[name] for name in LEVELS) for row in rows]
    assert len(set(cells[:24])) == 24
    assert all(-5.0 <= float(row["pitch"]) <= 5.0 for row in rows)
    assert len({row["pitch"] for row in rows}) > 25


@pytest.mark.parametrize("kind", [Kind.RANDOM, Kind.COUNTERBALANCED])
def test_a_longer_design_begins_like_a_shorter_one_and_another_draw_is_another(kind: Kind) -> None:
    factors = {**LEVELS, "seed": Drawn(0, 9999, True)}
    short, long = (list(rows_of(Design(factors, {}, kind, count, draw=3))) for count in (10, 30))
    assert long[:10] == short
    assert list(rows_of(Design(factors, {}, kind, 10, draw=4))) != short


def test_a_line_and_a_file_say_the_same(tmp_path: Path) -> None:
    path = tmp_path / "design.toml"
    path.write_text(
        'kind = "random"\ncount = 9\ndraw = 2\n[factors]\nemotion = ["joy", "fear"]\n'
        "activation = { least = 3, most = 7, steps = 3 }\nyaw = { least = -30, most = 30 }\n"
        'outputs = ["film labels"]\n'
    )
    line = "emotion=joy,fear activation=3..7/3 yaw=-30..30 outputs='film labels' kind=random count=9 draw=2"
    assert list(rows_of(read_design(str(path)))) == list(rows_of(read_design(line)))


def test_the_table_of_a_design_is_read_as_jobs_and_may_grow(tmp_path: Path) -> None:
    (tmp_path / "head.obj").write_text("v 0 0 0\n")
    path = tmp_path / "design.toml"
    text = 'kind="random"\ncount=COUNT\n[factors]\nemotion=["joy","fear"]\nseed={least=0,most=99}\n'
    text += '[constants]\nhead="head.obj"\n'
    path.write_text(text.replace("COUNT", "4"))
    out = tmp_path / "set" / "jobs.csv"
    out.parent.mkdir()
    write_design(read_design(str(path)), out)
    first = read_jobs(out)
    assert not first.problems
    assert [job.inputs["head"] for job in first.jobs] == [tmp_path / "head.obj"] * 4
    path.write_text(text.replace("COUNT", "8"))
    write_design(read_design(str(path)), out)
    assert [job.fingerprint() for job in read_jobs(out).jobs][:4] == [job.fingerprint() for job in first.jobs]
    path.write_text(text.replace("COUNT", "8").replace("joy", "anger"))
    with pytest.raises(FormatError, match="is the table of another design"):
        write_design(read_design(str(path)), out)


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("emotoin=joy", "a factor must be a column"),
        ("id=a", "a factor must be a column"),
        ("kind=grid", "factors must be at least one"),
        ("emotion=joy kind=latin", "kind must be one of grid, random, counterbalanced"),
        ("emotion=joy kind=random", "count must say how many rows"),
        ("emotion=joy count=5", "count must be left out of a grid"),
        ("emotion=joy,fear repeats=2", "must be 2 or fewer, or clips would be the same"),
        ("emotion=joy kind=random count=0", "count must be a whole number"),
        ("emotion", "must be a .toml file, or factor=level"),
        ("emotion=joy emotion=fear", "with each factor once"),
        ("emotion=joy yaw=30..-30", "least must be below most"),
        ("emotion='joy", "quotes in pairs"),
        ("text='Hello, world'", "a text with a comma needs a .toml file"),
        ("emotion=joy,,fear", "no blanks around"),
        ("yaw=1.2.3..4", "numbers in a range"),
        ("emotion=joy seed=0..9 repeats=2000000", "must be 1000000 or fewer"),
        ("no-such.toml", "cannot be read"),
    ],
)
def test_a_wrong_design_is_told(line: str, told: str) -> None:
    with pytest.raises(RisoriusError, match=told.replace(".", r"\.")):
        read_design(line)


def test_a_wrong_file_is_told_with_its_key(tmp_path: Path) -> None:
    path = tmp_path / "design.toml"
    for text, told in (
        ('[factors]\nemotoin = ["joy"]\n', "key factors.emotoin: is unknown: did you mean emotion"),
        ('[factors]\nemotion = "joy"\n', "key factors.emotion: must be a list of levels, or a range"),
        ("[factors]\nyaw = { least = 3, most = 1 }\n", "key factors.yaw.least: must be below most"),
        ('sort = 1\n[factors]\nemotion = ["joy"]\n', "key sort: is unknown"),
        ('count = 3\n[factors]\nemotion = ["joy"]\n', "key count: must be left out of a grid"),
    ):
        path.write_text(text)
        with pytest.raises(FormatError) as error:
            read_design(str(path))
        assert told in str(error.value)


def test_parameters_are_checked() -> None:
    with pytest.raises(ParameterError):
        Design({}, {})


def test_a_design_of_more_cells_than_memory_has_room_for_is_drawn_all_the_same() -> None:
    factors = " ".join(f"{name}=0..30/1000" for name in ("yaw", "pitch", "distance", "onset", "apex", "offset"))
    rows = list(rows_of(read_design(f"emotion=joy,fear {factors} kind=random count=50")))
    assert len({tuple(row.values()) for row in rows}) == 50
    assert rows[:10] == list(rows_of(read_design(f"emotion=joy,fear {factors} kind=random count=10")))


@pytest.mark.parametrize("count", ["9" * 5000, "²", "1e3", "٣", "-1"])
def test_counts_that_are_none_are_refused(count: str) -> None:
    with pytest.raises(ParameterError, match="whole number"):
        read_design(f"emotion=joy,fear seed=0..9 kind=random count={count}")
    with pytest.raises(ParameterError, match="steps must be"):
        read_design(f"emotion=joy,fear yaw=0..9/{'9' * 15} kind=random count=3")
