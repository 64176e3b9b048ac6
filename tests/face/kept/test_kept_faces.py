"""A face that was prepared before is ready at once, and the same."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import risorius.api as api
from risorius.face.kept import faces
from risorius.face.kept.faces import face_key
from risorius.face.preparation import STAGES
from risorius.physics import elastic

JOY = api.expression("joy")


def arrays() -> tuple[Any, Any, Any]:
    """The mesh and the points of the default head."""
    head = api.build_default_head()
    return head.vertices, head.polygons, head.points


@pytest.mark.slow
def test_a_kept_face_is_ready_and_poses_the_same_to_the_last_bit(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = api.KeptFaces(tmp_path).face(*arrays())
    shown = first.sketcher().sketch(JOY.frame(), emotion=JOY.weights).positions
    assert api.KeptFaces(tmp_path).keep(first)

    factored, splu = list[int](), elastic.splu

    def counted(*matrix: Any, **options: Any) -> Any:
        factored.append(1)
        return splu(*matrix, **options)

    monkeypatch.setattr(elastic, "splu", counted)
    kept = api.KeptFaces(tmp_path)
    again = kept.face(*arrays())
    assert again.is_from_file
    sketched = again.sketcher().sketch(JOY.frame(), emotion=JOY.weights).positions
    assert np.abs(sketched - shown).max() < 1e-5
    assert len(factored) <= 1  # of what follows the lips from inside; the skin itself is not solved
    for place in (place for _, place in STAGES if place.startswith("anatomy.") and place.count(".") == 1):
        assert place.partition(".")[2] in vars(again.anatomy), place
    for word in ("joy", "fear"):
        found = [face.pose(api.expression(word).frame()).positions for face in (first, again)]
        assert np.array_equal(*found)
    assert kept.keep(again)  # is kept already
    assert len(list(tmp_path.iterdir())) == 1


def test_another_face_has_another_key(monkeypatch: pytest.MonkeyPatch) -> None:
    from risorius.polygons import PolygonTable

    vertices, table = np.eye(3), PolygonTable.of([[0, 1, 2]])
    keys = [
        face_key(vertices, table, {"2.1": 1}, None, None),
        face_key(vertices + 1e-12, table, {"2.1": 1}, None, None),
        face_key(vertices, PolygonTable.of([[0, 2, 1]]), {"2.1": 1}, None, None),
        face_key(vertices, table, {"2.1": 2}, None, None),
        face_key(vertices, table, {"2.1": vertices[1]}, None, None),
        face_key(vertices, table, {"2.2": 1}, None, None),
        face_key(vertices, table, {"2.1": 1}, [0, 0, 1], None),
        face_key(vertices, table, {"2.1": 1}, None, np.eye(3)),
    ]
    assert len(set(keys)) == len(keys)
    assert face_key(vertices, table, {"2.1": 1}, None, None) == keys[0]
    monkeypatch.setattr(faces, "code_digest", lambda: b"other code")
    assert face_key(vertices, table, {"2.1": 1}, None, None) not in keys


def test_a_face_that_is_of_no_folder_is_not_kept(tmp_path: Path) -> None:
    assert not api.KeptFaces(tmp_path).keep(api.default_face())
    assert not list(tmp_path.iterdir())
