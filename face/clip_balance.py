"""The balance of a whole clip: the muscles behind each of its steps, and where these take the skin.

What the springs add is foretold from a few equilibria of the clip (`response.sampled`); jaw, lids, correction and
contact are those of each step. Many steps are worked out together, as products of matrices.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ..errors import SolverError
from ..progress import Progress, Work, part_of
from .drive.plan import Plan
from .posture import Balance, Effort, Postures
from .response.sampled import SampledPull, sampled_pull

#: How far the work of a clip is once its muscles are found.
EFFORTS = 0.2

#: So many steps are worked out together, or as many as have so many figures.
TOGETHER, FIGURES = 16, 2_000_000


@dataclass(frozen=True, eq=False)
class ClipBalance:
    """The balance of T steps of a clip.

    Attributes
    ----------
    efforts : of its steps. pull : the muscles' part of their balances.
    """

    balance: Balance
    efforts: Sequence[Effort]
    pull: SampledPull

    def along(self) -> Iterator[tuple[slice[int, int, None], Postures]]:
        """Postures, some steps at a time, and which steps these are."""
        together = max(1, min(TOGETHER, FIGURES // self.balance.anatomy.skin.positions.size))
        for start in range(0, len(self.efforts), together):
            steps = slice(start, min(start + together, len(self.efforts)))
            yield steps, self._reached(start, self.efforts[steps])

    def _reached(self, start: int, efforts: Sequence[Effort]) -> Postures:
        """Postures of efforts from one step on; what is held for several steps is worked out once."""
        new = [not number or not efforts[number].reached_as(efforts[number - 1]) for number in range(len(efforts))]
        chosen = np.flatnonzero(new)
        postures = self.balance.reached_each(
            [efforts[number] for number in chosen.tolist()], self.pull.at(start + chosen)
        )
        return postures if all(new) else postures.some(np.cumsum(new) - 1)


def clip_balance(balance: Balance, plans: Sequence[Plan]) -> Work[ClipBalance]:
    """What the plans of a clip, one for each step, take of one face.

    Raises
    ------
    ParameterError, SolverError : as `Balance.posture`.
    """
    efforts: list[Effort] = []
    for step, plan in enumerate(plans):
        try:
            efforts.append(balance.effort(plan, before=efforts[-1] if efforts else None))
        except SolverError as error:
            raise error.in_frame(step) from error
        yield Progress(EFFORTS * len(efforts) / len(plans), "Finding the muscles behind the motion")
    amounts = [effort.amounts for effort in efforts]
    pull = yield from part_of(sampled_pull(balance.anatomy.relaxation, amounts), EFFORTS, 1.0)
    return ClipBalance(balance, efforts, pull)
