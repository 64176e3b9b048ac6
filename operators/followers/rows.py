"""What the list *Follows the Face* says of a face: filled by itself, corrected by the user, read by all that bakes."""

from __future__ import annotations

from collections.abc import Iterator

from ...errors import RisoriusError
from ...scene.blender_types import Object as AnyObject
from ...scene.companions import Companion
from ...scene.following.kinds import Follows
from ...scene.following.rows import SLOTS, Row, behind_of, followers_of, of_slots, staying_of
from ..blender_types import Object, Scene
from .props import RISORIUS_PG_follower

#: So many names stand in a message.
NAMED = 6


def rows_of(obj: Object) -> tuple[Row, ...]:
    """The rows of a face's list, each object once; objects that are gone are left out. Cheap."""
    found: dict[AnyObject, Row] = {}
    for row in obj.risorius.face.followers:
        if row.object is not None and row.object != obj:
            found.setdefault(row.object, Row(row.object, Follows[row.follows], row.why_not, row.by_hand))
    for other, follows in _of_slots(obj).items():
        found.setdefault(other, Row(other, follows, by_hand=True))
    return tuple(found.values())


def companions_of(obj: Object) -> tuple[Companion, ...]:
    """The objects that follow a face. What was found by itself and cannot be written to is left out (`left_behind`)."""
    return followers_of(rows_of(obj), make_single_user=obj.risorius.face.make_single_user)


def left_behind(obj: Object) -> tuple[str, ...]:
    """The objects of the list that do not follow, each with the reason."""
    return behind_of(rows_of(obj), make_single_user=obj.risorius.face.make_single_user)


def staying(obj: Object) -> list[AnyObject]:
    """The objects of the list that do not follow: what shows the face shows them, too."""
    return staying_of(rows_of(obj), make_single_user=obj.risorius.face.make_single_user)


def _of_slots(obj: Object) -> dict[AnyObject, Follows]:
    """The objects that properties of single parts name, and how they follow."""
    return of_slots({slot: getattr(obj.risorius.face, slot) for slot in SLOTS})


def take_slots(obj: Object) -> None:
    """A property of a single part was set: the list says so, unless it says more already."""
    named = _of_slots(obj)
    entries = obj.risorius.face.followers
    for index in reversed(range(len(entries))):
        if entries[index].by_part and entries[index].object not in named:
            entries.remove(index)
    for other, follows in named.items():
        row = next((row for row in entries if row.object == other), None)
        if row is None:
            row = entries.add()
            row.by_part = True
        elif not row.by_part and _covers(Follows[row.follows], follows):
            continue
        _set(row, other, follows, by_hand=True)


def _covers(said: Follows, follows: Follows) -> bool:
    """Whether a row that says one way has the other in it."""
    eyes, teeth = {Follows.EYE_L, Follows.EYE_R}, {Follows.TEETH_UPPER, Follows.TEETH_LOWER}
    inside = {Follows.EYES: eyes, Follows.TEETH: teeth, Follows.SEVERAL: eyes | teeth | {Follows.TONGUE}}
    return follows is said or follows in inside.get(said, set())


def _set(row: RISORIUS_PG_follower, obj: AnyObject, follows: Follows, *, why_not: str = "", by_hand: bool) -> None:
    """Write a row."""
    row.name, row.object, row.follows, row.why_not = obj.name, obj, follows.name, why_not
    row.by_hand = by_hand


def refresh(obj: Object, scene: Scene) -> list[str]:
    """Fill the list of a face with feature points: what the user has said stays; returns names of what is new.

    Raises
    ------
    SceneError, ModelError : see `find_followers`.
    """
    from ...scene.following.found import find_followers

    found = find_followers(obj, scene)
    face = obj.risorius.face
    take_slots(obj)
    before = {row.object for row in face.followers}
    for index in reversed(range(len(face.followers))):
        if face.followers[index].object is None or not face.followers[index].by_hand:
            face.followers.remove(index)
    said = {row.object for row in face.followers}
    for follower in found:
        if follower.obj not in said:
            _set(face.followers.add(), follower.obj, follower.follows, why_not=follower.why_not, by_hand=False)
    face.followers_listed = True
    face.follower = max(min(face.follower, len(face.followers) - 1), 0)
    return [follower.obj.name for follower in found if follower.obj not in before]


def list_again(obj: Object, scene: Scene) -> None:
    """Fill the list of a face whose points are new; a character that cannot be looked through stops nothing."""
    if not obj.is_editable:
        return
    try:
        refresh(obj, scene)
    except RisoriusError:
        obj.risorius.face.followers_listed = True


def list_once(obj: Object, scene: Scene) -> None:
    """Fill the list of a face that has feature points, but was never looked about."""
    if not obj.risorius.face.followers_listed:
        list_again(obj, scene)


def forget_list(obj: Object) -> None:
    """The list as before it was filled by itself; what the user has said stays."""
    face = obj.risorius.face
    for index in reversed(range(len(face.followers))):
        if not face.followers[index].by_hand:
            face.followers.remove(index)
    face.followers_listed = False


def following(obj: Object) -> str:
    """What follows the face, to go on with after its points; empty where nothing does."""
    names = [row.obj.name for row in rows_of(obj) if row.follows is not Follows.NONE]
    if not names:
        return ""
    listed = ", ".join(names[:NAMED]) + (" ..." if len(names) > NAMED else "")
    return f"; {len(names)} other objects follow: {listed}" if len(names) > 1 else f"; {listed} follows"


def unlisted(obj: Object, scene: Scene) -> Iterator[str]:
    """Names of objects that seem to follow the face, but are not in its list: they came later."""
    from ...scene.following.found import find_followers

    listed = {row.obj for row in rows_of(obj)}
    try:
        found = find_followers(obj, scene, beside=listed)
    except RisoriusError:
        return
    yield from (follower.obj.name for follower in found)
