"""Where pictures come from: a film, a folder or list of pictures, or a camera."""

from __future__ import annotations

import glob
import math
import re
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ..errors import FormatError, ParameterError, RisoriusError

#: (H, W, 3) red, green, blue.
Picture: TypeAlias = NDArray[np.uint8]

PICTURE_KINDS = (".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff", ".webp")
CAMERA = re.compile(r"camera(?::(\d+))?")

#: Pictures a second where nothing says how many.
USUAL_RATE = 25.0

MISSING = (
    "tracking needs MediaPipe: run `pip install risorius[track]` with Python 3.11 or 3.12, or on any Python "
    "`pip install risorius[track-model]` and give --model face_landmarker.task"
)


@dataclass(frozen=True, eq=False)
class Pictures:
    """Pictures in the order of time, read as they are asked for.

    Attributes
    ----------
    name : what to call the stream. fps : pictures per second; of a camera, what it promises.
    count : how many there are; None where nobody knows.
    live : whether they come from a camera now.
    frames : (seconds since the first, picture), one after another; may be gone through once.
    """

    name: str
    fps: float
    count: int | None
    live: bool
    frames: Iterator[tuple[float, Picture]]


def open_pictures(sources: Sequence[str | Path], *, fps: float | None = None, seconds: float | None = None) -> Pictures:
    """The pictures of a film; of a folder, a pattern ("shots/*.png") or a list of pictures; of "camera" or "camera:1".

    Parameters
    ----------
    fps : pictures per second; None: those of the film, or 25.
    seconds : how long to read; None: to the end, and from a camera until the reader stops.

    Raises
    ------
    RisoriusError : the extra is missing. FormatError : nothing there that can be read. ParameterError : an option
        outside its rule.
    """
    for name, value in (("fps", fps), ("seconds", seconds)):
        if value is not None and not (math.isfinite(value) and value > 0.0):
            raise ParameterError(name, "must be a positive number", value)
    if not sources:
        raise ParameterError("sources", "must be a video, images, a folder or a camera", ())
    cv2 = needed("cv2")
    camera = CAMERA.fullmatch(str(sources[0])) if len(sources) == 1 else None
    if camera is not None:
        return _camera(cv2, int(camera[1] or 0), fps, seconds)
    files = [file for source in sources for file in _files(source)]
    if len(files) == 1 and files[0].suffix.lower() not in PICTURE_KINDS:
        return _film(cv2, files[0], fps, seconds)
    rate = fps or USUAL_RATE
    files = files[: max(1, round(seconds * rate))] if seconds else files
    shown = ((number / rate, _picture(cv2, file)) for number, file in enumerate(files))
    name = files[0].stem if len(files) == 1 else files[0].resolve().parent.name
    return Pictures(_printable(name), rate, len(files), False, shown)


def needed(module: str) -> Any:
    """A module of the extra.

    Raises
    ------
    RisoriusError : it is not installed; says how to install it.
    """
    try:
        return import_module(module)
    except ImportError as missing:
        raise RisoriusError(f"{MISSING} ({missing})") from missing


def _files(source: str | Path) -> list[Path]:
    """The files that a source stands for, shot2 before shot10."""
    path = Path(source)
    if path.is_dir():
        found = [file for file in path.iterdir() if file.suffix.lower() in PICTURE_KINDS]
        missing = f"contains no images ({', '.join(PICTURE_KINDS)})"
    elif path.is_file():
        return [path]
    else:
        found = [Path(name) for name in glob.glob(str(source))]
        missing = "does not exist: give a video, images, a folder or `camera`"
    if not found:
        raise FormatError(source, missing)
    return sorted(found, key=lambda file: [(int(d or 0), t) for d, t in re.findall(r"(\d+)|(\D+)", str(file))])


def _picture(cv2: Any, file: Path) -> Picture:
    """One picture of a file."""
    seen = cv2.imdecode(np.frombuffer(file.read_bytes() or b"\0", dtype=np.uint8), cv2.IMREAD_COLOR)
    if seen is None:
        raise FormatError(file, "is not a readable image: convert it to .png, or leave it out")
    return _in_rgb(seen)


def _in_rgb(seen: Any) -> Picture:
    """A picture of OpenCV, which has blue first."""
    return np.ascontiguousarray(seen[..., ::-1], dtype=np.uint8)


def _film(cv2: Any, file: Path, fps: float | None, seconds: float | None) -> Pictures:
    """The pictures of a film."""
    film = cv2.VideoCapture(str(file))
    told = film.get(cv2.CAP_PROP_FPS)
    if not film.isOpened():
        raise FormatError(file, "is not a readable video: convert it to .mp4, or extract its frames to a folder")
    rate = fps or (told if math.isfinite(told) and told > 0.0 else USUAL_RATE)
    count = int(max(film.get(cv2.CAP_PROP_FRAME_COUNT), 0)) or None
    most = round(seconds * rate) if seconds else None

    def frames() -> Iterator[tuple[float, Picture]]:
        number = 0
        try:
            while most is None or number < most:
                there, seen = film.read()
                if not there:
                    break
                yield number / rate, _in_rgb(seen)
                number += 1
        finally:
            film.release()
        if number == 0:
            raise FormatError(file, "is a video without frames: is it damaged?")

    return Pictures(_printable(file.stem), rate, min(filter(None, (count, most)), default=None), False, frames())


def _camera(cv2: Any, number: int, fps: float | None, seconds: float | None) -> Pictures:
    """What a camera sees from now on."""
    camera = cv2.VideoCapture(number)
    if not camera.isOpened():
        raise RisoriusError(
            f"camera {number} cannot be opened: connect it, close programs that use it, or try camera:1"
        )
    told = camera.get(cv2.CAP_PROP_FPS)

    def frames() -> Iterator[tuple[float, Picture]]:
        start, last = time.monotonic(), -1.0
        try:
            while seconds is None or time.monotonic() - start < seconds:
                there, seen = camera.read()
                if not there:
                    break
                now = time.monotonic() - start
                if now > last:
                    last = now
                    yield now, _in_rgb(seen)
        finally:
            camera.release()

    rate = fps or (told if math.isfinite(told) and told > 0.0 else USUAL_RATE)
    count = round(seconds * rate) if seconds else None
    return Pictures(f"camera {number}", rate, count, True, frames())


def _printable(name: str) -> str:
    """A name as the header of a stream may hold it."""
    return "".join(letter for letter in name if letter.isprintable()) or "pictures"
