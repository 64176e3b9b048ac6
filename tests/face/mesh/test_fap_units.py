"""FAP units follow the standard's table, and so does the template that the tables of anatomy are written on."""

from __future__ import annotations

import numpy as np
import pytest
from risorius.api import FAPS
from risorius.errors import ModelError, ParameterError
from risorius.face.mesh.fap_units import TEMPLATE_FAPU, fapu, unit_length
from risorius.face.mesh.template import TEMPLATE_POINTS
from risorius.mpeg4 import FAPU, Unit


def test_an_iris_is_the_mean_of_both_eyes_gaps() -> None:
    """The standard names both: a face that narrows one eye has no narrower one unit than the other."""
    points = dict(TEMPLATE_POINTS)
    points["3.2"] = points["3.2"] + np.array([0.0, 1e-3, 0.0])
    units = fapu(points, np.eye(3))
    assert units.irisd0 - TEMPLATE_FAPU.irisd0 == pytest.approx(0.5e-3)
    assert units.es0 == TEMPLATE_FAPU.es0


def test_every_unit_is_measured_between_the_points_of_the_table_and_no_others() -> None:
    for name in TEMPLATE_POINTS:
        points = dict(TEMPLATE_POINTS)
        points[name] = points[name] + np.array([1e-4, 1e-4, 0.0])
        units = fapu(points, np.eye(3))
        moved = {symbol for symbol, length in vars(units).items() if length != getattr(TEMPLATE_FAPU, symbol)}
        named = {
            definition.symbol.lower() for definition in FAPU.values() if any(name in pair for pair in definition.pairs)
        }
        assert moved == named, name


def test_a_unit_that_is_none_says_which_points_to_look_at() -> None:
    points = dict(TEMPLATE_POINTS)
    points["3.1"], points["3.3"] = points["3.3"], points["3.1"]
    points["3.2"], points["3.4"] = points["3.4"], points["3.2"]
    with pytest.raises(ModelError, match=r"IRISD0.*-10\.00 mm.*3\.1 and 3\.3, 3\.2 and 3\.4"):
        fapu(points, np.eye(3))


def test_a_fap_of_an_angle_has_no_length() -> None:
    assert unit_length(FAPS[3].unit, TEMPLATE_FAPU) == TEMPLATE_FAPU.mns0 / 1024
    with pytest.raises(ParameterError, match="one of the lengths IRISD, ES, ENS, MNS, MW"):
        unit_length(Unit.AU, TEMPLATE_FAPU)
