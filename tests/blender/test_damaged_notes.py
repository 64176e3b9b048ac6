"""What Risorius keeps in a .blend as text, damaged by somebody else: read, or refused in words."""

from __future__ import annotations

from pathlib import Path

import pytest
from fuzzing.attempts import outcome
from fuzzing.blend import blend_readers


@pytest.mark.slow
@pytest.mark.parametrize("name", [reader.name for reader in blend_readers()])
def test_damaged_notes_are_read_or_refused(name: str, tmp_path: Path) -> None:
    from fuzzing import blend

    for kept in (blend._cube, blend._action):
        kept.cache_clear()  # every test has a file of its own
    reader = next(reader for reader in blend_readers() if reader.name == name)
    for number in range(200):
        file, content = reader.file(number, 0)
        path = tmp_path / file
        path.write_bytes(content)
        came, wrong = outcome(reader, path, is_sound=number == 0)
        assert (came != "bad", wrong) == (True, ""), path.read_bytes()[:500]
