"""Faces that are held ready for a preview, and the order in which they are shown."""

from __future__ import annotations

from typing import Any

import bpy
import pytest
from risorius.operators.session import begin_session, session
from risorius.scene.bake.target import Target
from risorius.scene.fingerprint import uid_of
from risorius.scene.head import add_default_head
from risorius.scene.live.held_faces import KEPT, REST, DueLooks, HeldFaces, Look


def ready(faces: HeldFaces, target: Target) -> None:
    """Get a face ready, to the end."""
    assert faces.current(target) is None
    while faces.is_preparing:
        faces.prepare()


def test_sketches_come_first_and_balance_when_the_hand_rests() -> None:
    due = DueLooks()
    assert not due
    due.ask(1, now=10.0)
    due.ask(2, now=10.1)
    due.ask(1, now=10.2)
    for uid in (1, 2):
        assert due.next(now=10.2) == Look(uid, exact=False)
        due.done(Look(uid, exact=False), shown=True)
    assert due.next(now=10.2 + 0.5 * REST) is None
    assert due
    assert due.next(now=10.2 + 2.0 * REST) == Look(1, exact=True)
    due.ask(2, now=20.0)
    assert due.next(now=20.0) == Look(2, exact=False)
    due.done(Look(2, exact=False), shown=False)
    due.done(Look(1, exact=True), shown=True)
    assert due.next(now=30.0) == Look(2, exact=True)
    due.clear()
    assert not due
    assert due.next(now=40.0) is None


def test_a_face_is_handed_out_once_it_is_ready_and_read_again_once_it_has_changed(head: Any) -> None:
    faces, target = HeldFaces(), Target(head)
    ready(faces, target)
    first = faces.current(target)
    assert first is not None
    assert faces.get(uid_of(head)) is first
    assert faces.current(target) is first
    head.data.vertices[0].co.x += 0.001
    assert faces.current(target) is None
    assert faces.get(uid_of(head)) is None
    faces.stop()
    assert faces.current(target) is not first


def test_a_glimpse_sees_counts_and_after_a_while_all_of_a_face(head: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    now = [100.0]
    monkeypatch.setattr("time.monotonic", lambda: now[0])
    faces, target = HeldFaces(), Target(head)
    ready(faces, target)
    first = faces.current(target)
    head.data.vertices[0].co.x += 0.001
    assert faces.current(target, glimpse=True) is first
    now[0] += 2.0 * REST
    assert faces.current(target, glimpse=True) is None
    while faces.is_preparing:
        faces.prepare()
    assert faces.current(target, glimpse=True) is not None
    head.data.vertices.add(1)
    assert faces.current(target, glimpse=True) is None


def test_the_faces_that_were_shown_last_are_held() -> None:
    faces, heads = HeldFaces(), [add_default_head() for _ in range(KEPT + 1)]
    for head in heads:
        ready(faces, Target(head))
    assert faces.uids == tuple(uid_of(head) for head in heads[1:])
    faces.forget(uid_of(heads[1]))
    assert faces.uids == tuple(uid_of(head) for head in heads[2:])


def test_a_new_session_knows_nothing_of_the_last_one(head: Any) -> None:
    old = begin_session()
    old.previews.faces.current(Target(head))
    old.previews.due.ask(uid_of(head), now=0.0)
    old.read.trouble = "none"
    assert old.previews.faces.is_preparing
    new = begin_session()
    assert session() is new
    assert not old.previews.faces.is_preparing
    assert not new.previews.due
    assert not new.previews.faces.uids
    assert new.read.trouble == ""


@pytest.mark.smoke
def test_numbers_of_objects_outlive_undo(head: Any) -> None:
    number = uid_of(head)
    bpy.ops.ed.undo_push(message="start")
    head.location.x = 1.0
    bpy.ops.ed.undo_push(message="moved")
    bpy.ops.ed.undo()
    assert uid_of(bpy.context.object) == number
