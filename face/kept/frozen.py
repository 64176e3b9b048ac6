"""Objects of this package as plain figures and arrays, and back: data alone, so that reading it runs nothing.

What is known is made into a list of nodes that JSON can hold, which name each other by number, and the arrays that they
speak of. Only classes of this package are named, and their objects come back without their constructors being called.
A property that is worked out when it is first asked for (`cached_property`, `stepwise`) is left out where it cannot be
told in this way, such as a tree of places: it will be worked out again.
"""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum
from functools import cached_property
from importlib import import_module
from typing import Any, TypeAlias

import numpy as np
from scipy import sparse

from ...progress import stepwise

#: A node, or the number of one in a list of its own.
Node: TypeAlias = Any

PACKAGE = __name__.removesuffix(".face.kept.frozen")
ROOMS = ("face", "physics", "mpeg4", "polygons")
PLAIN = (type(None), bool, int, float, str)
NUMBERS = "biuf"


class NotPlainError(Exception):
    """A thing that cannot be told in figures and arrays."""


class Frozen:
    """A thing as nodes and arrays; `root` is the node of the thing itself."""

    def __init__(self, thing: object) -> None:
        """Freeze it.

        Raises
        ------
        NotPlainError : it, or something that it cannot do without, is not made of figures and arrays.
        """
        self.nodes: list[Node] = []
        self.arrays: list[Any] = []
        self._numbers: dict[int, int] = {}
        self._held: list[object] = []  # so that no other thing gets the identity of one that is gone
        self.root = self._told(thing)

    def _told(self, thing: Any) -> Node:
        """The node of a thing: itself, or the number of one that is worked out once."""
        if type(thing) in PLAIN:
            return thing
        known = self._numbers.get(id(thing))
        if known is None:
            self._held.append(thing)
            known = self._numbers[id(thing)] = len(self.nodes)
            self.nodes.append(None)
            try:
                self.nodes[known] = self._node(thing)
            except NotPlainError:
                del self._numbers[id(thing)]
                raise
        return [known]

    def _node(self, thing: Any) -> Node:
        """What a thing is made of."""
        if isinstance(thing, np.ndarray | np.generic):
            return self._array(np.asarray(thing), isinstance(thing, np.generic))
        if isinstance(thing, sparse.csr_array | sparse.csc_array):
            parts = [self._told(part) for part in (thing.data, thing.indices, thing.indptr)]
            return ["sparse", thing.format, list(thing.shape), *parts]
        if isinstance(thing, Enum):
            return ["enum", _name(type(thing)), thing.name]
        if type(thing) is dict:
            return ["dict", [[self._told(key), self._told(value)] for key, value in thing.items()]]
        if type(thing) in (tuple, list, set, frozenset):
            return [type(thing).__name__, [self._told(part) for part in thing]]
        if isinstance(thing, tuple):
            return ["named", _name(type(thing)), [self._told(part) for part in thing]]
        return ["object", _name(type(thing)), self._attributes(thing)]

    def _array(self, array: Any, single: bool) -> Node:
        """An array; its axes are kept in the order in which they lie in memory, by which sums are rounded."""
        if array.dtype.kind not in NUMBERS:
            raise NotPlainError(f"an array of {array.dtype}")
        axes = sorted(range(array.ndim), key=lambda axis: (-abs(array.strides[axis]), axis))
        self.arrays.append(np.ascontiguousarray(array.transpose(axes)))
        how = "single" if single else "array" if array.flags.writeable else "fixed"
        return [how, array.dtype.str, [array.shape[axis] for axis in axes], axes, len(self.arrays) - 1]

    def _attributes(self, thing: Any) -> dict[str, Node]:
        """The attributes of an object of this package."""
        if not hasattr(thing, "__dict__"):
            raise NotPlainError(f"a {type(thing).__name__}")
        told = dict[str, Node]()
        for name, value in vars(thing).items():
            try:
                told[name] = self._told(value)
            except NotPlainError as reason:
                if not isinstance(getattr(type(thing), name, None), cached_property | stepwise):
                    raise NotPlainError(f"{type(thing).__name__}.{name}: {reason}") from reason
        return told


def thawed(root: Node, nodes: list[Node], array: Callable[[int, np.dtype[Any], list[int]], Any]) -> Any:
    """The thing that was frozen; `array` gives an array by its number, its type and its shape.

    What does not fit raises one of Python's own errors, such as KeyError, ValueError or AttributeError.
    """
    things = dict[int, Any]()

    def thing(node: Node) -> Any:
        if type(node) in PLAIN:
            return node
        (number,) = node
        if number not in things:
            kind, *rest = nodes[number]
            if kind == "object":
                things[number] = made = object.__new__(_class(rest[0]))
                vars(made).update({name: thing(value) for name, value in rest[1].items()})
            else:
                things[number] = makers[kind](*rest)
        return things[number]

    def numbers(how: str) -> Callable[[str, list[int], list[int], int], Any]:
        def made(dtype: str, shape: list[int], axes: list[int], number: int) -> Any:
            kind = np.dtype(dtype)
            if kind.kind not in NUMBERS:
                raise ValueError(f"not numbers: {dtype}")
            values = array(number, kind, shape).transpose(np.argsort(axes) if axes else None)
            values.flags.writeable = how != "fixed"
            return values[()] if how == "single" else values

        return made

    def matrix(form: str, shape: list[int], *parts: Node) -> Any:
        made = {"csr": sparse.csr_array, "csc": sparse.csc_array}[form](tuple(map(thing, parts)), shape=tuple(shape))
        made.check_format(full_check=True)
        return made

    def several(kind: Callable[[Any], Any]) -> Callable[[list[Node]], Any]:
        return lambda parts: kind(map(thing, parts))

    makers: dict[str, Callable[..., Any]] = {
        **{how: numbers(how) for how in ("array", "fixed", "single")},
        **{kind.__name__: several(kind) for kind in (tuple, list, set, frozenset)},
        "sparse": matrix,
        "enum": lambda name, member: _class(name)[member],
        "dict": lambda pairs: {thing(key): thing(value) for key, value in pairs},
        "named": lambda name, parts: tuple.__new__(_class(name), map(thing, parts)),
    }
    return thing(root)


def _name(kind: type) -> str:
    """The name of a class of this package, from the package on."""
    if not kind.__module__.startswith(PACKAGE + "."):
        raise NotPlainError(f"a {kind.__module__}.{kind.__name__}")
    return f"{kind.__module__.removeprefix(PACKAGE + '.')}:{kind.__qualname__}"


def _class(name: str) -> Any:
    """The class of that name."""
    module, _, own = name.partition(":")
    if module.split(".")[0] not in ROOMS:
        raise ValueError(f"no class of a face: {name}")
    found = getattr(import_module(f"{PACKAGE}.{module}"), own)
    if not isinstance(found, type) or _name(found) != name:
        raise ValueError(f"not a class: {name}")
    return found
