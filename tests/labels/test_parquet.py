"""Labels as Parquet, and a pyarrow that cannot be loaded."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest
import risorius.labels.tables as tables
from risorius.labels.tables import Column, Kind, Table, parquet_problem


@pytest.fixture(autouse=True)
def _fresh() -> None:
    """pyarrow is looked for anew."""
    tables._pyarrow.cache_clear()


def table() -> Table:
    """A column of each kind, each with something unknown where it can have that."""
    columns = (
        Column("frame", Kind.INTEGER, "its number"),
        Column("depth", Kind.NUMBER, "how far", "m"),
        Column("word", Kind.TEXT, "what is said"),
        Column("seen", Kind.FLAG, "whether it is"),
    )
    values = {
        "frame": np.array([1, 2]),
        "depth": np.array([0.5, np.nan]),
        "word": ["joy", ""],
        "seen": np.array([True, False]),
    }
    return Table("frames", "of a film", columns, ("frame",), values)


def test_parquet_says_what_csv_says() -> None:
    parquet = pytest.importorskip("pyarrow.parquet", exc_type=ImportError)
    content = table().parquet_bytes()
    assert content is not None
    assert content == table().parquet_bytes()
    read = parquet.read_table(io.BytesIO(content))
    assert read.to_pydict() == {
        "frame": [1, 2],
        "depth": [0.5, None],
        "word": ["joy", None],
        "seen": [True, False],
    }
    assert read.schema.field("depth").metadata == {b"unit": b"m", b"description": b"how far"}
    assert parquet_problem() is None


@pytest.mark.parametrize(
    ("source", "told"),
    [
        ("raise ImportError('pyarrow requires NumPy 2.0 or newer, found 1.26.4')", "requires NumPy 2.0"),
        ("import no_such_module_of_it", "No module named 'no_such_module_of_it'"),
        ("raise ModuleNotFoundError('gone', name='pyarrow')", None),
    ],
)
def test_a_pyarrow_that_cannot_be_loaded_is_told_and_one_that_is_not_there_is_not(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, source: str, told: str | None
) -> None:
    import sys

    (tmp_path / "pyarrow.py").write_text(source)
    monkeypatch.syspath_prepend(tmp_path)
    for name in [name for name in sys.modules if name.partition(".")[0] == "pyarrow"]:
        monkeypatch.delitem(sys.modules, name)
    assert table().parquet_bytes() is None
    problem = parquet_problem()
    if told is None:
        assert problem is None
    else:
        assert problem is not None
        assert told in problem
        assert 'pip install "risorius[labels]"' in problem
    tables._pyarrow.cache_clear()
