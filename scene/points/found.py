"""Finding the feature points of an object's mesh, from its shape alone or with a few that are known."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from ...arrays import Floats
from ...errors import ModelError, SceneError
from ...polygons import PolygonTable
from ...progress import Progress, Work, part_of
from .. import mesh as meshes
from ..blender_types import Object, Scene
from ..refusals import refuse_broken_vertices, refuse_unreadable
from ..shape_mix import settle_drivers
from .beside import pieces_beside
from .bound import bind
from .kept import KeptPoints, Origin, triple, write_kept
from .painted import paint_of
from .presets import known_topologies
from .refused import keep_refusal, refusal_of, search_digest


@dataclass(frozen=True)
class Finding:
    """What was found on a mesh.

    Attributes
    ----------
    kept : the points.
    score : how little the mesh looks like a face, 0 at best.
    topology : name of the known topology that it was recognised by, or None.
    unreadable : what is wrong with users' topologies that were passed over.
    """

    kept: KeptPoints
    score: float
    topology: str | None
    unreadable: tuple[str, ...] = ()

    def summary(self, name: str) -> str:
        """A sentence for people."""
        how = f"known as {self.topology}" if self.topology else f"score {self.score:.2f}"
        doubtful = self.kept.doubtful()
        listed = ", ".join(doubtful[:6]) + (" ..." if len(doubtful) > 6 else "")
        look = f"; check {listed}" if doubtful else ""
        sewn = "; the lips are sewn together" if "mouth" in self.kept.sewn else ""
        shut = "; the lids stay shut" if self.kept.sewn - {"mouth"} else ""
        return f"{name}: {len(self.kept.points)} feature points found ({how}){look}{sewn}{shut}"


def find_points(
    obj: Object, clicks: Mapping[str, Floats] | None = None, *, scene: Scene | None = None
) -> Work[Finding]:
    """Find the feature points of `obj` and keep them with its mesh; nothing is written before they are found.

    Parameters and errors as for `seek_points`.
    """
    finding = yield from seek_points(obj, clicks, scene=scene)
    write_kept(obj, finding.kept, as_given=True)
    return finding


def seek_points(
    obj: Object, clicks: Mapping[str, Floats] | None = None, *, scene: Scene | None = None
) -> Work[Finding]:
    """Find the feature points of `obj`, and write nothing.

    Parameters
    ----------
    clicks : name -> (3,) points that are known, in the mesh's own coordinates.
    scene : whose unit scale counts; by default the current one.

    Raises
    ------
    SceneError : see `refusals`; a mesh of another file.
    ModelError : no face in it; states the score, the limit and the remedy.
    """
    from ... import api
    from ...face.fit.clicks import click_place
    from ...face.mesh.building import sewn_among_steps

    yield Progress(0.0, "Reading the mesh")
    refuse_unreadable(obj)
    refuse_broken_vertices(obj)
    settle_drivers([obj])
    stretch = meshes.metres_matrix(obj, scene)
    vertices = meshes.rest_vertices(obj.data) @ stretch.T
    arrays = meshes.polygon_arrays(obj.data)
    known = {name: stretch @ click_place(name, place) for name, place in (clicks or {}).items()}
    topologies, unreadable = known_topologies()
    search = search_digest(vertices, arrays, known, topologies)
    said = refusal_of(search)
    if said is not None:
        raise _explained(obj, ModelError(said))
    try:
        polygons = PolygonTable(*arrays)
        paint = paint_of(obj, stretch)
        beside = pieces_beside(obj, stretch, scene)
        found = yield from api.find_points_steps(
            vertices, polygons, known or None, topologies=topologies, paint=paint, beside=beside
        )
    except ModelError as refusal:
        keep_refusal(search, str(refusal))
        raise _explained(obj, refusal) from refusal
    back = np.linalg.inv(stretch)
    table = {name: triple(back @ place) for name, place in found.positions.items()}
    origin = Origin.FOUND if found.topology is None else Origin.TOPOLOGY
    origins = {name: Origin.CLICKED if name in known else origin for name in table}
    yield Progress(1.0, "Checking lips and lids")
    kept = bind(obj.data, table, origins=origins, confidence=found.confidence)
    yield Progress(1.0, "Checking lips and lids")
    sewn = yield from part_of(sewn_among_steps(vertices, polygons, found.positions), 1.0, 1.0)
    kept = replace(kept, score=0.0 if known else found.score, sewn=sewn)
    return Finding(kept, found.score, found.topology, unreadable)


def _explained(obj: Object, refusal: ModelError) -> ModelError | SceneError:
    """The refusal, with what Blender knows of a mesh that is half a face."""
    if any(modifier.type == "MIRROR" and modifier.show_viewport for modifier in obj.modifiers):
        return SceneError(obj.name, "is half a face with a Mirror modifier: apply the modifier, then try again")
    return ModelError(f"{obj.name}: {refusal}")
