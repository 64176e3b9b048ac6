"""The adaptive arithmetic coder of the FBA bitstream, after Annex E of H.263 with counts that adapt.

Symbols are coded in segments. A segment never holds more than `LONGEST_ZEROS` zeros in a row: a 1 is stuffed in after
them, so that no start code can appear in it.
"""

from __future__ import annotations

import numpy as np

from .bits import BitReader, BitWriter

TOP, HALF, QUARTER = 65535, 32768, 16384
LONGEST_ZEROS = 22
LARGEST_TOTAL = 16383
CODE_BITS, FLUSH_BITS = 16, 2


class Model:
    """How often each symbol of an alphabet has been met; all equally often at first."""

    def __init__(self, size: int) -> None:
        self.counts = np.ones(size, dtype=np.int64)
        self.total = size

    def bounds(self, symbol: int) -> tuple[int, int]:
        """Cumulative counts (upper, lower) of a symbol; they run downwards."""
        lower = int(self.counts[symbol + 1 :].sum())
        return lower + int(self.counts[symbol]), lower

    def find(self, cumulative: int) -> int:
        """The symbol whose bounds hold a cumulative count."""
        from_last = np.cumsum(self.counts[::-1])
        return len(self.counts) - 1 - int(np.searchsorted(from_last, cumulative, side="right"))

    def learn(self, symbol: int) -> None:
        """Count a symbol."""
        if self.total >= LARGEST_TOTAL:
            self.counts = (self.counts + 1) // 2
            self.total = int(self.counts.sum())
        self.counts[symbol] += 1
        self.total += 1


class _Interval:
    """The coder's interval, which a symbol narrows; writer and reader keep it alike."""

    def __init__(self) -> None:
        self.low, self.high = 0, TOP

    def narrow(self, model: Model, symbol: int) -> None:
        upper, lower = model.bounds(symbol)
        width = self.high - self.low + 1
        self.high = self.low - 1 + width * upper // model.total
        self.low += width * lower // model.total

    def shift(self) -> int | None:
        """What to subtract before the interval is doubled; None where it is wide enough."""
        if self.high < HALF:
            return 0
        if self.low >= HALF:
            return HALF
        if self.low >= QUARTER and self.high < HALF + QUARTER:
            return QUARTER
        return None

    def double(self, offset: int) -> None:
        self.low, self.high = 2 * (self.low - offset), 2 * (self.high - offset) + 1


class SegmentWriter:
    """One segment of symbols; `flush` ends it."""

    def __init__(self, bits: BitWriter) -> None:
        self._bits = bits
        self._interval = _Interval()
        self._pending = 0
        self._zeros = 0

    def put(self, model: Model, symbol: int) -> None:
        """Code one symbol."""
        self._interval.narrow(model, symbol)
        while (offset := self._interval.shift()) is not None:
            if offset == QUARTER:
                self._pending += 1
            else:
                self._emit(int(offset == HALF))
            self._interval.double(offset)

    def flush(self) -> None:
        """Write what tells the last interval."""
        self._pending += 1
        self._emit(int(self._interval.low >= QUARTER))

    def _emit(self, bit: int) -> None:
        """One bit, and all opposite ones that waited for it."""
        for each in (bit, *[1 - bit] * self._pending):
            self._bits.put(each)
            self._zeros = 0 if each else self._zeros + 1
            if self._zeros == LONGEST_ZEROS:
                self._bits.put(1)
                self._zeros = 0
        self._pending = 0


class SegmentReader:
    """One segment of symbols; `finish` puts the bits' position behind it."""

    def __init__(self, bits: BitReader) -> None:
        self._bits = bits
        self._interval = _Interval()
        self._zeros = 0
        self._ends: list[int] = []  # the position behind each bit of the segment, and behind what is stuffed after it
        self._code = 0
        for _ in range(CODE_BITS):
            self._code = 2 * self._code + self._next()

    def get(self, model: Model) -> int:
        """Decode one symbol."""
        interval = self._interval
        width = interval.high - interval.low + 1
        symbol = model.find(((self._code - interval.low + 1) * model.total - 1) // width)
        interval.narrow(model, symbol)
        while (offset := interval.shift()) is not None:
            interval.double(offset)
            self._code = 2 * (self._code - offset) + self._next()
        return symbol

    def finish(self) -> None:
        """Give back what was looked at ahead.

        The writer has put a bit for every doubling and two for the flush; the reader has taken 16 more than doublings.
        """
        self._bits.position = self._ends[len(self._ends) - CODE_BITS + FLUSH_BITS - 1]

    def _next(self) -> int:
        """One bit of the segment, without what is stuffed in."""
        place = self._ends[-1] if self._ends else self._bits.position
        bit = self._bits.at(place)
        self._zeros = 0 if bit else self._zeros + 1
        if self._zeros == LONGEST_ZEROS:
            place += 1
            self._zeros = 0
        self._ends.append(place + 1)
        return bit
