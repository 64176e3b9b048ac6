"""Meshes in which no face was found, this session: the next button says so at once instead of searching anew.

A refusal is of exactly what was searched: vertices, polygons, clicks and the topologies that were known. Any of them
changed is another search.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from hashlib import blake2b
from typing import TYPE_CHECKING

import numpy as np

from ...arrays import Floats, Ints

if TYPE_CHECKING:
    from ...face.fit.topologies import Topology

#: So many refusals are kept, the newest.
KEPT = 64

_refusals: dict[str, str] = {}


def search_digest(
    vertices: Floats, arrays: Sequence[Ints], clicks: Mapping[str, Floats], topologies: Sequence[Topology]
) -> str:
    """A name for exactly this search.

    Parameters
    ----------
    vertices : (V, 3) as they are searched.
    arrays : the polygons.
    clicks : name -> (3,) points that are known.
    topologies : known connectivities.
    """
    digest = blake2b(digest_size=16)
    for array in (vertices, *arrays, *(clicks[name] for name in sorted(clicks))):
        digest.update(repr(array.shape).encode())
        digest.update(np.ascontiguousarray(array).tobytes())
    digest.update(repr((sorted(clicks), [(topology.name, topology.digest) for topology in topologies])).encode())
    return digest.hexdigest()


def refusal_of(digest: str) -> str | None:
    """What was said of this search, or None where none was refused."""
    return _refusals.get(digest)


def keep_refusal(digest: str, said: str) -> None:
    """Remember that nothing was found, and in what words it was said."""
    _refusals[digest] = said
    while len(_refusals) > KEPT:
        del _refusals[next(iter(_refusals))]
