"""The names of what a face is made of, so that each can be left out and its worth shown.

The second paper's model is a membrane of biphasic springs pulled by linear, sheet and sphincter muscles. Everything
that Risorius adds to it is an addition here; the muscles come in groups, each with a table of its own.
"""

from __future__ import annotations

from collections.abc import Iterable
from enum import StrEnum

from ..errors import ParameterError


class Mechanism(StrEnum):
    """What can be left out of a face (`Face.without`)."""

    # Additions: the skin
    BENDING = "bending"  # skin resists being bent
    FIRMNESS = "firmness"  # scalp, nose, lid plates, chin pad and neck are held more firmly than the rest
    SLIDING = "sliding"  # skin slides over the bone rather than lifts off it
    BULGE = "bulge"  # squeezed tissue bulges
    HOOD = "hood"  # skin between brow and lid goes with the brow and folds over the lid
    FOLDS = "folds"  # squeezed skin folds along known lines
    # Additions: how muscles pull
    SEPARATION = "separation"  # lips and lids are told apart by distance along the skin, not through the air
    FADING = "fading"  # sphincter and sheet fade beyond their zones and follow the skin
    FLAT_PULLS = "flat_pulls"  # muscles of other kinds than the paper's three: windows, bands, arches, pressure
    SUPERFICIAL = "superficial"  # muscles that lie in the skin pull along it
    SCALP = "scalp"  # the frontalis, without bony origin, draws the scalp down
    # Additions: what turns, meets and is made exact
    JAW = "jaw"  # the mandible
    FLOOR = "floor"  # the floor of the mouth bulges as the jaw opens
    HOLLOW = "hollow"  # the cheeks hollow beside an opening mouth
    LIDS = "lids"  # lids turn about the eyeball
    LID_SLIDE = "lid_slide"  # closing lids slide towards the nose
    CONTACT = "contact"  # lips and lids do not pass through each other, nor lids into the eyeball
    LIP_MIDDLE = "lip_middle"  # the lips' middles stay when one corner is drawn aside
    CORRECTION = "correction"  # the elastic skin goes the rest of the way to the FAPs
    # The paper's own
    BIPHASIC = "biphasic"  # springs stiffen beyond a threshold
    # Groups of muscles
    BROW = "brow"
    CHEEK = "cheek"
    NOSE = "nose"
    LIPS = "lips"
    CORNERS = "corners"
    BUCCINATOR = "buccinator"
    CHIN = "chin"
    ORBICULARIS_ORIS = "orbicularis_oris"
    PLATYSMA = "platysma"


MUSCLE_GROUPS = (
    Mechanism.BROW,
    Mechanism.CHEEK,
    Mechanism.NOSE,
    Mechanism.LIPS,
    Mechanism.CORNERS,
    Mechanism.BUCCINATOR,
    Mechanism.CHIN,
    Mechanism.ORBICULARIS_ORIS,
    Mechanism.PLATYSMA,
)
"""The groups of muscles; each has a table in presets/anatomy/muscles/."""

ADDITIONS = tuple(m for m in Mechanism if m not in MUSCLE_GROUPS and m is not Mechanism.BIPHASIC)
"""What is added to the second paper's bare model: `face.without(*ADDITIONS)` is that model alone."""

EVERY = frozenset(Mechanism)
"""All of them, as a face has them at first."""


def named(mechanisms: Iterable[str | Mechanism]) -> frozenset[Mechanism]:
    """The mechanisms of some names.

    Raises
    ------
    ParameterError : an unknown name; lists the known ones.
    """
    found = set()
    for name in mechanisms:
        try:
            found.add(Mechanism(name))
        except ValueError:
            raise ParameterError("mechanism", f"must be one of {', '.join(Mechanism)}", name) from None
    return frozenset(found)
