"""Two layers of skin against one, on the scanned expressions.

    cd tools && python -m experiments.compare_layers                                    the figures of `Layers`
    cd tools && python -m experiments.compare_layers --set poisson=0.3 --set depth=1.4  others

A line per model: explained variance over the 15 shapes (median, mean, each) at low strain, and processor seconds to
build. One layer is taken with and without W, the operator by which it slides and bulges; two layers without, unless
--keep-w. A run takes two minutes and 2 GB, nearly all of it one factorisation.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from faithful.heads import load_face
from faithful.scans import Explained, explained, posed, scanned_shapes
from risorius.api import Face, Mechanism
from risorius.arrays import Floats
from risorius.face.anatomy import Anatomy
from risorius.face.response.actuators import Amounts
from risorius.face.response.recollection import Recollection
from risorius.face.response.relaxation import Relaxation

from .two_layer_skin import Insertion, LayeredTissue, Layers

W = (Mechanism.SLIDING, Mechanism.BULGE)


class LowStrain(Relaxation):
    """Muscles as their linear fields, for a fair comparison: two layers have no biphasic equilibrium yet."""

    def pulled(self, amounts: Amounts, *, teaching: Recollection | None = None) -> Floats:
        """(n, 3) displacement of the outer skin by muscles, metres."""
        return self.actuators.low_strain(amounts)


def model(whole: Face, left_out: Sequence[Mechanism], layers: Layers | None) -> tuple[Face, float]:
    """A face of one layer (None) or two, at low strain, built afresh, and the processor seconds that it took."""
    anatomy = Anatomy(whole.anatomy.mesh, whole.mechanisms.difference(left_out))
    start = time.process_time()
    if layers is not None:
        deep = np.array([layers.deep(muscle.name) for muscle in anatomy.muscles])
        anatomy.sheet = LayeredTissue(anatomy.skin, layers, deep)
    anatomy.relaxation = LowStrain(anatomy.skin, anatomy.sheet, anatomy.actuators)
    _ = anatomy.inverse
    return Face(whole.vertices, whole.polygons, anatomy), time.process_time() - start


def line(label: str, found: Explained, seconds: float) -> str:
    """One model's figures."""
    values = np.array(list(found.values()))
    each = " ".join(f"{name} {value:.2f}" for name, value in found.items())
    return f"{label:10s} median {np.median(values):.3f} mean {values.mean():.3f} build {seconds:4.1f} s | {each}"


def changed(layers: Layers, settings: Sequence[str]) -> Layers:
    """The layers with settings such as "depth=1.4" put in."""
    for setting in settings:
        name, _, value = setting.partition("=")
        if name == "insertion":
            layers = replace(layers, insertion=Insertion(value))
        elif name in vars(layers):
            layers = replace(layers, **{name: float(value)})  # type: ignore[arg-type]
        else:
            raise SystemExit(f"{name!r} is no figure of the layers: one of {', '.join(vars(layers))}")
    return layers


def main() -> None:
    """The command line of the module."""
    parser = argparse.ArgumentParser(description="Hold a two-layer skin against the one-layer skin.")
    parser.add_argument("--set", action="append", default=[], metavar="FIGURE=VALUE", help="a figure of `Layers`")
    parser.add_argument("--keep-w", action="store_true", help="let two layers slide and bulge by W besides")
    given = parser.parse_args()
    layers = changed(Layers(), given.set)
    whole = load_face("ict")
    shapes = scanned_shapes(whole)
    models = (("one layer", (), None), ("without W", W, None), ("two layers", () if given.keep_w else W, layers))
    for label, without, figures in models:
        face, seconds = model(whole, without, figures)
        print(line(label, explained(shapes, posed(face)), seconds), flush=True)


if __name__ == "__main__":
    main()
