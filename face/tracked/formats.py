"""The formats of streams and recordings."""

from __future__ import annotations

from enum import StrEnum

from ...errors import ParameterError

#: Endings of files that are read, and that are written.
READABLE = (".fap", ".fba", ".json", ".jsonl", ".csv", ".tsv", ".txt", ".log")
WRITABLE = (".fap", ".fba", ".json", ".csv")


class StreamFormat(StrEnum):
    """What a file of FAPs, or of what trackers saw, may be.

    fap, fba, json, faps : the standard's text and bit stream; FAPs as JSON and as a CSV table, as Risorius writes them.
    openface, py_feat, arkit, mediapipe : scores of trackers, as CSV or JSON. landmarks : points of a face mesh.
    """

    FAP = "fap"
    FBA = "fba"
    JSON = "json"
    FAPS = "faps"
    OPENFACE = "openface"
    PY_FEAT = "py_feat"
    ARKIT = "arkit"
    MEDIAPIPE = "mediapipe"
    LANDMARKS = "landmarks"

    @classmethod
    def of(cls, name: str) -> StreamFormat:
        """The format of that name; ParameterError lists the names."""
        try:
            return cls(name)
        except ValueError:
            raise ParameterError("format", f"must be one of {', '.join(cls)}", str(name)) from None
