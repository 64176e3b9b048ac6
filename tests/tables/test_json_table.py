"""JSON documents say what they are; their cells are checked like those of other tables."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from risorius.errors import FormatError
from risorius.tables import read_json


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("", "a: is not valid JSON: Expecting value: line 1"),
        ("[1]", "must be an object"),
        ('{"format": "tea"}', 'key format: must be an object with "format": "soup", "version": 1'),
        ('{"format": "soup", "version": 2}', 'key format: must be an object with "format": "soup", "version": 1'),
        ("[" * 100_000, "is not valid JSON"),
    ],
)
def test_other_documents_are_refused(text: str, told: str, tmp_path: Path) -> None:
    (tmp_path / "a").write_text(text)
    with pytest.raises(FormatError, match=told):
        read_json(tmp_path / "a", kind="soup", version=1)


def test_a_document_is_read(tmp_path: Path) -> None:
    (tmp_path / "a").write_text(json.dumps({"format": "soup", "version": 1, "hot": True, "in": {"salt": "much"}}))
    document = read_json(tmp_path / "a", kind="soup", version=1)
    assert document.flag("hot")
    with pytest.raises(FormatError, match=r"a, key in\.salt: must be a number, but it is 'much'"):
        document.table("in").number("salt")
    with pytest.raises(FormatError, match=r"a, key hot: must be a table$"):
        document.table("hot")
