"""What is known of the faces of the open file while the user works. Nothing of it is saved.

One object holds it all, and another file gets another object: nothing of the last one is left over.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from ..arrays import Floats
from ..scene.live.held_faces import DueLooks, HeldFaces
from ..scene.live.reading import FaceReader, Reading


@dataclass(frozen=True, eq=False)
class Shown:
    """What a preview shows.

    Attributes
    ----------
    contractions : muscle name -> 0..1. paths : (k, T, 3) the skin's ways there, if wanted.
    unmet : what is requested and does not show, in words.
    """

    contractions: Mapping[str, float]
    paths: Floats | None = None
    unmet: tuple[str, ...] = ()


@dataclass
class Previews:
    """The faces that are previewed, by their numbers (`uid_of`).

    Attributes
    ----------
    faces : held ready. due : to be shown next. to_play : to be shown as laid out, once their faces are ready.
    shown : what each shows.
    laid_out : those that show what is laid out at the scene's frame, not what is chosen.
    hidden : those that showed a preview before the file was saved or changed by undo.
    trouble : why the last one could not be shown.
    object_count : how many objects the file had when it was last looked at.
    """

    faces: HeldFaces = field(default_factory=HeldFaces)
    due: DueLooks = field(default_factory=DueLooks)
    to_play: set[int] = field(default_factory=set)
    shown: dict[int, Shown] = field(default_factory=dict)
    laid_out: set[int] = field(default_factory=set)
    hidden: frozenset[int] = frozenset()
    trouble: str = ""
    object_count: int = 0


@dataclass
class ReadFace:
    """The face that a panel reads.

    Attributes
    ----------
    ids : numbers of its object and mesh. reader : holds it ready. reading : the last one.
    trouble : why there is no reading.
    is_stale : whether something has changed since. was_drawn : whether a panel has shown it since.
    last, cost : when it was last read, and how long that took, s.
    """

    ids: tuple[int, int] | None = None
    reader: FaceReader | None = None
    reading: Reading | None = None
    trouble: str = ""
    is_stale: bool = True
    was_drawn: bool = False
    last: float = -float("inf")
    cost: float = 0.0


@dataclass
class Session:
    """All that is known of the open file's faces."""

    previews: Previews = field(default_factory=Previews)
    read: ReadFace = field(default_factory=ReadFace)


_session = Session()


def session() -> Session:
    """The session of the open file."""
    return _session


def begin_session() -> Session:
    """A new session, as when another file is opened; the work of the last one stops."""
    global _session
    _session.previews.faces.stop()
    _session = Session()
    return _session
