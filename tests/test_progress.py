"""Long work: it says how far it is, returns its result, becomes a share of larger work, and can be cancelled."""

from __future__ import annotations

import math

import pytest
from risorius.errors import ParameterError
from risorius.progress import Progress, Work, part_of, run, stepwise, worked_out


def counting(ended: list[str]) -> Work[str]:
    """Three steps; says where it was cancelled."""
    try:
        for number in range(3):
            yield Progress(number / 2, f"step {number}")
    except GeneratorExit:
        ended.append("cancelled")
        raise
    return "done"


def test_run_gives_the_result_and_tells_every_step() -> None:
    told: list[Progress] = []
    assert run(counting([]), told.append) == run(counting([])) == "done"
    assert told == [(0.0, "step 0"), (0.5, "step 1"), (1.0, "step 2")]


def test_part_of_scales_the_share_and_passes_on_the_result() -> None:
    def larger() -> Work[str]:
        return (yield from part_of(counting([]), 0.2, 0.4))

    told: list[Progress] = []
    assert run(larger(), told.append) == "done"
    assert [step.fraction for step in told] == pytest.approx([0.2, 0.3, 0.4])


def test_closing_the_larger_work_cancels_its_part() -> None:
    ended: list[str] = []
    work = part_of(counting(ended), 0.0, 0.5)
    next(work)
    work.close()
    assert ended == ["cancelled"]


@pytest.mark.parametrize("fraction", [-0.01, 1.01, math.inf])
def test_a_share_lies_between_nothing_and_all(fraction: float) -> None:
    with pytest.raises(ParameterError, match="fraction must be in"):
        Progress(fraction, "too far")


def test_counted_things_say_how_many_there_are() -> None:
    assert Progress.counted(3, 4, "frames") == (0.75, "3 of 4 frames")
    assert Progress.counted(0, 0, "frames") == (1.0, "0 of 0 frames")
    endless = Progress.counted(3, None, "pictures")
    assert math.isnan(endless.fraction)
    assert endless.text == "3 pictures"


class Counted:
    """Works out one property, and counts how often it has begun to."""

    begun = 0

    @stepwise
    def result(self) -> Work[str]:
        """Done in two steps."""
        self.begun += 1
        yield Progress(0.0, "first")
        yield Progress(0.5, "second")
        return "done"


def test_a_stepwise_property_is_worked_out_once_at_once_or_bit_by_bit() -> None:
    whole, slow = Counted(), Counted()
    assert (whole.result, whole.result, whole.begun) == ("done", "done", 1)
    assert [step.text for step in worked_out(slow, "result")] == ["first", "second"]
    assert not list(worked_out(slow, "result"))
    assert (slow.result, slow.begun) == ("done", 1)


def test_a_stepwise_property_that_was_cancelled_is_worked_out_anew() -> None:
    counted = Counted()
    work = worked_out(counted, "result")
    next(work)
    work.close()
    assert (counted.result, counted.begun) == ("done", 2)
