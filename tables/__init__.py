"""Tables on disk, TOML, JSON, CSV and arrays, and the one set of readers for what stands in them.

cells         named cells of one place in a file, each read by the rule that it must keep
keyed_table   tables inside tables, under dotted keys: what TOML and JSON have in common
toml_table    TOML, and how texts and numbers are written in it
json_table    JSON documents that say what they are
json_text     text of JSON as values, within bounds
csv_table     CSV: rows by the names of their columns
array_file    arrays in .npz files

    for row in read_csv(path, "fap", "low_mm", "source"):
        number, low = row.integer("fap", least=1, most=68), row.number("low_mm")

    for name, muscle in read_toml(path).tables("muscles").items():
        kind, prior = muscle.choice("kind", Kind), muscle.number("prior_mm", above=0.0)

A cell that breaks its rule raises a `FormatError` that names the file, the key (TOML, JSON) or the line and column
(CSV), the rule, and what stands there instead.
"""

from .array_file import read_arrays
from .cells import Cells, is_number
from .csv_table import (
    CsvRow,
    csv_text,
    numbered_lines,
    parsed_number,
    read_csv,
    row_cells,
    split_cells,
    table_lines,
    table_text,
    write_csv,
)
from .json_table import checked_document, read_json
from .json_text import large, parsed_json
from .keyed_table import KeyedTable
from .toml_table import TomlTable, read_toml, toml_number, toml_text

__all__ = [
    "Cells",
    "CsvRow",
    "KeyedTable",
    "TomlTable",
    "checked_document",
    "csv_text",
    "is_number",
    "large",
    "numbered_lines",
    "parsed_json",
    "parsed_number",
    "read_arrays",
    "read_csv",
    "read_json",
    "read_toml",
    "row_cells",
    "split_cells",
    "table_lines",
    "table_text",
    "toml_number",
    "toml_text",
    "write_csv",
]
