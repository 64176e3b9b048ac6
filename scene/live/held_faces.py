"""The faces that are held ready to be shown, and which of them are due to be shown next."""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import dataclass, field

from ...progress import Progress, Work
from ..bake.target import Target
from ..fingerprint import uid_of
from .live_face import LiveFace

#: Faces that are held ready.
KEPT = 3
#: Seconds without a change after which a face is shown in balance.
REST = 0.3


class HeldFaces:
    """Faces that are held ready, by their numbers (`uid_of`): those that were shown last.

    Getting a face ready takes a second or more, so it is done bit by bit (`prepare`); until it is done no face is
    handed out, so that nothing else is worked out in between.
    """

    def __init__(self) -> None:
        self._faces: OrderedDict[int, LiveFace] = OrderedDict()
        self._work: Work[None] | None = None

    @property
    def has_more(self) -> bool:
        """Whether there is something to be done for a face, once nothing else is due."""
        return any(face.has_more for face in self._faces.values())

    @property
    def is_preparing(self) -> bool:
        """Whether a face is being got ready."""
        return self._work is not None

    @property
    def uids(self) -> tuple[int, ...]:
        """The numbers of the faces."""
        return tuple(self._faces)

    def get(self, uid: int) -> LiveFace | None:
        """The face of this number as it was read, where it is ready."""
        return None if self.is_preparing else self._faces.get(uid)

    def current(self, target: Target, *, glimpse: bool = False) -> LiveFace | None:
        """The face of `target` as it is now, read again where it has changed; None as long as it is not ready.

        At a `glimpse` a face that was looked at closely within `REST` seconds is taken to be as it was, unless its
        meshes have other counts: while a pointer drags, nobody edits them, and a close look takes milliseconds.

        Raises
        ------
        SceneError, ModelError : it cannot be read.
        """
        uid = uid_of(target.obj)
        face = self._faces.get(uid)
        if face is None or not (face.is_of(target, since=REST) if glimpse else face.is_of(target)):
            face = LiveFace(target)
            self.forget(uid)
            self._faces[uid] = face
            while len(self._faces) > KEPT:
                self._faces.popitem(last=False)
            self._work = face.prepare()
        return self.get(uid)

    def prepare(self) -> Progress | None:
        """A share of getting a face ready; None once it is ready.

        Raises
        ------
        RisoriusError : it cannot be.
        """
        step = None if self._work is None else next(self._work, None)
        if step is None:
            self.stop()
        return step

    def go_on(self) -> None:
        """A share of that.

        Raises
        ------
        RisoriusError : it cannot be done, and will not be tried again.
        """
        face = next((face for face in reversed(self._faces.values()) if face.has_more), None)
        if face is not None:
            face.go_on()

    def stop(self) -> None:
        """Get no face ready any more."""
        if self._work is not None:
            self._work.close()
        self._work = None

    def drop(self) -> None:
        """Do no more for any face."""
        self.stop()
        for face in self._faces.values():
            face.drop()

    def forget(self, uid: int) -> None:
        """Let go of a face."""
        self._faces.pop(uid, None)


@dataclass(frozen=True)
class Look:
    """A face that is to be shown: its number, and whether in balance or as a sketch."""

    uid: int
    exact: bool


@dataclass
class DueLooks:
    """Which faces are to be shown: all that were asked for as sketches, then, once nothing is asked, in balance."""

    _asked: list[int] = field(default_factory=list)
    _rough: list[int] = field(default_factory=list)
    _since: float = 0.0

    def __bool__(self) -> bool:
        """Whether any is."""
        return bool(self._asked or self._rough)

    def ask(self, uid: int, now: float) -> None:
        """Show a face soon: what it is to show has changed, at `now` in seconds."""
        self._since = now
        if uid not in self._asked:
            self._asked.append(uid)

    def next(self, now: float) -> Look | None:
        """What to show now; None where it is nothing, or the user's hand does not rest yet."""
        if self._asked:
            return Look(self._asked[0], exact=False)
        if self._rough and now - self._since >= REST:
            return Look(self._rough[0], exact=True)
        return None

    def done(self, look: Look, *, shown: bool) -> None:
        """A look was answered; a sketch that is shown is followed by the face in balance."""
        (self._rough if look.exact else self._asked).remove(look.uid)
        if shown and not look.exact and look.uid not in self._rough:
            self._rough.append(look.uid)

    def clear(self) -> None:
        """Nothing is to be shown any more."""
        self._asked.clear()
        self._rough.clear()
