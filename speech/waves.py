"""WAV files: samples in and out."""

from __future__ import annotations

import io
import wave
from pathlib import Path

import numpy as np

from ..arrays import Floats
from ..errors import FormatError

#: The largest whole number of 16 bits.
LOUDEST = 32767


def read_wav(data: bytes, path: Path) -> tuple[Floats, int]:
    """(n, c) samples from -1 to 1 of a WAV file, and how many in a second.

    Raises
    ------
    FormatError : it is no WAV file of whole samples.
    """
    try:
        with wave.open(io.BytesIO(data), "rb") as file:
            rate, width, channels = file.getframerate(), file.getsampwidth(), file.getnchannels()
            held = file.readframes(file.getnframes())
    except (EOFError, wave.Error) as error:
        raise FormatError(path, f"is no WAV file of whole samples ({error}): convert it to 16-bit WAV") from error
    if width not in (1, 2, 4):
        raise FormatError(path, f"has samples of {8 * width} bits: convert it to 16-bit WAV")
    kind = np.dtype({1: "u1", 2: "<i2", 4: "<i4"}[width])
    samples = np.frombuffer(held[: len(held) // (width * channels) * width * channels], kind).astype(np.float64)
    samples = (samples - 128.0) / 128.0 if width == 1 else samples / float(2 ** (8 * width - 1))
    return samples.reshape(-1, channels), rate


def wav_of(samples: Floats, rate: int) -> bytes:
    """A WAV file of 16 bits of samples (n, c) from -1 to 1."""
    held = io.BytesIO()
    with wave.open(held, "wb") as file:
        file.setnchannels(samples.shape[1])
        file.setsampwidth(2)
        file.setframerate(rate)
        file.writeframes(np.round(np.clip(samples, -1.0, 1.0) * LOUDEST).astype("<i2").tobytes())
    return held.getvalue()
