"""Write docs/faps.md: what moves each FAP, how much of what is asked it shows, and what moves along.

    .venv/bin/python tools/fap_table.py [--heads FOLDER]

FOLDER holds a head `ict.npz` with `ict.fp.json`; without it the table has the default head alone.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import risorius.api as api
from places import DOCS, ROOT, shared_folder
from risorius.arrays import Floats
from risorius.face.drive.natural.planning import plan_naturally
from risorius.face.drive.natural.synergies import load_synergies
from risorius.face.drive.request import Request
from risorius.face.mechanisms.lid_movers import LID_MOVERS
from risorius.face.mesh.fap_units import unit_length
from risorius.face.posture import Balance

PAGE = DOCS / "faps.md"

#: Units asked of a length and of an angle; less where that leaves the range in which a natural face follows.
LENGTH_UNITS, ANGLE_UNITS, RANGE_SHARE = 100.0, 10000.0, 0.3

#: Shares of the motion, and leaks in per cent, below these are not worth a word.
SHARE_SHOWN, LEAK_SHOWN = 0.08, 5.0

HEADING = """# What each FAP moves

Written by `make docs-faps` (`tools/fap_table.py`) from the faces themselves; do not edit.

Each low-level FAP is requested alone, left and right together, from the neutral face: 100 units (0.1 rad for angles),
or {share} of its anatomical range (`presets/anatomy/ranges.csv`) if that is less. The exact drive reaches the request
within {exact} on every head in the table.

- **by**: how the natural drive produces the motion. The three largest contributions in per cent, for the positive (+)
  and the negative (−) direction. *skin* is the elastic correction of what muscles leave.
- **shown**: motion in the natural drive per unit requested, + / −. Below 1, the face resists: neighbouring points
  without a request hold it back. Requests beyond the range show less ([muscles](muscles.md)).
- **moves along**: the FAP of another point that moves most in the natural drive, in millimetres per 100 mm requested
  (+). The units of different FAPs differ. Most of this is anatomy, not an error: an opening jaw carries the lower lip.

FAP 1 (viseme) is expanded to the rows of `mpeg4/data/viseme_shapes.csv`, FAP 2 (expression) to the default variant of
its archetype times intensity / 63; see [file formats](formats.md).
"""


@dataclass(frozen=True)
class Measured:
    """One FAP (with its mirror) asked for in one direction on one head.

    Attributes
    ----------
    natural, exact : achieved per asked; NaN where the head cannot show it.
    shares : mechanism -> share of the natural motion. leak : FAP and mm per 100 mm asked, None where nothing leaks.
    """

    natural: float
    exact: float
    shares: Mapping[str, float]
    leak: tuple[int, float] | None


def ict_face(folder: Path) -> api.Face | None:
    """The ICT mean head of a folder, parts derived; None where it is absent."""
    if not (folder / "ict.npz").is_file():
        return None
    data = np.load(folder / "ict.npz")
    facts = json.loads((folder / "ict.fp.json").read_text(encoding="utf-8"))
    points = {**facts["points"], **{name: np.array(facts["xyz"][name]) for name in facts["no_vertex"]}}
    polygons = np.split(data["loops"].astype(np.int64), np.cumsum(data["face_sizes"])[:-1])
    return api.Face.from_arrays(data["vertices"].astype(np.float64), polygons, points)


def numbers_of(number: int) -> tuple[int, ...]:
    """A FAP and its mirror."""
    mirror = api.FAPS[number].mirror
    return (number,) if mirror is None else (number, mirror)


def request(number: int, sign: float) -> Floats:
    """(68,) frame that asks for a FAP and its mirror alone."""
    data = load_synergies()
    size = ANGLE_UNITS if api.FAPS[number].angular else LENGTH_UNITS
    if number in data.row_of:
        row = data.row_of[number]
        limit = data.high[row] if sign > 0.0 else -data.low[row]
        size = min(size, RANGE_SHARE * float(limit / data.per_fap[row]))
    frame = np.full(68, np.nan)
    for each in numbers_of(number):
        frame[each - 1] = sign * size
    return frame


def mechanisms(face: api.Face, frame: Floats, number: int) -> dict[str, float]:
    """Mechanism -> share of a FAP's natural motion; what muscles, lids and jaw leave is the skin's."""
    group = api.FAPS[number].group
    if number in range(23, 31) or group in (6, 7):
        return {"eyeball" if group == 3 else "tongue" if group == 6 else "head turn": 1.0}
    anatomy = face.anatomy
    rows, actuators = anatomy.inverse.rows, anatomy.actuators
    amounts = Balance(anatomy).posture(plan_naturally(Request(frame))).amounts
    row = rows.row_of[number]
    lids = [amounts.lids.get(key, 0.0) for key in actuators.lid_moves]
    opening = amounts.jaw.angle * actuators.chin_lever
    solution = np.array([*amounts.muscles, *lids, opening, amounts.jaw.left, amounts.jaw.forward])
    names = [muscle.name[:-2] if muscle.name[-2:] in ("_l", "_r") else muscle.name for muscle in actuators.muscles]
    names += [LID_MOVERS[move].name for _, move in actuators.lid_moves] + ["jaw opening", "jaw shift", "jaw thrust"]
    moved = actuators.responses(anatomy.inverse.matrix)[row] * solution
    asked = float(frame[number - 1] * rows.units[row])
    shares: dict[str, float] = {}
    for name, way in zip(names, moved.tolist(), strict=True):
        shares[name] = shares.get(name, 0.0) + way / asked
    return shares


def measure(face: api.Face, number: int, sign: float) -> Measured:
    """Ask one face for one FAP."""
    frame = request(number, sign)
    asked = float(frame[number - 1])
    natural, exact = (face.pose(frame, drive=drive).achieved for drive in ("natural", "exact"))
    gain = float(natural[number - 1]) / asked
    shares = mechanisms(face, frame, number)
    shares["skin"] = gain - sum(shares.values())
    return Measured(gain, float(exact[number - 1]) / asked, shares, largest_leak(face, frame, natural))


def largest_leak(face: api.Face, frame: Floats, achieved: Floats) -> tuple[int, float] | None:
    """The FAP of another point that moves farthest; of pairs the first, and not the same lip's other contour."""
    numbers = np.flatnonzero(~np.isnan(frame)) + 1
    asked = int(numbers[0])
    if api.FAPS[asked].angular:
        return None
    twins = [twin for n in numbers.tolist() if (twin := api.FAPS[n].lip_twin) is not None]
    own = {api.FAPS[n].feature_point for n in (*numbers.tolist(), *twins)}
    way = abs(frame[asked - 1]) * unit_length(api.FAPS[asked].unit, face.units)
    best: tuple[int, float] | None = None
    for other in range(3, 69):
        fap = api.FAPS[other]
        second = fap.mirror is not None and fap.mirror < other
        if fap.angular or second or fap.feature_point in own or np.isnan(achieved[other - 1]):
            continue
        value = 100.0 * float(achieved[other - 1]) * unit_length(fap.unit, face.units) / way
        if abs(value) > max(LEAK_SHOWN, abs(best[1]) if best else 0.0):
            best = (other, value)
    return best


