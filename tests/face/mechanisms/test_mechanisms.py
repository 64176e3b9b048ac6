"""What each mechanism is for: one measured claim that holds with it and does not hold without it.

Every claim is one figure of a posed face with a limit. The same measurement is made on the face with the mechanism left
out, where it must miss the limit: a claim that would hold anyway cannot stand here.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import pytest
from claims import CLAIMS
from claims.claim import Claim
from risorius.api import Face, Mechanism


@pytest.fixture(scope="module")
def less(any_face: Callable[[str], Face]) -> Callable[[str, Mechanism], Face]:
    """A head without a mechanism, prepared once."""

    @cache
    def build(head: str, mechanism: Mechanism) -> Face:
        return any_face(head).without(mechanism)

    return build


@pytest.mark.parametrize(
    "claim",
    [pytest.param(claim, marks=() if claim.head == "default" else pytest.mark.slow) for claim in CLAIMS],
    ids=lambda claim: f"{claim.mechanism}-{claim.figure.__name__}",
)
def test_it_holds_with_the_mechanism_and_not_without(
    claim: Claim, any_face: Callable[[str], Face], less: Callable[[str, Mechanism], Face]
) -> None:
    assert claim.figure(any_face(claim.head)) > claim.limit
    assert not claim.figure(less(claim.head, claim.mechanism)) > claim.limit


def test_every_mechanism_has_a_claim() -> None:
    assert {claim.mechanism for claim in CLAIMS} == set(Mechanism)
