"""The command line: argparse over `api`, `track` and `batch`, and over the jobs of `scene` for what needs Blender.

`risorius VERB`, `python -m risorius VERB` and `blender --command risorius VERB` are the same. Exit code 0 on success,
2 on wrong usage, 1 otherwise. With `--json` the result is one JSON object on standard output.

emotions       profile
faces          measure, points
films          bake, render, demo: they need Blender
batch          batch: many clips and stills from a table
recognition    recognise
streams        fap
speech         say
recordings     options of reading a recording, and what was assumed to read it
animation_tables    tables
capture        import
exports        export
track          track
options        what several verbs share
faps           FAPs for people and as JSON
result         what a verb has to say, for people and as JSON
kept           prepared faces, out of the user's cache folder
progress       how far it is, on standard error
"""

from __future__ import annotations

import argparse
import contextlib
import json
import sys
from typing import TextIO

from ..errors import RisoriusError
from ..resources import version
from .animation_tables import add_table_verb
from .batch import add_batch_verb
from .capture import add_capture_verb
from .emotions import add_emotion_verbs
from .exports import add_export_verb
from .faces import add_face_verbs
from .films import add_film_verbs
from .recognition import add_recognition_verb
from .result import Result, UsageError, plain
from .speech import add_speech_verb
from .streams import add_stream_verb, with_action
from .track import add_track_verb

DESCRIPTION = "Animate a face from an emotion word and an activation."

#: The exit code of what Ctrl+C has stopped: 128 and the number of the signal, as shells have it.
STOPPED = 130


def main(argv: list[str] | None = None) -> int:
    """Run one verb and print its result.

    Parameters
    ----------
    argv : the arguments after the program's name; by default those of this process.

    Returns
    -------
    int
        0 on success, 2 on wrong usage, 1 on any error that Risorius raises on purpose, or where jobs of a batch failed;
        130 where the user has stopped it.
    """
    parser = _parser()
    given = with_action(sys.argv[1:] if argv is None else argv)
    try:
        for argument in given:
            if "\0" in argument:
                parser.error("an argument must not hold a null character")
            if argument.startswith("--") and argument.endswith("=--"):  # argparse makes an empty list of it
                parser.error(f"{argument[:-3]} needs a value, not --")
        arguments = parser.parse_args(given)
    except SystemExit as ended:  # argparse has said why
        return int(ended.code or 0)
    try:
        result: Result = arguments.run(arguments)
    except UsageError as error:
        print(_fit_for(sys.stderr, f"risorius {arguments.verb}: {error}"), file=sys.stderr)
        return 2
    except (RisoriusError, OSError) as error:
        print(_fit_for(sys.stderr, f"risorius {arguments.verb}: {error}"), file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print(f"risorius {arguments.verb}: stopped", file=sys.stderr)
        return STOPPED
    with contextlib.suppress(BrokenPipeError):  # the reader (head, less) has seen enough
        said = json.dumps(plain(result.data), indent=1) if arguments.json else "\n".join(map(str, result.lines))
        print(_fit_for(sys.stdout, said), flush=True)
    return result.code


def _fit_for(stream: TextIO, text: str) -> str:
    """A text with what a stream cannot write (a pipe on Windows, a terminal without UTF-8) as escapes."""
    encoding = getattr(stream, "encoding", None) or "utf-8"
    return text.encode(encoding, "backslashreplace").decode(encoding)


def _parser() -> argparse.ArgumentParser:
    """All verbs and their options."""
    parser = argparse.ArgumentParser(prog="risorius", description=DESCRIPTION)
    parser.add_argument("--version", action="version", version=f"risorius {version()}")
    verbs = parser.add_subparsers(dest="verb", required=True, metavar="VERB")
    add_emotion_verbs(verbs)
    add_stream_verb(verbs)
    add_speech_verb(verbs)
    add_table_verb(verbs)
    add_track_verb(verbs)
    add_film_verbs(verbs)
    add_batch_verb(verbs)
    add_face_verbs(verbs)
    add_capture_verb(verbs)
    add_export_verb(verbs)
    add_recognition_verb(verbs)
    return parser
