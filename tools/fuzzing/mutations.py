"""What happens to files: bytes, words, numbers, nesting, size and encoding, one to four of them at a time."""

from __future__ import annotations

import random
import re
from collections.abc import Callable

NUMBER = re.compile(rb"-?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")
WORD = re.compile(rb"[A-Za-z_]\w*")
#: Numbers that break what expects others: too large, too small, too long, none.
NUMBERS = (
    b"1e308", b"-1e308", b"1e400", b"1e-320", b"nan", b"NaN", b"inf", b"-Infinity", b"0", b"-0.0", b"-1", b"0.5",
    b"2147483648", b"9223372036854775808", b"-9223372036854775809", b"1" + b"0" * 400, b"9" * 5000, b"1_000", b"0x10",
    b"1,5", b"1e15", b"1e9", b"99999", b"", b"null", b'"7"', b"[]", b"{}", b"true",
)  # fmt: skip
WORDS = (
    b"null", b"true", b"nan", b"", b"\xc3\xa9", b"\xf0\x9f\x98\x80", b"__class__", b"0", b"-", b"a" * 5000, b"[", b'"',
)  # fmt: skip
#: Bytes of a mutated file, at most.
LARGEST_FILE = 5_000_000
#: How deep nesting goes that no file needs.
DEEP = 100_000


def mutated(data: bytes, other: bytes, draw: random.Random) -> bytes:
    """A file with one to four changes; `other` is another file of the kind, of which parts may come."""
    for _ in range(draw.choice((1, 1, 1, 2, 2, 3, 4))):
        change = draw.choice(CHANGES)
        data = (change(data, draw) if change is not _joined else _joined(data, other, draw))[:LARGEST_FILE]
    return data


def _bytes(data: bytes, draw: random.Random) -> bytes:
    """Some bytes are others."""
    changed = bytearray(data)
    for _ in range(draw.randint(1, 8) if data else 0):
        changed[draw.randrange(len(changed))] = draw.choice((0, 0xFF, 0x80, draw.randrange(256)))
    return bytes(changed)


def _number(data: bytes, draw: random.Random) -> bytes:
    """A number is another; sometimes many are."""
    return _replaced(data, NUMBER, NUMBERS, draw)


def _word(data: bytes, draw: random.Random) -> bytes:
    """A word is another, or one of the same file."""
    return _replaced(data, WORD, (*WORDS, *(found[0] for found in WORD.finditer(data[:4000]))), draw)


def _replaced(data: bytes, what: re.Pattern[bytes], by: tuple[bytes, ...], draw: random.Random) -> bytes:
    found = list(what.finditer(data))
    if not found:
        return data
    count = draw.choice((1, 1, 1, 2, min(len(found), 40)))
    for match in sorted(draw.sample(found, min(count, len(found))), key=lambda match: -match.start()):
        data = data[: match.start()] + draw.choice(by) + data[match.end() :]
    return data


def _cut(data: bytes, draw: random.Random) -> bytes:
    """The file ends too early."""
    return data[: draw.randrange(len(data) + 1)]


def _lost(data: bytes, draw: random.Random) -> bytes:
    """A part of the file is missing."""
    begin = draw.randrange(len(data) + 1)
    return data[:begin] + data[begin + draw.randint(1, 40) :]


def _twice(data: bytes, draw: random.Random) -> bytes:
    """A part of the file, or a line of it, stands there again and again."""
    lines = data.splitlines(keepends=True)
    if draw.random() < 0.5 and lines:
        place = draw.randrange(len(lines))
        count = min(draw.choice((2, 2, 50, 3000)), 2 + LARGEST_FILE // len(lines[place]))
        return b"".join([*lines[:place], *[lines[place]] * count, *lines[place + 1 :]])
    begin = draw.randrange(len(data) + 1)
    part = data[begin : begin + draw.randint(1, 200)]
    return data[:begin] + part * draw.choice((2, 2, 20, 500)) + data[begin:]


def _shuffled(data: bytes, draw: random.Random) -> bytes:
    """Two lines change places."""
    lines = data.splitlines(keepends=True)
    if len(lines) > 1:
        one, two = draw.sample(range(len(lines)), 2)
        lines[one], lines[two] = lines[two], lines[one]
    return b"".join(lines)


def _nested(data: bytes, draw: random.Random) -> bytes:
    """Brackets inside brackets inside brackets."""
    deep = draw.choice((50, 2000, DEEP))
    begin, end = draw.choice(((b"[", b"]"), (b'{"a":', b"}"), (b"<a>", b"</a>"), (b"(", b")"), (b"{a=", b"}")))
    place = draw.choice([0, len(data), *(match.start() for match in NUMBER.finditer(data[:4000]))])
    middle = draw.choice((b"", b"1", data))
    return data[:place] + begin * deep + middle + end * draw.choice((deep, 0)) + data[place:]


def _encoded(data: bytes, draw: random.Random) -> bytes:
    """The same text in another encoding, or with other ends of lines."""
    text = data.decode("utf-8", errors="replace")
    return draw.choice((
        lambda: text.encode("utf-16"), lambda: text.encode("utf-16-le"), lambda: text.encode("utf-16-be"),
        lambda: text.encode("utf-32"), lambda: text.encode("latin-1", errors="replace"),
        lambda: b"\xef\xbb\xbf" + data, lambda: data.replace(b"\n", b"\r\n"), lambda: data.replace(b"\n", b"\r"),
        lambda: data.replace(b"\n", "\u2028".encode()), lambda: data.replace(b",", b";"),
        lambda: data.replace(b".", b","), lambda: data.replace(b'"', b"'"),
        lambda: data + b"\x1a", lambda: data.replace(b" ", b"\xc2\xa0"),
    ))()  # fmt: skip


def _foreign(data: bytes, draw: random.Random) -> bytes:
    """Something else altogether."""
    begins = draw.choice((b"PK\3\4", b"\x93NUMPY", b"RIFF0000WAVE", b"\0\0\1\xba", b"<", b"\x89PNG"))
    return draw.choice((b"", b"\0" * 1000, draw.randbytes(300), b"\n" * 5000, begins + data, b"{", b"[]", b"{}"))


def _joined(data: bytes, other: bytes, draw: random.Random) -> bytes:
    """The beginning of one file with the end of another."""
    return data[: draw.randrange(len(data) + 1)] + other[draw.randrange(len(other) + 1) :]


CHANGES: tuple[Callable[..., bytes], ...] = (
    _bytes, _bytes, _number, _number, _number, _word, _word, _cut, _lost, _twice, _shuffled, _nested, _encoded,
    _foreign, _joined,
)  # fmt: skip