def percent(share: float, digits: int = 0) -> str:
    """A share as per cent."""
    return f"{100.0 * share:.{digits}f} %"


def words(measured: Measured) -> str:
    """The mechanisms that matter, largest first."""
    total = sum(measured.shares.values()) or 1.0
    parts = sorted(((share / total, name) for name, share in measured.shares.items()), key=lambda p: (-abs(p[0]), p[1]))
    said = [f"{name} {100.0 * share:.0f}" for share, name in parts[:3] if abs(share) >= SHARE_SHOWN]
    return ", ".join(said).replace(" -", " −")


def signs(number: int) -> tuple[float, ...]:
    """Both directions, or the positive one alone."""
    return (1.0, -1.0) if api.FAPS[number].bidirectional else (1.0,)


def name_of(number: int) -> str:
    """Numbers and name, left and right in one: 6, 7 stretch_l/r_cornerlip."""
    name = api.FAPS[number].name
    if api.FAPS[number].mirror is None:
        return f"{number} {name}"
    left = "_l_" if "_l_" in name else "_lm"
    joined = name.replace("_l_", "_l/r_") if left == "_l_" else name.replace("_lm", "_lm/rm")
    return f"{number}, {api.FAPS[number].mirror} {joined}"


def table(faces: Mapping[str, api.Face]) -> Iterator[str]:
    """The page's lines."""
    errors: list[float] = []
    lines = [
        f"| FAP | by | {' | '.join(f'shown, {name}' for name in faces)} | moves along |",
        "|---|---|" + "---|" * (len(faces) + 1),
    ]
    for number in range(3, 69):
        if min(numbers_of(number)) < number:
            continue
        found = {name: [measure(face, number, sign) for sign in signs(number)] for name, face in faces.items()}
        errors += [abs(m.exact - 1.0) for each in found.values() for m in each if not np.isnan(m.exact)]
        first = next(iter(found.values()))
        by = " · ".join(f"{mark} {words(m)}" for mark, m in zip("+−", first, strict=False))
        shown = " | ".join(" / ".join(f"{m.natural:.2f}" for m in each) for each in found.values())
        leak = first[0].leak
        along = "" if leak is None else f"{leak[0]} {api.FAPS[leak[0]].name} {leak[1]:+.0f}".replace("-", "−")
        lines.append(f"| {name_of(number)} | {by} | {shown} | {along} |")
    yield HEADING.format(share=percent(RANGE_SHARE), exact=percent(max(max(errors), 0.001), 1))
    yield from lines


def main() -> None:
    """Write the page."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    default = shared_folder() / "heads"
    parser.add_argument("--heads", type=Path, default=default, help="folder with ict.npz and ict.fp.json")
    folder = parser.parse_args().heads
    faces = {"default head": api.default_face()}
    ict = ict_face(folder)
    if ict is not None:
        faces["ICT mean head"] = ict
    PAGE.write_text("\n".join(table(faces)) + "\n", encoding="utf-8")
    print(f"{PAGE.relative_to(ROOT)}: {' and '.join(faces)}")


if __name__ == "__main__":
    main()
