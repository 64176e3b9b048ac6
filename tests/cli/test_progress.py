"""Progress on standard error: a line now and then, none of quick work."""

from __future__ import annotations

import pytest
from risorius.cli import progress
from risorius.cli.progress import ShowProgress
from risorius.progress import Progress


def test_a_line_for_every_so_many_percent(capsys: pytest.CaptureFixture[str]) -> None:
    show = ShowProgress(percent=25)
    for number in range(101):
        show(Progress.counted(number, 100, "frames"))
    said = capsys.readouterr()
    assert said.err.splitlines() == [f"{n:3d} %  {n} of 100 frames" for n in (0, 25, 50, 75, 100)]
    assert said.out == ""


def test_quick_work_says_nothing_and_endless_work_not_too_much(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    now = 100.0
    monkeypatch.setattr(progress.time, "monotonic", lambda: now)
    show = ShowProgress(patience=1.0)
    show(Progress(1.0, "all"))
    assert capsys.readouterr().err == ""
    for number in range(30):
        now = 101.0 + number / 10.0
        show(Progress.counted(number, None, "pictures"))
    assert capsys.readouterr().err.splitlines() == ["0 pictures", "10 pictures", "20 pictures"]
