"""Write docs/evidence.md: how well emotions are recognised on posed faces, scans and sample streams.

    .venv/bin/python tools/evidence.py [--part natural exact ... page] [--draws N]

Poses and scans leave what was measured in out/evidence/, face by face, so that parts can be run one at a time and a
broken run goes on where it was; delete the folder after a change of faces or drives. The shared heads and samples are
found by $RISORIUS_SHARED, else in `../shared`. What `tools/evidence_seen.py` left of pictures is written, too.
"""

from __future__ import annotations

import argparse
import json
import time

from places import DOCS, OUT, ROOT, shared_folder
from recognition.faces import faces
from recognition.page import Figures, page
from recognition.plots import draw_confusions, draw_samples, draw_shapes
from recognition.poses import DRAWS, Series, gather
from recognition.samples import read_samples
from recognition.scans import gather_scans
from recognition.verdicts import Way, all_verdicts

PAGE, CACHE, PICTURES = DOCS / "evidence.md", OUT / "evidence", DOCS / "pictures"

SCANS, PAGE_PART = "scans", "page"
PARTS = (*map(str, Series), SCANS, PAGE_PART)


def main() -> None:
    """Run the parts."""
    arguments = _arguments()
    shared = shared_folder()
    heads, samples = shared / "heads", shared / "samples" / "fap"
    draws = DRAWS if arguments.draws is None else dict.fromkeys(Series, arguments.draws)
    build = faces(heads)
    for part in arguments.part:
        begun = time.perf_counter()
        if part == SCANS:
            gather_scans(heads, build, CACHE)
        elif part in set(Series):
            gather(Series(part), build, CACHE, draws=draws)
        else:
            posed = {each: gather(each, build, CACHE, draws=draws) for each in Series}
            words = posed.pop(Series.WORDS)
            seen = CACHE / "seen.json"
            pictures = json.loads(seen.read_text(encoding="utf-8")) if seen.is_file() else []
            _write(Figures(posed, words, gather_scans(heads, build, CACHE), read_samples(samples), pictures))
        print(f"{part}: {time.perf_counter() - begun:.0f} s", flush=True)


def _write(figures: Figures) -> None:
    """The page and its pictures."""
    natural, untold = figures.posed[Series.NATURAL], figures.posed[Series.UNTOLD]
    said = all_verdicts(natural)
    pairs = {f"natural: {way}": (natural.asked, said[way]) for way in Way if way is not Way.FEATURES_PAPER}
    pairs["untold: FAPs, robust"] = untold.asked, all_verdicts(untold)[Way.FAPS_ROBUST]
    draw_confusions(pairs, PICTURES / "evidence-confusion.png")
    draw_shapes(natural, PICTURES / "evidence-shapes.png")
    draw_samples(figures.samples, PICTURES / "evidence-samples.png")
    PAGE.write_text(page(figures), encoding="utf-8")
    print(f"wrote {PAGE.relative_to(ROOT)}")


def _arguments() -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--part", nargs="+", choices=PARTS, default=PARTS, help="what to run; by default everything")
    parser.add_argument("--draws", type=int, help="draws inside the ranges on each face, in every series")
    return parser.parse_args()


if __name__ == "__main__":
    main()
