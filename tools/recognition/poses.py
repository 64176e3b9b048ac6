"""Poses of profiles on faces, measured from the mesh: what recognition is judged on.

Each file of the cache holds what one face showed of one series (`Series`), so that a broken run goes on where it was
and the page is quickly written again.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from enum import StrEnum
from pathlib import Path

import numpy as np
import risorius.api as api
from risorius.api import Face
from risorius.arrays import Floats
from risorius.mpeg4 import ARCHETYPES, VARIANTS, Archetype, Profile

#: Activations as shares of the archetype's own, and the ends of the wheel they are held to.
SHARES = (0.6, 0.8, 1.0, 1.3)
LEAST_ACTIVATION, LARGEST_ACTIVATION = 1.0, 7.0


class Series(StrEnum):
    """What is posed.

    natural, exact : the 25 profiles at four activations by that drive, which is told the emotion.
    untold : the natural drive, told the FAPs alone.
    words : every word that has a profile, by the natural drive.
    """

    NATURAL = "natural"
    EXACT = "exact"
    UNTOLD = "untold"
    WORDS = "words"


#: Draws inside the ranges on each face, per profile and activation.
DRAWS = {Series.NATURAL: 6, Series.EXACT: 1, Series.UNTOLD: 1, Series.WORDS: 1}


@dataclass(frozen=True)
class Measured:
    """What faces showed; n poses.

    Attributes
    ----------
    faps : (n, 68) FAPs measured on the mesh, FAP units; NaN where the face has no such point.
    features : (n, 15) features of Table 3.
    asked : (n,) the emotion or word that was posed.
    variants : (n,) variant of the archetype; 0 for words.
    shares : (n,) activation as a share of the archetype's own; 1 for words.
    faces : (n,) name of the face.
    seconds : all the poses took, without building faces.
    """

    faps: Floats
    features: Floats
    asked: np.ndarray
    variants: np.ndarray
    shares: Floats
    faces: np.ndarray
    seconds: float

    def part(self, chosen: np.ndarray) -> Measured:
        """The poses of a mask (n,)."""
        arrays = {name: getattr(self, name)[chosen] for name in ("faps", "features", *LABELS)}
        return replace(self, **arrays)


LABELS = ("asked", "variants", "shares", "faces")


@dataclass(frozen=True)
class _Wish:
    """One pose to make."""

    asked: str
    variant: int
    share: float
    profile: Profile


def gather(
    series: Series, faces: Mapping[str, Callable[[], Face]], cache: Path, *, draws: Mapping[Series, int] = DRAWS
) -> Measured:
    """A series on all faces, from the cache where it is there.

    Parameters
    ----------
    series : what to pose.
    faces : name -> what builds the face.
    cache : folder of earlier results.
    draws : inside the ranges on each face, per profile and activation.
    """
    cache.mkdir(parents=True, exist_ok=True)
    parts = []
    for number, (name, build) in enumerate(faces.items()):
        count = draws[series]
        path = cache / f"{series}-{count}-{name.replace(' ', '_')}.npz"
        if not path.exists():
            found = pose_all(build(), series, name=name, draws=count, seed=number)
            np.savez_compressed(path, **vars(found))
            print(f"{series} on {name}: {len(found.faps)} poses in {found.seconds:.0f} s", flush=True)
        with np.load(path) as arrays:
            parts.append(Measured(**{**arrays, "seconds": float(arrays["seconds"])}))
    columns = {name: np.concatenate([getattr(part, name) for part in parts]) for name in ("faps", "features", *LABELS)}
    return Measured(**columns, seconds=sum(part.seconds for part in parts))


def pose_all(face: Face, series: Series, *, name: str, draws: int, seed: int) -> Measured:
    """A series on one face: each profile is posed by `draws` draws inside its ranges, of their own for every seed."""
    random = np.random.default_rng(seed)
    sketcher = face.sketcher()
    drive = "exact" if series is Series.EXACT else "natural"
    wishes = list(_wishes(series))
    faps, features = [], []
    begun = time.perf_counter()
    for wish in wishes:
        told = None if series is Series.UNTOLD else wish.profile.weights
        for _ in range(draws):
            positions = sketcher.sketch(wish.profile.frame(random), drive=drive, emotion=told).positions
            faps.append(face.measure(positions))
            features.append(face.features(positions))
    return Measured(
        faps=np.array(faps),
        features=np.array(features),
        asked=np.repeat([wish.asked for wish in wishes], draws),
        variants=np.repeat([wish.variant for wish in wishes], draws),
        shares=np.repeat([wish.share for wish in wishes], draws),
        faces=np.full(len(faps), name),
        seconds=time.perf_counter() - begun,
    )


def words() -> list[str]:
    """Every word that has a profile."""
    return [word for word in api.WORDS if api.expression(word).ranges]


def _wishes(series: Series) -> Iterator[_Wish]:
    """What a series poses, alike following alike."""
    if series is Series.WORDS:
        yield from (_Wish(word, 0, 1.0, api.expression(word)) for word in words())
        return
    for archetype in ARCHETYPES:
        for variant in VARIANTS[archetype]:
            for share in SHARES:
                yield _Wish(str(archetype), variant, share, scaled(archetype, variant, share))


def scaled(archetype: Archetype, variant: int, share: float) -> Profile:
    """An archetype's variant at a share of its own activation, held to the wheel."""
    profile = api.archetype(archetype, variant)
    return profile.scaled(float(np.clip(profile.activation * share, LEAST_ACTIVATION, LARGEST_ACTIVATION)))
