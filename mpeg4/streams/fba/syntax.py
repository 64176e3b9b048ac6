"""Start codes, frame rates, time codes and masks of the FBA bitstream."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import IntEnum

from ....arrays import Bools
from ....errors import ParameterError
from ...standard import GROUPS
from .bits import BitReader, BitWriter

SEQUENCE_START, PLANE_START, SEQUENCE_END = 0x000001BA, 0x000001BB, 0x000001B1
OLD_SEQUENCE_START, OLD_PLANE_START = 0x00000101, 0x00000103
PLANE_STARTS = frozenset({PLANE_START, OLD_PLANE_START})
SKIP_BITS, LONGEST_SKIP = 4, 15
SIXTEENTHS = 16  # of a frame per second: the rate's resolution
NTSC = 1000.0 / 1001.0
LARGEST_RATE = 256.0 - 1.0 / SIXTEENTHS
MARKER_EVERY = 4  # FAPs of a group between two marker bits of the limits


class MaskType(IntEnum):
    """What an I frame says of one group's FAPs: which are sent, and what becomes of the others."""

    NONE = 0
    SOME_OTHERS_HELD = 1
    SOME_OTHERS_INTERPOLATED = 2
    ALL = 3


@dataclass(frozen=True)
class Rate:
    """A frame rate as it is coded: whole frames, sixteenths, and whether a thousandth slower."""

    whole: int
    sixteenths: int
    slowed: bool

    @property
    def fps(self) -> float:
        """Frames per second."""
        return (self.whole + self.sixteenths / SIXTEENTHS) * (NTSC if self.slowed else 1.0)

    def write(self, bits: BitWriter) -> None:
        """8 + 4 + 1 bits."""
        bits.put(self.whole, 8)
        bits.put(self.sixteenths, 4)
        bits.put(self.slowed)

    @classmethod
    def read(cls, bits: BitReader) -> Rate:
        """8 + 4 + 1 bits."""
        return cls(bits.get(8), bits.get(4), bool(bits.get()))

    @classmethod
    def nearest(cls, fps: float) -> Rate:
        """The rate that is nearest to frames per second.

        Raises
        ------
        ParameterError : it lies beyond what can be coded.
        """
        if not 1.0 / SIXTEENTHS <= fps <= LARGEST_RATE:
            raise ParameterError("fps", f"must be in {1.0 / SIXTEENTHS}..{LARGEST_RATE} for an FBA stream", fps)
        rates = []
        for slowed in (False, True):
            sixteenths = round(fps * SIXTEENTHS / (NTSC if slowed else 1.0))
            sixteenths = min(max(sixteenths, 1), int(LARGEST_RATE * SIXTEENTHS))
            rates.append(cls(*divmod(sixteenths, SIXTEENTHS), slowed))
        return min(rates, key=lambda rate: abs(rate.fps - fps))


def write_time(bits: BitWriter, seconds: int) -> None:
    """A time code: hours, minutes, a marker, seconds."""
    bits.put(seconds // 3600 % 32, 5)
    bits.put(seconds // 60 % 60, 6)
    bits.put(1)
    bits.put(seconds % 60, 6)


def read_time(bits: BitReader) -> int | None:
    """A time code in seconds; None where its marker is missing."""
    hours, minutes, marker, seconds = bits.get(5), bits.get(6), bits.get(), bits.get(6)
    return 3600 * hours + 60 * minutes + seconds if marker else None


def first_frame_of(seconds: float, fps: float) -> int:
    """The first frame at or after a time; a millionth of a frame is rounding."""
    return math.ceil(seconds * fps - 1e-6)


def write_masks(bits: BitWriter, mask: Bools) -> None:
    """The masks (68,) of all groups; what is not sent is the decoder's to interpolate."""
    for members in GROUPS.values():
        flags = mask[[number - 1 for number in members]]
        kind = MaskType.ALL if flags.all() else MaskType.SOME_OTHERS_INTERPOLATED if flags.any() else MaskType.NONE
        bits.put(1)
        bits.put(kind, 2)
        if kind is MaskType.SOME_OTHERS_INTERPOLATED:
            for flag in flags:
                bits.put(int(flag))


def write_skip(bits: BitWriter, skipped: int) -> None:
    """How many frames are left out: one flag, then counts that are added up."""
    bits.put(int(skipped > 0))
    if skipped:
        full, rest = divmod(skipped, LONGEST_SKIP)
        for count in (*[LONGEST_SKIP] * full, rest):
            bits.put(count, SKIP_BITS)
