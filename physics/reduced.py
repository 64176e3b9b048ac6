"""Skin that deviates a little from a moving balance, in a few displacement fields.

Skin whose balance b(t) moves is left behind by its inertia and its damping. With x = b + F d, where the columns of F
are a few fields over the nodes,

    F'M F d'' + F'C F d' + F'K F d = -F'(M b'' + C b'),

K being the true stiffness of springs, bending and anchors in the balance. While a balance moves evenly between two
moments, this is solved exactly by one matrix exponential, whatever the step. The fields that a motion needs are those
of its balance, the skin's quasi-static answers to the inertia and damping of these, the answers to the answers', and so
on (Bai and Su 2005, Dimension reduction of large-scale second-order dynamical systems via a second-order Arnoldi
method, SIAM J. Sci. Comput. 26(5); Brandt, Eisemann and Hildebrandt 2018, Hyper-reduced projective dynamics, ACM Trans.
Graph. 37(4)).
"""

from __future__ import annotations

from collections.abc import Sequence
from math import prod

import numpy as np
from scipy.linalg import expm

from ..arrays import Floats, Ints, Singles
from ..errors import ParameterError
from .elastic import Factor
from .skin import Skin

_SMALLEST = 1e-5
"""Fields smaller than this share of the largest one are left out: they are what rounding left of it."""


def principal_fields(fields: Floats, count: int) -> Floats:
    """(k, n, 3) the fields, at most `count`, that most of some displacement fields (m, n, 3) are sums of."""
    flat = fields.reshape(len(fields), -1)
    values, vectors = np.linalg.eigh(flat @ flat.T)
    largest = np.argsort(values)[::-1][:count]
    kept = largest[values[largest] > _SMALLEST**2 * max(float(values[-1]), np.finfo(float).tiny)]
    turned: Floats = vectors[:, kept].T / np.sqrt(values[kept])[:, None] @ flat
    return turned.reshape(-1, *fields.shape[1:])


