"""The arithmetic coder of the FBA bitstream: what goes in comes out, and no start code can appear."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from risorius.mpeg4.streams.fba.arithmetic import LARGEST_TOTAL, LONGEST_ZEROS, Model, SegmentReader, SegmentWriter
from risorius.mpeg4.streams.fba.bits import BitReader, BitWriter, EndOfBits

sizes = st.integers(1, 40) | st.sampled_from([121, 721, 3721])
segments = st.lists(
    st.lists(sizes.flatmap(lambda n: st.tuples(st.just(n), st.integers(0, n - 1))), max_size=40), min_size=1, max_size=8
)


def coded(rows: list[list[tuple[int, int]]], *, fixed: int = 0b101) -> bytes:
    """Segments of (alphabet, symbol), each with three fixed bits behind it."""
    bits, models = BitWriter(), {}
    for row in rows:
        writer = SegmentWriter(bits)
        for size, symbol in row:
            model = models.setdefault(size, Model(size))
            writer.put(model, symbol)
            model.learn(symbol)
        writer.flush()
        bits.put(fixed, 3)
    return bits.data()


def decoded(data: bytes, rows: list[list[tuple[int, int]]]) -> list[tuple[list[int], int]]:
    """The symbols and fixed bits of segments with these alphabets."""
    bits, models, out = BitReader(data), {}, []
    for row in rows:
        reader, symbols = SegmentReader(bits), []
        for size, _ in row:
            model = models.setdefault(size, Model(size))
            symbols.append(reader.get(model))
            model.learn(symbols[-1])
        reader.finish()
        out.append((symbols, bits.get(3)))
    return out


@pytest.mark.slow
@given(segments, st.sampled_from([0b000, 0b101, 0b111]))
def test_segments_survive_with_the_bits_between_them(rows: list[list[tuple[int, int]]], fixed: int) -> None:
    out = decoded(coded(rows, fixed=fixed), rows)
    assert out == [([symbol for _, symbol in row], fixed) for row in rows]


@pytest.mark.parametrize("count", range(1, 60))
def test_runs_of_zeros_are_broken_and_healed(count: int) -> None:
    """The last symbol of a large alphabet, again and again, keeps the interval at its bottom: zero after zero."""
    rows = [[(2048, 2047)] * count, [(2048, 5)] * 3]
    data = coded(rows)
    assert decoded(data, rows) == [([2047] * count, 0b101), ([5] * 3, 0b101)]
    bits = "".join(f"{byte:08b}" for byte in data)
    assert "0" * (LONGEST_ZEROS + 1) not in bits.rstrip("0")


def test_a_rare_symbol_costs_what_its_probability_says() -> None:
    """Entropy: 3000 draws of a skewed source cost no more than a twentieth above it, once it has been learnt."""
    rng = np.random.default_rng(3)
    share = np.array([0.9, 0.05, 0.03, 0.02])
    symbols = rng.choice(4, size=3000, p=share)
    entropy = float(-(share * np.log2(share)).sum()) * len(symbols)
    assert len(coded([[(4, int(symbol)) for symbol in symbols]])) * 8 < 1.05 * entropy


def test_counts_are_halved_before_they_overflow() -> None:
    model = Model(3)
    for _ in range(2 * LARGEST_TOTAL):
        model.learn(0)
    assert model.total == model.counts.sum() <= LARGEST_TOTAL
    assert model.counts.min() >= 1


def test_bits_end_where_they_end() -> None:
    bits = BitReader(b"\xa5")
    assert [bits.get(4), bits.get(4)] == [0xA, 0x5]
    with pytest.raises(EndOfBits):
        bits.get()
    assert bits.at(8) == 0
