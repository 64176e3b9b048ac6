"""Speed of the solvers and of the live preview, beside Blender's own cloth and soft body; and of the sidebar.

    python tools/bench_speed.py                                                all
    python tools/bench_speed.py solvers [--mesh HEAD.npz | --mesh grid] [--frames 50]
    python tools/bench_speed.py preview [--mesh HEAD.npz --points HEAD.fp.json] [--steps 40]
    python tools/bench_speed.py playback                                       clips that are not baked
    python tools/bench_speed.py redraw [--objects 5000]
    python tools/bench_speed.py growth [--most 6]                              1,000 to 500,000 vertices
    python tools/bench_speed.py motion [--head ict.npz]                        every head, and how far it is off
    python tools/bench_speed.py films                                          before and after laid over one another
    python tools/bench_speed.py first                                          first pose, new and kept
    python tools/bench_speed.py page                                           docs/performance.md from the last four

All but the solvers and the page need a Python that has bpy. Everything runs on one core.
"""

from __future__ import annotations

import os
import sys
from importlib import import_module

os.environ.setdefault("OMP_NUM_THREADS", "1")  # before NumPy is imported

PARTS = ("solvers", "preview", "playback", "redraw", "growth", "motion", "films", "first")
#: Written from what those measured, by a Python that has matplotlib.
PAGE = "page"


def main(argv: list[str]) -> int:
    """Measure one part with its options, or all."""
    if argv and argv[0] not in (*PARTS, PAGE):
        print(__doc__)
        return 0 if argv[0] in ("-h", "--help") else 2
    for part in argv[:1] or PARTS:
        print(f"== {part}", flush=True)
        import_module(f"speed.{part}").main(argv[1:])
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
