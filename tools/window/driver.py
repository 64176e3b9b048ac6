"""A real Blender window driven from outside: pointer and keyboard as a person uses them, questions by script.

with Window(tool, settings, folder) as window:
    window.ask("result = len(bpy.data.objects)")
    window.click(*window.pixel_of("WINDOW", 0.5, 0.5))
    window.shot(path)
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from types import TracebackType
from typing import Any

from deprecated import deprecations
from places import ROOT, shared_folder

SERVED = Path(__file__).with_name("served.py")
#: Seconds for an answer, for what is waited for, and for setting a Blender up.
ANSWER, PATIENCE, SET_UP = 60.0, 120.0, 1200.0
HEIGHT = 900


class WindowError(Exception):
    """The window did not do what was asked; says what Blender said."""


class NoSharedBlenderError(Exception):
    """Why the shared program that keeps a Blender of its own is of no use here."""


def shared_blender() -> Path:
    """The shared program that keeps a Blender of its own, with a virtual screen; its Blender is set up.

    Raises
    ------
    NoSharedBlenderError
        it is not there, this is not root, or its Blender cannot be set up.
    """
    tool = shared_folder() / "tools" / "blender-gui"
    if not tool.is_file():
        raise NoSharedBlenderError(f"{tool} is not there: set RISORIUS_SHARED to the folder that has it")
    if not hasattr(os, "geteuid") or os.geteuid() != 0:
        raise NoSharedBlenderError("a Blender with a virtual screen needs root")
    try:
        done = call(tool, "setup", settings=Path("/tmp"), timeout=SET_UP)
    except subprocess.TimeoutExpired:
        raise NoSharedBlenderError(f"setting up its Blender took more than {SET_UP / 60:.0f} minutes") from None
    if done.returncode:
        raise NoSharedBlenderError(f"its Blender cannot be set up: {(done.stderr or done.stdout).strip()[-300:]}")
    return tool


def call(tool: Path, *arguments: str, settings: Path, timeout: float = 300.0) -> subprocess.CompletedProcess[str]:
    """One call of the tool, with a settings folder of our own."""
    environment = {**os.environ, "BLENDER_USER_RESOURCES": str(settings)}
    command = [sys.executable, str(tool), *arguments]
    return subprocess.run(
        command, cwd=ROOT, env=environment, capture_output=True, text=True, timeout=timeout, check=False
    )


class Window:
    """One Blender window.

    Parameters
    ----------
    tool : the program that opens a Blender window on a virtual screen.
    settings : Blender's settings folder. folder : where requests and answers go.
    """

    def __init__(self, tool: Path, settings: Path, folder: Path) -> None:
        self.tool, self.settings, self.folder = tool, settings, folder
        self._asked = 0

    def __enter__(self) -> Window:
        self.folder.mkdir(parents=True, exist_ok=True)
        self.call("start", "--python", str(SERVED), "--", str(self.folder))
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        said = deprecations(self.log())
        self.call("stop", check=False)
        if said and error is None:
            raise WindowError("the extension uses what a later Blender takes away:\n" + "\n".join(said))

    def call(self, *arguments: str, check: bool = True) -> str:
        """One call of the tool; returns what it said."""
        done = call(self.tool, *arguments, settings=self.settings)
        if check and done.returncode:
            raise WindowError(f"{' '.join(arguments)}: {done.stdout}{done.stderr}")
        return done.stdout

    def ask(self, code: str) -> Any:
        """Run a script in Blender; returns the JSON of what it has put into `result`."""
        self._asked += 1
        request = self.folder / f"{self._asked:05d}.py"
        draft = request.with_suffix(".writing")
        draft.write_text(code)
        draft.rename(request)
        answer = self.folder / f"{self._asked:05d}.json"
        until = time.monotonic() + ANSWER
        while not answer.exists():
            if time.monotonic() > until:
                raise WindowError(f"no answer to {code!r}; Blender said:\n{self.log()[-3000:]}")
            time.sleep(0.02)
        said = json.loads(answer.read_text())
        if "error" in said:
            raise WindowError(said["error"])
        return said["result"]

    def wait(self, expression: str, patience: float = PATIENCE) -> Any:
        """Ask again and again until an expression is true; returns it."""
        until = time.monotonic() + patience
        while True:
            found = self.ask(f"result = {expression}")
            if found:
                return found
            if time.monotonic() > until:
                raise WindowError(f"{expression} did not come true; Blender said:\n{self.log()[-3000:]}")
            time.sleep(0.1)

    def pixel_of(self, region: str, x: float, y: float) -> tuple[int, int]:
        """The window's pixel at a share of a region of the 3D viewport: from its left and from its top."""
        left, low, width, height = self.ask(f"r = viewport()[2][{region!r}]; result = [r.x, r.y, r.width, r.height]")
        return round(left + x * width), round(HEIGHT - low - (1.0 - y) * height)

    def click(self, x: int, y: int, button: int = 1) -> None:
        """Press and release."""
        self.call("click", str(x), str(y), str(button))

    def drag(self, start: tuple[int, int], end: tuple[int, int]) -> None:
        """Press, move, release."""
        self.call("drag", *(str(number) for number in (*start, *end)))

    def key(self, *keys: str) -> None:
        """Press keys, as "ctrl+z"."""
        self.call("key", *keys)

    def shot(self, path: Path) -> Path:
        """A picture of the window."""
        path.parent.mkdir(parents=True, exist_ok=True)
        self.call("shot", str(path))
        return path

    def log(self) -> str:
        """What Blender printed."""
        return self.call("log", check=False)

    def eventually(self, check: Callable[[], bool], patience: float = PATIENCE) -> None:
        """Wait until something outside of Blender is so."""
        until = time.monotonic() + patience
        while not check():
            if time.monotonic() > until:
                raise WindowError(f"it did not happen; Blender said:\n{self.log()[-3000:]}")
            time.sleep(0.1)