class ReducedSkin:
    """How a skin follows its moving balance, step after step of one length.

    Parameters
    ----------
    skin : the skin.
    factor : of `skin.matrix()`, or of one near it.
    balances : (m, n, 3) m, displacement fields that the balance moves in; m >= 1.
    step : s, above 0.
    count : answers to answers are added while there are no more fields than this.

    Attributes
    ----------
    fields : (k, n, 3), orthonormal in the skin's mass.

    Raises
    ------
    ParameterError : a step that is not above 0, or fields of another shape.
    """

    def __init__(self, skin: Skin, factor: Factor, balances: Floats, step: float, *, count: int) -> None:
        if not (np.isfinite(step) and step > 0):
            raise ParameterError("step", "must be finite and above 0", step)
        if balances.ndim != 3 or balances.shape[1:] != skin.rest.shape or not len(balances):
            raise ParameterError("balances", f"must be fields of the shape {skin.rest.shape}", balances.shape)
        self.step, self._skin = step, skin
        self.fields = _orthonormal(_with_answers(skin, factor, balances, count), skin.mass)
        flat = self.fields.reshape(len(self.fields), -1)
        self._felt = np.concatenate([(w[:, None] * self.fields).reshape(flat.shape) for w in _inertias(skin)])
        self._damping = flat @ self._felt[len(flat) :].T
        self._held = skin.held_stiffness_between(self.fields)
        columns = self.fields.transpose(2, 1, 0)
        apart = [skin.springs.incidence @ np.ascontiguousarray(column) for column in columns]
        self._apart: Singles = np.array(apart, dtype=np.float32)  # half the traffic; rounding is far from telling

    def read(self, balances: Floats, nodes: Ints | None = None) -> Floats:
        """(..., 2k) what the skin feels of balances (..., n, 3), m: `F'M b` before `F'C b`.

        With `nodes` (m,), of balances (..., m, 3) that are given of these and 0 elsewhere.
        """
        felt = self._felt
        if nodes is not None:
            felt = felt.reshape(len(felt), -1, 3)[:, nodes].reshape(len(felt), -1)
        several = balances.shape[:-2]
        flat = balances.reshape(prod(several), felt.shape[1])  # one product of matrices, whatever the balances' shape
        return np.asarray(flat @ felt.T).reshape(*several, len(felt))

    def at_rest(self) -> Floats:
        """(3k,) the state of a skin that rests in its balance, which has not moved."""
        return np.zeros(3 * len(self.fields))

    def stiffness(self, positions: Floats) -> Floats:
        """(k, k) N/m, true at some positions (n, 3) m of the skin; where it would buckle, nothing holds it."""
        true = self._held + self._skin.springs.stiffness_between(positions, self._apart)
        values, ways = np.linalg.eigh(0.5 * (true + true.T))
        return np.asarray((ways * np.maximum(values, 0.0)) @ ways.T)

    def passage(self, positions: Floats) -> Floats:
        """(2k, 3k) from deviation, its rate and a steady load to deviation and rate a step later, at `stiffness`."""
        return self.passages(positions, [1])[0]

    def passages(self, positions: Floats, parts: Sequence[int]) -> list[Floats]:
        """As `passage`, over the step, or over one of so many equal parts of it."""
        count = len(self.fields)
        rates = np.zeros((3 * count, 3 * count))
        rates[:count, count : 2 * count] = rates[count : 2 * count, 2 * count :] = np.eye(count)
        rates[count : 2 * count, :count] = -self.stiffness(positions)
        rates[count : 2 * count, count : 2 * count] = -self._damping
        return [np.asarray(expm(self.step / part * rates)[: 2 * count]) for part in parts]

    def follow(self, state: Floats, before: Floats, after: Floats, passage: Floats) -> Floats:
        """The state (3k,) one step on: deviation, its rate, and the rate of what was felt of the balance by mass.

        Parameters
        ----------
        before, after : (2k,) of `read`, of the balance at both ends of the step.
        passage : (2k, 3k) between them.
        """
        count = len(self.fields)
        felt = (after - before) / self.step
        jolted = state[count : 2 * count] - (felt[:count] - state[2 * count :])
        return np.concatenate([passage @ np.concatenate([state[:count], jolted, -felt[count:]]), felt[:count]])

    def displacement(self, states: Floats) -> Floats:
        """(..., n, 3) m, how far the skin is from its balance in states (..., 3k)."""
        return np.tensordot(states[..., : len(self.fields)], self.fields, axes=1)


def _with_answers(skin: Skin, factor: Factor, balances: Floats, count: int) -> Floats:
    """(k, n, 3) balances (m, n, 3), the answers to their inertia and damping, and answers to these up to a count."""
    fields, last = [balances], balances
    while len(fields) == 1 or sum(map(len, fields)) + 2 * len(last) <= count:
        loads = np.concatenate([weight[:, None] * last for weight in _inertias(skin)])
        columns = factor.solve(loads.transpose(1, 0, 2).reshape(len(skin.rest), -1))
        last = _orthonormal(columns.reshape(len(skin.rest), -1, 3).transpose(1, 0, 2), skin.mass)
        fields.append(last)
    return np.concatenate(fields)


def _inertias(skin: Skin) -> tuple[Floats, Floats]:
    """What a node's acceleration and its speed weigh, (n,) each."""
    return skin.mass, skin.damping


def _orthonormal(fields: Floats, mass: Floats) -> Floats:
    """(k, n, 3) fields that span the same as some (m, n, 3), of length 1 and at right angles in the mass (n,)."""
    root = np.sqrt(mass)[:, None]
    flat = (root * fields).reshape(len(fields), -1)
    flat = flat / np.maximum(np.linalg.norm(flat, axis=1, keepdims=True), np.finfo(float).tiny)
    left, values, _ = np.linalg.svd(flat @ flat.T)
    kept = values > _SMALLEST**2 * values[0]
    turned = ((left[:, kept] / np.sqrt(values[kept])).T @ flat).reshape(-1, *fields.shape[1:])
    return np.asarray(turned / root)
