"""What trackers and loggers call that which says when a row is, and whose face it is of: one place for every format."""

from __future__ import annotations

import re
from collections.abc import Iterable

from ....tables import large

#: Units of time by what stands behind a name ("timestamp_ms", "Time (s)", "timeMs"), in seconds.
UNIT_NAMES = {
    **dict.fromkeys(("s", "sec", "secs", "second", "seconds"), 1.0),
    **dict.fromkeys(("ms", "msec", "msecs", "milli", "millis", "millisecond", "milliseconds"), 1e-3),
    **dict.fromkeys(("us", "usec", "usecs", "micros", "microsecond", "microseconds", "µs", "μs"), 1e-6),
    **dict.fromkeys(("ns", "nsec", "nsecs", "nanos", "nanosecond", "nanoseconds"), 1e-9),
}

#: Names of a time, without blanks, in the order in which they count; a unit may follow.
TIME_NAMES = (
    "timecode", "timestamp", "time", "t", "ts", "timestamps", "times", "frametimestamp", "frametime", "capturetime",
    "elapsedtime", "timeelapsed", "elapsed", "videotime", "mediatime", "currenttime", "devicetime", "datetime",
    "presentationtime", "performancenow", "now", "pts", "utc", "unixtime", "seconds", "sec", "secs", "milliseconds",
    "millis", "ms",
)  # fmt: skip

#: Names of a frame's number, likewise.
NUMBER_NAMES = (
    "frame", "framenumber", "frameidx", "frameindex", "frameid", "frameno", "framenum", "framecount", "framenr",
    "frames", "imageid", "imageindex", "imagenumber", "sampleid", "samplenumber", "sampleindex",
)  # fmt: skip

#: Columns that number the rows of a table that was saved again.
INDEX_NAMES = ("", "unnamed0", "index", "row", "rowid", "rownumber", "sample")

#: Columns that name the image of a row, whose name may end with a number.
IMAGE_NAMES = ("image", "img", "imagename", "imagefile", "filename", "file", "framename", "picture")

#: Names of a face's number.
FACE_NAMES = ("faceid", "face", "faceindex", "faceidx", "facenumber", "personid", "person", "subjectid", "trackid")

#: Names of the frames per second of a whole file.
RATE_NAMES = ("fps", "framerate", "framespersecond", "rate", "exportfps", "samplerate", "samplingrate", "frequency")

#: Names of what is known of a row beside its values.
ROW_NAMES = ("blendshapecount", "confidence", "success", "facescore", "score", "tracked", "istracked", "trackingstatus")

#: Names of what says whether a face was seen at all, and words for that it was not.
SEEN_NAMES = (
    "success", "tracked", "istracked", "facetracked", "detected", "facedetected", "isfacedetected", "hasface",
    "facefound", "valid", "isvalid",
)  # fmt: skip
NOT_SEEN = ("0", "0.0", "false", "no")

#: What ends the name of a frame or its image: its number, and a file's ending.
LAST_NUMBER = re.compile(r"(.*?)(\d+)(\.[A-Za-z]\w*)?")


def plain_name(name: str) -> str:
    """A name in lower case, letters and digits alone: "Frame_Number" is "framenumber"."""
    return "".join(letter for letter in name.lower() if letter.isalnum())


def time_name(name: str) -> tuple[str, float | None] | None:
    """The name of a time without its unit, and the unit in seconds, None where it names none; None: it is no time."""
    plain = plain_name(name)
    if plain in TIME_NAMES:
        return plain, UNIT_NAMES.get(plain)
    for unit, seconds in sorted(UNIT_NAMES.items(), key=lambda item: -len(item[0])):
        stem = plain.removesuffix(unit)
        stem = stem if stem in TIME_NAMES else stem.removesuffix("in")
        apart = re.search(rf"(?:[\W_]|[a-z0-9](?=[A-Z])){re.escape(unit)}\W*$", name, re.IGNORECASE)
        if stem != plain and stem in TIME_NAMES and (apart or len(unit) > 1):
            return stem, seconds
    return None


def numbers_at_end(names: Iterable[str]) -> list[float] | None:
    """The numbers in names such as "frame_0001" or "take/0001.png"; None where that is not what they are.

    What stands before must be the same in all of them.
    """
    found = [LAST_NUMBER.fullmatch(name.strip()) for name in names]
    matches = [match for match in found if match is not None]
    alike = {match[1] for match in matches}
    if len(matches) < len(found) or len(alike) != 1 or not any(letter.isalpha() for letter in alike.pop()):
        return None
    return [large(float(match[2])) for match in matches]


def first_named(names: Iterable[str], wanted: tuple[str, ...]) -> str | None:
    """The name that comes first among those wanted; None where none is there."""
    there = {plain_name(name): name for name in reversed(list(names))}
    return next((there[name] for name in wanted if name in there), None)


def time_named(names: Iterable[str]) -> tuple[str, float | None] | None:
    """The name that tells the time, and its unit in seconds; None where none does."""
    found = [(TIME_NAMES.index(known[0]), name, known[1]) for name in names if (known := time_name(name)) is not None]
    return min(found, key=lambda item: item[0])[1:] if found else None


def says_unseen(name: str, value: object) -> bool:
    """Whether a cell or an entry says that no face was seen, so that all beside it is what was seen before."""
    return plain_name(name) in SEEN_NAMES and str(value).strip().lower() in NOT_SEEN


def tells_the_frame(name: str) -> bool:
    """Whether a column or an entry says which frame it is of, or whose, and does not number the scores of one."""
    return plain_name(name) not in (*INDEX_NAMES, *ROW_NAMES, *SEEN_NAMES) and tells_of_a_row(name)


def tells_of_a_row(name: str) -> bool:
    """Whether a column says when a row is, whose it is or how sure it is, rather than what was seen."""
    plain = plain_name(name)
    others = (*NUMBER_NAMES, *INDEX_NAMES, *IMAGE_NAMES, *FACE_NAMES, *RATE_NAMES, *ROW_NAMES, *SEEN_NAMES)
    return plain in others or time_name(name) is not None
