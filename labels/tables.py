"""Tables of labels: columns with types, units and meanings; as CSV, as Parquet, and described for machines."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import lru_cache
from importlib import import_module
from typing import Any, TypeAlias

import numpy as np

from ..arrays import Bools, Floats, Ints
from ..errors import ParameterError


class Kind(StrEnum):
    """What a column holds, as table schemas call it."""

    INTEGER = "integer"
    NUMBER = "number"
    TEXT = "string"
    FLAG = "boolean"


@dataclass(frozen=True)
class Column:
    """One column.

    Attributes
    ----------
    unit : of its figures; "" where they have none. digits : after the point, of a number.
    """

    name: str
    kind: Kind
    about: str
    unit: str = ""
    digits: int = 6


def parquet_problem() -> str | None:
    """Why tables are written as CSV alone although pyarrow is installed, and the remedy."""
    found = _pyarrow()
    if not isinstance(found, ImportError):
        return None
    if isinstance(found, ModuleNotFoundError) and (found.name or "").partition(".")[0] == "pyarrow":
        return None
    told = str(found).strip().partition("\n")[0]
    return f'labels are CSV alone: pyarrow cannot be loaded ({told}): pip install "risorius[labels]"'


@lru_cache(maxsize=1)
def _pyarrow() -> tuple[Any, Any] | ImportError:
    """pyarrow and its part for Parquet, or why there is none."""
    try:
        return import_module("pyarrow"), import_module("pyarrow.parquet")
    except ImportError as error:
        return error


#: What stands in a column: an array, or texts; NaN and "" where nothing is known.
Values: TypeAlias = Floats | Ints | Bools | Sequence[str]


@dataclass(frozen=True, eq=False)
class Table:
    """Rows under columns.

    Attributes
    ----------
    key : columns that name a row.
    values : column -> its values, rounded as they are written.
    """

    name: str
    about: str
    columns: tuple[Column, ...]
    key: tuple[str, ...]
    values: Mapping[str, Values]

    def __post_init__(self) -> None:
        """Check that every column has as many values, and round them."""
        rounded: dict[str, Values] = {}
        for column in self.columns:
            values = self.values[column.name]
            if column.kind is Kind.NUMBER:
                plain = np.array(values, dtype=np.float64)
                rounded[column.name] = np.asarray(np.round(plain, column.digits) + 0.0, dtype=np.float64)  # no -0
            else:
                rounded[column.name] = values
        lengths = {name: len(values) for name, values in rounded.items()}
        if len(set(lengths.values())) > 1:
            raise ParameterError(f"table {self.name}", "must have as many values in every column", lengths)
        object.__setattr__(self, "values", rounded)

    def __len__(self) -> int:
        return len(self.values[self.columns[0].name])

    def csv_bytes(self) -> bytes:
        """As CSV: UTF-8, a line of names, an empty cell where nothing is known."""
        buffer = io.StringIO(newline="")
        writer = csv.writer(buffer, lineterminator="\n")
        writer.writerow([column.name for column in self.columns])
        writer.writerows(zip(*(_cells(column, self.values[column.name]) for column in self.columns), strict=True))
        return buffer.getvalue().encode("utf-8")

    def parquet_bytes(self) -> bytes | None:
        """As Parquet; None where the package pyarrow is not there, or cannot be loaded (`parquet_problem`)."""
        found = _pyarrow()
        if isinstance(found, ImportError):
            return None
        arrow, parquet = found
        kinds = {
            Kind.INTEGER: arrow.int32(),
            Kind.NUMBER: arrow.float64(),
            Kind.TEXT: arrow.string(),
            Kind.FLAG: arrow.bool_(),
        }
        fields = [
            arrow.field(each.name, kinds[each.kind], metadata={"unit": each.unit, "description": each.about})
            for each in self.columns
        ]
        arrays = [
            arrow.array(_known(self.values[each.name]), field.type)
            for each, field in zip(self.columns, fields, strict=True)
        ]
        buffer = io.BytesIO()
        parquet.write_table(arrow.Table.from_arrays(arrays, schema=arrow.schema(fields)), buffer, compression="zstd")
        return buffer.getvalue()

    def described(self) -> dict[str, object]:
        """The table as a resource of a data package (Table Schema of the Frictionless standards)."""
        fields = [
            {"name": each.name, "type": str(each.kind), "description": each.about}
            | ({"unit": each.unit} if each.unit else {})
            for each in self.columns
        ]
        return {
            "profile": "tabular-data-resource",
            "name": self.name,
            "path": f"{self.name}.csv",
            "format": "csv",
            "mediatype": "text/csv",
            "encoding": "utf-8",
            "description": self.about,
            "schema": {"fields": fields, "primaryKey": list(self.key), "missingValues": [""]},
        }


def _cells(column: Column, values: Values) -> list[str]:
    """Values as text."""
    if column.kind is Kind.NUMBER:
        form = f"%.{column.digits}f"
        return ["" if value != value else form % value for value in np.asarray(values).tolist()]
    if column.kind is Kind.FLAG:
        return ["true" if value else "false" for value in values]
    return [str(value) for value in values]


def _known(values: Values) -> list[object]:
    """Values with None where nothing is known."""
    plain = values.tolist() if isinstance(values, np.ndarray) else list(values)
    return [None if value != value or value == "" else value for value in plain]


def stacked(parts: Sequence[Mapping[str, Values]]) -> dict[str, Values]:
    """Rows of several parts under the same columns, one after another."""
    return {
        name: np.concatenate([np.asarray(part[name]) for part in parts])
        if isinstance(parts[0][name], np.ndarray)
        else [text for part in parts for text in part[name]]
        for name in parts[0]
    }
