"""A timeline's clips on a rig: an action and a strip for each, to be moved about by hand."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ...progress import Work
from ..bake.action import Curve
from ..bake.baking import BakeResult, joined
from ..bake.notes import BakeKind, Note
from ..bake.strips import ClipShape
from ..bake.target import Target
from .baking import Expression, FindRig, Onto, bake_expressions_onto
from .clips import remove_rig_clips
from .kept import kept_clips


@dataclass(frozen=True, eq=False)
class _Shares:
    """Keyframes that are known already."""

    keyframes: Curve

    def curve(self, peak: float) -> Curve:
        """They, with a peak of 1."""
        return self.keyframes


def bake_strips_onto(
    target: Target,
    shapes: Sequence[ClipShape],
    find_rig: FindRig,
    *,
    onto: Onto,
    noted: str,
    drive: str = "natural",
) -> Work[BakeResult]:
    """Bake each clip of a timeline onto the controls of a rig; those that overlap lie on several tracks and add up.

    Strips baked before onto these controls whose clips are gone from the timeline are removed.

    Parameters
    ----------
    noted : what the controls are called in notes (`Note.onto`).
    others : as for `bake.strips.bake_strips` and `bake_expressions_onto`.

    Raises
    ------
    SceneError, ModelError, SolverError : nothing has been changed then.
    """
    expressions = [
        Expression(
            shape.clip,
            shape.faps,
            _Shares(shape.curve),
            emotion=shape.emotion,
            contractions=shape.contractions,
            note=Note(BakeKind.STRIP, shape.settings, ((shape.clip, float(shape.curve.frames[0])),), noted),
        )
        for shape in shapes
    ]
    results = yield from bake_expressions_onto(target, expressions, find_rig, onto=onto, drive=drive)
    notes = {clip: kept.note for clip, kept in kept_clips(target.obj).items()}
    strips = [clip for clip, note in notes.items() if note and (note.kind, note.onto) == (BakeKind.STRIP, noted)]
    remove_rig_clips(target.obj, [clip for clip in strips if clip not in {shape.clip for shape in shapes}])
    return joined(results)
