"""What a first pose needs, worked out stage by stage."""

from __future__ import annotations

from collections.abc import Callable

from ..progress import Progress, Work
from .anatomy import Anatomy
from .drive.request import Request, silent_faps
from .pose import Poser
from .response.relaxation import Memory


def preparation(anatomy: Anatomy, poser: Poser) -> Work[None]:
    """Work out all that poses share; yields how far it is and what comes next."""
    stages: tuple[tuple[str, Callable[[], object]], ...] = (
        ("Preparing the skin", lambda: anatomy.given_skin),
        ("Preparing the skin", lambda: (anatomy.skin, anatomy.muscles)),
        ("Preparing the skin", lambda: (anatomy.carry, anatomy.skin.normals)),
        ("Computing what each muscle does", lambda: anatomy.sheet.factor),
        ("Computing what each muscle does", lambda: anatomy.pulls),
        ("Computing what each muscle does", lambda: anatomy.actuators),
        ("Relating muscles to FAPs", lambda: anatomy.inverse),
        ("Preparing contact of lips and lids", lambda: anatomy.eyeballs),
        ("Preparing contact of lips and lids", lambda: anatomy.contact),
        ("Preparing what follows the skin", lambda: anatomy.inner_skin),
        ("Preparing what follows the skin", lambda: anatomy.rooted_parts),
        ("Placing folds", lambda: anatomy.given_skin.normals),
        ("Placing folds", lambda: poser.assembly.folds),
        ("Solving the skin", lambda: poser.sketch(Request(silent_faps()), Memory())),
    )
    for number, (text, stage) in enumerate(stages):
        yield Progress(number / len(stages), text)
        stage()
