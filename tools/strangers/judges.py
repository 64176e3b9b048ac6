"""Asks the judges about pictures, and keeps what they said: a picture's name tells all that is in it."""

from __future__ import annotations

import json
import shutil
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, TypeAlias

from environments import ENVIRONMENTS
from places import ROOT

#: Class -> probability; None where a judge found no face.
Said: TypeAlias = Mapping[str, float] | None

FACE_API, MINI_XCEPTION = "face-api", "fer"
JUDGES = (FACE_API, MINI_XCEPTION)

NEUTRAL = "neutral"


class NoJudgeError(Exception):
    """A judge cannot be asked; says why and what to do."""


def commands() -> dict[str, list[str]]:
    """Judge -> the command that reads a list of files and writes what it says.

    Raises
    ------
    NoJudgeError : the environment is not set up, or there is no Node.
    """
    environment, here, node = ENVIRONMENTS["strangers"], ROOT / "tools" / "strangers", shutil.which("node")
    if not environment.stamp.is_file():
        raise NoJudgeError(
            "the judges are not installed: run `python tools/environments.py strangers` (make strangers)"
        )
    if node is None:
        raise NoJudgeError("there is no `node` on the PATH: install Node.js 18 or later")
    return {
        FACE_API: [node, str(here / "face_api.cjs"), str(environment.path)],
        MINI_XCEPTION: [str(environment.python), str(here / "mini_xception.py")],
    }


def ask(pictures: Sequence[Path], kept: Path) -> dict[str, dict[str, Said]]:
    """Judge -> name of a picture -> what it said; asks only about what is not in the file `kept`, and adds to it.

    Raises
    ------
    NoJudgeError : there are new pictures, and a judge cannot be asked or fails.
    """
    known: dict[str, dict[str, Said]] = {judge: {} for judge in JUDGES}
    if kept.is_file():
        known |= json.loads(kept.read_text(encoding="utf-8"))
    names = {picture.name: str(picture.resolve()) for picture in pictures}
    for judge in JUDGES:
        new = [path for name, path in names.items() if name not in known[judge]]
        if new:
            heard = answer(judge, commands()[judge], new)
            known[judge] = known[judge] | {Path(path).name: said for path, said in heard.items()}
            kept.write_text(json.dumps(known, indent=0), encoding="utf-8")
    return {judge: {name: known[judge][name] for name in names} for judge in JUDGES}


def answer(judge: str, command: Sequence[str], files: Sequence[str]) -> dict[str, Any]:
    """What a judge says about files, as JSON tells it.

    Raises
    ------
    NoJudgeError : it fails.
    """
    done = subprocess.run(command, input=json.dumps(files), capture_output=True, text=True, check=False)
    if done.returncode:
        raise NoJudgeError(f"{judge} failed:\n{done.stderr.strip()}")
    answers: dict[str, Any] = json.loads(done.stdout[done.stdout.index("{") :])
    return answers
