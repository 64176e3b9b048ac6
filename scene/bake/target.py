"""Where a bake goes, and a preview shows."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from ..blender_types import Object
from ..companions import Companion
from ..faces import FaceSource, read_face
from ..refusals import refuse_unwritable
from ..shape_mix import resting_without


@dataclass(frozen=True)
class Target:
    """The objects of a face.

    Attributes
    ----------
    obj : the head.
    companions : its other objects.
    make_single_user : whether a mesh that other objects share may be made its own.
    left_behind : names of objects that belong to the face, but do not follow it.
    """

    obj: Object
    companions: tuple[Companion, ...] = ()
    make_single_user: bool = False
    left_behind: tuple[str, ...] = ()

    def objects(self) -> list[Object]:
        """The head and its other objects."""
        return [self.obj, *(companion.obj for companion in self.companions)]

    def source(self, *, replacing: Iterable[str] = ()) -> FaceSource:
        """Read the face, refusing what must not be written to; shape keys that are replaced are no part of its rest."""
        self.refuse_unwritable()
        return read_face(self.obj, companions=self.companions, resting=resting_without(replacing))

    def refuse_unwritable(self) -> None:
        """Refuse what must not be written to.

        Raises
        ------
        SceneError : see `refusals`.
        """
        for member in self.objects():
            refuse_unwritable(member, make_single_user=self.make_single_user)

    def refuse_changed(self, source: FaceSource) -> None:
        """Refuse to write what was computed from `source`; to be asked just before.

        Raises
        ------
        SceneError : others have changed or shared an object since it was read.
        """
        self.refuse_unwritable()
        source.refuse_changed()

    def remarks(self) -> tuple[str, ...]:
        """What stays behind, in words."""
        return (f"{self.obj.name}: these stay behind: {', '.join(self.left_behind)}",) if self.left_behind else ()
