"""What a face makes of FAPs, held to scanned expressions: on the scanned head, and on other people's."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from faithful.figures import scans_explained


@pytest.fixture(scope="module")
def explained(shared: Path) -> Iterator[Callable[[str], dict[str, float]]]:
    """Shape -> share of its motion that the pose from its FAPs explains, by head."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("RISORIUS_SHARED", str(shared))
        yield cache(scans_explained)


@pytest.mark.slow
def test_scanned_expressions_come_back_from_their_faps(explained: Callable[[str], dict[str, float]]) -> None:
    shares = explained("ict")
    assert len(shares) == 15
    assert np.median(list(shares.values())) >= 0.88, shares
    assert min(shares.values()) >= 0.6, shares


@pytest.mark.slow
@pytest.mark.parametrize("identity", ["identity-0", "identity-3"])
def test_other_people_make_the_same_faces(explained: Callable[[str], dict[str, float]], identity: str) -> None:
    scanned, other = explained("ict"), explained(identity)
    assert np.median(list(other.values())) >= np.median(list(scanned.values())) - 0.02, other
    assert min(other.values()) >= 0.6, other
