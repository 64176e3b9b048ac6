"""One file given to one reader, and what is wrong with what came of it."""

from __future__ import annotations

import random
import time
import traceback
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, is_dataclass
from enum import Enum
from pathlib import Path

import numpy as np
from risorius.errors import RisoriusError
from risorius.mpeg4 import FAP_COUNT

from .mutations import mutated

#: Processor seconds that one file may take.
LONGEST = 10.0
#: Numbers above this are no number of a face, of time, or of a table: squaring them overflows.
LARGEST = 1e150


@dataclass(frozen=True)
class Reader:
    """Something that reads files.

    Attributes
    ----------
    name : for reports. read : reads one and does with it what the product does; returns what is to be finite.
    seeds : name of a file -> its content; its ending is that of all files made of it.
    """

    name: str
    read: Callable[[Path], object]
    seeds: Mapping[str, bytes]

    def file(self, number: int, seed: int) -> tuple[str, bytes]:
        """The name and content of one file; the first ones are the seeds as they stand."""
        names = sorted(self.seeds)
        if number < len(names):
            return names[number], self.seeds[names[number]]
        draw = random.Random(f"{seed} {self.name} {number}")
        name, other = draw.choice(names), draw.choice(names)
        return name, mutated(self.seeds[name], self.seeds[other], draw)


def outcome(reader: Reader, path: Path, *, is_sound: bool = False) -> tuple[str, str]:
    """What came of a file: "read", "refused" or "bad", and of "bad" why."""
    begun = time.process_time()
    try:
        with warnings.catch_warnings(), np.errstate(over="raise", divide="raise", invalid="raise"):
            warnings.simplefilter("error")
            found = reader.read(path)
        wrong, came = flaw(found, reader.name), "read"
    except RisoriusError as error:
        wrong, came = (f"refused a sound file: {error}" if is_sound else ""), "refused"
        if not is_sound and len(str(error)) > 2000:
            wrong = f"a message of {len(str(error))} characters: {str(error)[:200]}"
    except BaseException as error:
        if isinstance(error, KeyboardInterrupt):
            raise
        wrong, came = "".join(traceback.format_exception(error, limit=-6)), "bad"
    took = time.process_time() - begun
    if took > LONGEST:
        wrong = f"took {took:.0f} s"
    return ("bad", wrong) if wrong else (came, "")


def flaw(thing: object, where: str = "", seen: set[int] | None = None) -> str:
    """What is not finite in a thing, its parts and theirs; nothing where all is well. FAPs may be silent (NaN)."""
    seen = set() if seen is None else seen
    if isinstance(thing, bool | str | bytes | Enum | Path | type(None)) or id(thing) in seen:
        return ""
    if isinstance(thing, int | float | np.number | np.ndarray):
        return _unfit(np.asarray(thing), where)
    seen.add(id(thing))
    if isinstance(thing, Mapping):
        parts = [(f"[{key!r}]", value) for key, value in thing.items()]
    elif isinstance(thing, tuple | list | set | frozenset):
        parts = [(f"[{number}]", value) for number, value in enumerate(thing)]
    elif is_dataclass(thing) and not isinstance(thing, type):
        parts = [(f".{field.name}", getattr(thing, field.name)) for field in fields(thing)]
    else:
        return ""
    return next((wrong for name, part in parts if (wrong := flaw(part, where + name, seen))), "")


def _unfit(array: np.ndarray, where: str) -> str:
    """What is wrong with numbers."""
    if array.dtype == object:
        largest = max((abs(value) for value in array.flat if isinstance(value, int)), default=0)
        return f"{where} has numbers as large as {largest:.0e}" if largest > LARGEST else ""
    if array.dtype.kind not in "fiu" or not array.size:
        return ""
    if array.shape[-1:] == (FAP_COUNT,):
        array = np.where(np.isnan(array), 0.0, array)
    if not np.isfinite(array).all():
        return f"{where} has numbers that are not finite"
    return f"{where} has numbers as large as {np.abs(array).max():g}" if np.abs(array).max() > LARGEST else ""
