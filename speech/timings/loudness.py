"""A sound without timings: the mouth opens as loud as it is. A stopgap, and it says so."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scipy.ndimage import gaussian_filter1d
from scipy.signal import find_peaks

from ...arrays import Floats
from ...errors import FormatError
from ...files import read_bytes
from ..phonemes import Phoneme
from ..utterance import Sound, Utterance
from ..waves import read_wav

#: Seconds of a window of loudness, and over which it is smoothed: shorter than a syllable, longer than a period.
WINDOW, SMOOTH = 0.01, 0.025
#: Seconds between syllables at the least: fast talkers speak some eight in a second.
APART = 0.11
#: Loudness that counts as full and as silence, in hundredths of all windows; of full, the least that is heard.
FULL, SILENCE, HEARD = 95.0, 10.0, 0.12
#: The viseme of an open mouth, and what it is called.
OPEN, NAME = 10, "loud"

SAID = "the mouth follows loudness alone, not the sounds: give their times for lips that close and round"


def is_wav(data: bytes) -> bool:
    """Whether bytes begin as a WAV file does."""
    return data[:4] == b"RIFF" and data[8:12] == b"WAVE"


def is_other_sound(data: bytes) -> bool:
    """Whether bytes begin as a sound does that is no WAV file: Ogg, FLAC, MP3, MP4, AIFF."""
    begins = data[:4] in (b"OggS", b"fLaC", b"FORM") or data[:3] == b"ID3" or data[4:8] == b"ftyp"
    return begins or (data[:1] == b"\xff" and data[1:2] in (b"\xfb", b"\xf3", b"\xf2"))


def loudness_utterance(path: str | Path) -> Utterance:
    """An open mouth for each syllable that is heard in a WAV file, as wide as it is loud.

    Raises
    ------
    FormatError : it is no WAV file of whole samples, or silent.
    """
    file = Path(path)
    loud = _loudness(file)
    quiet, full = np.percentile(loud, [SILENCE, FULL])
    level = np.clip((loud - quiet) / max(full - quiet, 1e-12), 0.0, 1.2) if full > 0.0 else np.zeros_like(loud)
    peaks, _ = find_peaks(level, height=HEARD, distance=max(round(APART / WINDOW), 1), prominence=HEARD / 2.0)
    if not len(peaks):
        raise FormatError(file, "is silent: there is nothing to say")
    sounds: list[Sound] = []
    for peak in peaks.tolist():
        first, last = _heard(level, peak)
        start, end = max(first * WINDOW, sounds[-1].end if sounds else 0.0), last * WINDOW
        if end > start:
            phoneme = Phoneme(NAME, OPEN, jaw=float(np.sqrt(level[peak])), vowel=True)
            sounds.append(Sound(start, end, phoneme, NAME))
    return Utterance(tuple(sounds), len(loud) * WINDOW, assumed=(SAID,))


def _heard(level: Floats, peak: int) -> tuple[int, int]:
    """Windows around a peak in which it is at least half as loud."""
    soft = level < 0.5 * level[peak]
    before, after = np.flatnonzero(soft[:peak]), np.flatnonzero(soft[peak:])
    return int(before[-1]) + 1 if len(before) else 0, peak + int(after[0]) if len(after) else len(level)


def _loudness(path: Path) -> Floats:
    """(T,) root mean square of each window, smoothed."""
    channels, rate = read_wav(read_bytes(path), path)
    samples = channels.mean(axis=1)
    size = max(round(WINDOW * rate), 1)
    windows = samples[: len(samples) // size * size].reshape(-1, size)
    if not len(windows):
        raise FormatError(path, "is too short to be heard")
    return np.asarray(gaussian_filter1d(np.sqrt((windows**2).mean(axis=1)), SMOOTH / WINDOW))
