"""Single bits, the most significant first."""

from __future__ import annotations

import numpy as np


class EndOfBits(Exception):
    """More bits were asked for than there are; the decoder turns it into a FormatError."""


class BitWriter:
    """Bits that become bytes."""

    def __init__(self) -> None:
        self._bits = bytearray()

    def __len__(self) -> int:
        """How many bits have been written."""
        return len(self._bits)

    def put(self, value: int, count: int = 1) -> None:
        """Append a number's lowest bits."""
        for shift in range(count - 1, -1, -1):
            self._bits.append(value >> shift & 1)

    def align(self) -> None:
        """0, then 1s up to the next byte: a whole byte where the bits are aligned already."""
        self.put(0)
        while len(self._bits) % 8:
            self.put(1)

    def start_code(self, code: int) -> None:
        """Append 32 bits on a byte's border."""
        self.align()
        self.put(code, 32)

    def data(self) -> bytes:
        """All bits; zeros fill the last byte."""
        return np.packbits(np.frombuffer(bytes(self._bits), dtype=np.uint8)).tobytes()


class BitReader:
    """Bits of bytes; `position` may be set."""

    def __init__(self, data: bytes) -> None:
        self.data = data
        self._bits = np.unpackbits(np.frombuffer(data, dtype=np.uint8)).tobytes()
        self.position = 0

    @property
    def byte(self) -> int:
        """Offset of the byte that is read next."""
        return self.position // 8

    def get(self, count: int = 1) -> int:
        """The next bits as a number.

        Raises
        ------
        EndOfBits : there are not so many.
        """
        end = self.position + count
        if end > len(self._bits):
            raise EndOfBits
        value = 0
        for bit in self._bits[self.position : end]:
            value = value << 1 | bit
        self.position = end
        return value

    def at(self, position: int) -> int:
        """The bit at a place; 0 behind the end, where an arithmetic decoder looks ahead."""
        return self._bits[position] if position < len(self._bits) else 0

    @property
    def overrun(self) -> bool:
        """Whether the position lies behind the last bit."""
        return self.position > len(self._bits)

    def take_start_code(self, codes: frozenset[int]) -> int | None:
        """Go past an alignment and a start code, if that is what comes next; else stay."""
        border = self.position // 8 + 1
        padding = self._bits[self.position : 8 * border]
        code = int.from_bytes(self.data[border : border + 4])
        if padding != b"\0" + b"\1" * (len(padding) - 1) or code not in codes or len(self.data) < border + 4:
            return None
        self.position = 8 * (border + 4)
        return code

    def seek_start_code(self, codes: frozenset[int]) -> bool:
        """Go on to the byte before the next start code's; False, and to the end, where there is none."""
        places = [self.data.find(code.to_bytes(4), self.byte) for code in codes]
        found = [place for place in places if place >= 0]
        self.position = 8 * (min(found) if found else len(self.data))
        return bool(found)
