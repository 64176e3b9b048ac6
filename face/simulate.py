"""The face in motion."""
from __future__ import annotations
from collections.abc import Iterator
from ..arrays import Floats
from .pose import Poser
from .wishes import Drive
class Simulation:
    def __init__(self, poser: Poser, *, fps: float, integrator: str, substeps: int) -> None:
        self.poser = poser
    def run(self, frames: Floats, drive: Drive, emotions: Floats | None) -> Iterator[Floats]:
        raise RuntimeError
