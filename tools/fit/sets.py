"""The sets of heads that are measured and pictured, by name."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

from .hard import hard_heads
from .heads import SharedHeads, TrueHead

SETS: Mapping[str, Callable[[SharedHeads], Iterator[TrueHead]]] = {
    "known": SharedHeads.known,
    "second": SharedHeads.second,
    "hard": hard_heads,
    "reserved": SharedHeads.reserved,
}
