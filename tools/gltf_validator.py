"""Khronos' glTF validator, fetched once into the checkout by the machine's own npm, and run on a file.

    python3 tools/gltf_validator.py FILE [FILE ...]

prints what it finds. Needs Node.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from environments import SetUpError
from places import ROOT

FOLDER = ROOT / ".venv-gltf-validator"
PACKAGE = "gltf-validator@2.0.0-dev.3.10"

#: Reads a file and those that it names beside it; prints the report as JSON.
SCRIPT = """
const fs = require("fs"), path = require("path"), validator = require("gltf-validator");
const file = process.argv[process.argv.length - 1];
const beside = uri => fs.promises.readFile(path.join(path.dirname(file), decodeURIComponent(uri)));
validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {
  uri: path.basename(file), maxIssues: 0, externalResourceFunction: async uri => new Uint8Array(await beside(uri)),
}).then(report => console.log(JSON.stringify(report)));
"""

#: What the validator calls how bad an issue is.
SEVERITIES = ("error", "warning", "information", "hint")


@dataclass(frozen=True)
class Issue:
    """What the validator has found at one place of a file."""

    severity: str
    code: str
    place: str
    text: str

    def __str__(self) -> str:
        """As a line."""
        return f"{self.severity}: {self.place}: {self.text} ({self.code})"


def ensure_validator() -> Path:
    """The folder of the validator, fetched where it is missing.

    Raises
    ------
    SetUpError : this machine has no Node, or npm could not fetch it.
    """
    node, npm = shutil.which("node"), shutil.which("npm")
    if node is None or npm is None:
        raise SetUpError("glTF files are validated where Node and npm are installed (Debian: nodejs npm)")
    if not (FOLDER / "node_modules" / "gltf-validator" / "package.json").exists():
        FOLDER.mkdir(exist_ok=True)
        command = [npm, "install", "--no-audit", "--no-fund", "--no-save", "--prefix", str(FOLDER), PACKAGE]
        try:
            done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=120)
        except subprocess.TimeoutExpired as slow:
            raise SetUpError("npm did not fetch the glTF validator in two minutes; it needs the network once") from slow
        if done.returncode:
            raise SetUpError(f"npm could not fetch the glTF validator: {done.stderr.strip()[-300:]}")
    return FOLDER


def validate(path: Path) -> list[Issue]:
    """Everything that the validator finds in a .glb or .gltf file, the worst first.

    Raises
    ------
    SetUpError : as `ensure_validator`.
    """
    folder = ensure_validator()
    command = ["node", "-e", SCRIPT, "--", str(path.resolve())]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True)
    messages = json.loads(done.stdout)["issues"]["messages"]
    found = [
        Issue(SEVERITIES[entry["severity"]], entry["code"], entry.get("pointer", ""), entry["message"])
        for entry in messages
    ]
    return sorted(found, key=lambda issue: SEVERITIES.index(issue.severity))


def main(paths: list[str]) -> int:
    """Validate files; 1 where one has errors."""
    issues = []
    for path in paths:
        found = validate(Path(path))
        print(path, *(map(str, found) if found else ["nothing found"]), sep="\n  ")
        issues += found
    return int(any(issue.severity == "error" for issue in issues))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
