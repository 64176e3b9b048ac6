"""What a first pose needs, worked out stage by stage."""

from __future__ import annotations

from operator import attrgetter

from ..progress import Progress, Work, worked_out
from .drive.request import Request, silent_faps
from .pose import Poser

#: What is worked out, in this order, of a poser; the text is for people.
STAGES = (
    ("Preparing the skin", "anatomy.given_skin"),
    ("Preparing the skin", "anatomy.skin"),
    ("Preparing the skin", "anatomy.muscles"),
    ("Preparing the skin", "anatomy.carry"),
    ("Preparing the skin", "anatomy.skin.normals"),
    ("Preparing the skin", "anatomy.skin.margins_reached"),
    ("Computing what each muscle does", "anatomy.sheet.factor"),
    ("Computing what each muscle does", "anatomy.sheet.bulge"),
    ("Computing what each muscle does", "anatomy.pulls"),
    ("Computing what each muscle does", "anatomy.actuators"),
    ("Relating muscles to FAPs", "anatomy.points"),
    ("Relating muscles to FAPs", "anatomy.sheet.correction_factor"),
    ("Relating muscles to FAPs", "anatomy.kernel"),
    ("Relating muscles to FAPs", "anatomy.inverse"),
    ("Preparing contact of lips and lids", "anatomy.eyeballs"),
    ("Preparing contact of lips and lids", "anatomy.contact"),
    ("Preparing what follows the skin", "anatomy.inner_skin"),
    ("Preparing what follows the skin", "anatomy.rooted_parts"),
    ("Placing folds", "anatomy.given_skin.normals"),
    ("Placing folds", "assembly.folds.placed"),
)


def preparation(poser: Poser) -> Work[None]:
    """Work out all that poses share; yields how far it is and what comes next."""
    count = len(STAGES) + 1
    for number, (text, place) in enumerate(STAGES):
        yield Progress(number / count, text)
        owner, _, name = place.rpartition(".")
        for step in worked_out(attrgetter(owner)(poser), name):
            yield Progress((number + step.fraction) / count, text)
    yield Progress((count - 1) / count, "Solving the skin")
    poser.sketch(Request(silent_faps()))
