"""The tables of the natural drive: what is wrong with one is named."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
import risorius.api as api
from risorius.errors import FormatError
from risorius.face.drive.natural.symmetry import mirror_fap
from risorius.face.drive.natural.synergies import load_synergies
from risorius.face.figures import ANATOMY

WRONG = {
    "ranges.csv: no column": ("ranges.csv", "low_mm", "lowest", "column low_mm: lacks a column"),
    "ranges.csv: no number": ("ranges.csv", "3,-2.5,", "3,wide,", "number"),
    "ranges.csv: one-sided": ("ranges.csv", "3,-2.5,", "3,2.5,", "below and above 0"),
    "ranges.csv: share": ("ranges.csv", "3,-2.5,32.0,0.8", "3,-2.5,32.0,1.5", "between 0 and 1"),
    "ranges.csv: no FAP": ("ranges.csv", "3,-2.5,", "99,-2.5,", "column fap: must be a whole number from 3 to 68"),
    "synergies.toml: no TOML": ("synergies.toml", "[sums]", "[sums", "TOML"),
    "synergies.toml: not paired": ("synergies.toml", "paired = true", 'paired = "yes"', "paired"),
    "synergies.toml: no amount": ("synergies.toml", "AU12 = 1,", 'AU12 = "much",', "sums.joy.AU12"),
    "synergies.toml: no unit": ("synergies.toml", "AU12 = 1,", "AU99 = 1,", "sums.joy.AU99: names unit AU99"),
    "synergies.toml: no range": ("synergies.toml", "31 = 96", "65 = 96", "names FAP 65, which has no range"),
    "synergies.toml: an angle": ("synergies.toml", "19 = -325", "47 = -325", "units.AU5.faps.47: names FAP 47, which"),
    "synergies.toml: no table": ("synergies.toml", "[hidden]", "[secret]", "hidden"),
}


@pytest.fixture
def spoil(tmp_path: Path) -> Callable[[str, str, str], Path]:
    """A copy of the tables with one text replaced in one file."""

    def make(name: str, old: str, new: str) -> Path:
        for file in ("ranges.csv", "synergies.toml"):
            shutil.copy(ANATOMY / file, tmp_path / file)
        text = (tmp_path / name).read_text(encoding="utf-8")
        assert old in text
        (tmp_path / name).write_text(text.replace(old, new, 1), encoding="utf-8")
        return tmp_path

    return make


@pytest.mark.parametrize("case", WRONG)
def test_a_wrong_table_names_file_and_rule(case: str, spoil: Callable[[str, str, str], Path]) -> None:
    file, old, new, said = WRONG[case]
    with pytest.raises(FormatError) as caught:
        load_synergies(spoil(file, old, new))
    assert file in str(caught.value)
    assert said in str(caught.value)


def test_the_tables_are_whole() -> None:
    data = load_synergies()
    assert {name[:-2] for name in data.sum_names} >= {str(a) for a in api.ARCHETYPES}
    assert (data.low < 0.0).all()
    assert (data.high > 0.0).all()
    for number in data.numbers.tolist():
        row, other = data.row_of[number], data.row_of[mirror_fap(number)]
        assert (data.low[row], data.high[row]) == (data.low[other], data.high[other]), number
