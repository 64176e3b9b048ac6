"""What a bake onto a rig has to say for itself, as plain numbers and names: for JSON, for tests, for tables."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np

from ...arrays import Floats
from ..bake.baking import BakeResult

#: What JSON can hold, by name.
Report: TypeAlias = dict[str, object]


def clip_report(result: BakeResult, requested: Floats, *, strength: float = 1.0) -> Report:
    """What one clip does on the controls of a rig.

    Parameters
    ----------
    requested : (68,) FAPs of an expression, or (T, 68) of a motion's frames; NaN where silent.
    strength : the expression's strength at its apex, which all that is told of the face is told at.

    Returns
    -------
    clip, action, frames : its name, its action (several by commas), first and last frame.
    peak_step : the step of the motion at which most moves, from 0 on; millimetres and FAPs are of this step.
    explained : share of the motion of the outer skin that shows.
    moved_mm, off_mm : root mean square over that skin, of the muscles' motion and of what shows beside it.
    controls : name -> value at its peak.
    carriers : name -> share of the motion that goes through it, of the controls that do most.
    faps : name -> what is `requested`, what the `muscles` do and what is `achieved`, FAP units; None where nobody can
        tell (eyeballs, the head's turn).
    missing : name -> `asked` and `shown`, where too little shows.
    unmet : name -> why, of what does not show at all.
    head_turns : whether the motion turns the head, which no control of the face shows.
    left_alone : name -> why, of what could have been a control.
    still, same : names of controls that move nothing; of those that do what another does -> that other.
    """
    from ... import api

    found = result.followed
    assert found is not None, "a bake onto shape keys of its own follows no controls"
    peak = int(np.argmax(found.moved))
    wanted = np.asarray(requested, dtype=np.float64).reshape(-1, found.asked.shape[1])
    wanted = wanted[min(peak, len(wanted) - 1)]
    faps = {
        api.fap(int(index) + 1).name: {
            "requested": _known(strength * wanted[index]),
            "muscles": _known(strength * found.asked[peak, index]),
            "achieved": _known(strength * found.shown[peak, index]),
        }
        for index in np.flatnonzero(~np.isnan(wanted))
    }
    missing = {
        api.fap(short.number).name: {"asked": strength * short.asked, "shown": strength * short.shown}
        for short in found.missing
    }
    return {
        "clip": result.clip,
        "action": result.action,
        "frames": result.frame_range,
        "explained": found.explained,
        "moved_mm": 1000.0 * strength * float(found.moved[peak]),
        "off_mm": 1000.0 * strength * float(found.off[peak]),
        "peak_step": peak,
        "controls": dict(result.peaks),
        "carriers": dict(found.carriers),
        "faps": faps,
        "missing": missing,
        "unmet": {api.fap(number).name: why for number, why in found.unmet.items()},
        "head_turns": bool(np.abs(found.head_turns).max(initial=0.0) > 0.0),
        "left_alone": dict(result.left_alone),
        "still": found.still,
        "same": dict(found.same),
    }


def _known(value: float) -> float | None:
    """A number, or None for NaN."""
    return None if np.isnan(value) else float(value)
