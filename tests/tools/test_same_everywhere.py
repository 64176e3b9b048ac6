"""The same pose and motion in every Python and Blender that is set up here, to a thousandth of a millimetre."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from environments import ENVIRONMENTS, ensure_link
from window.driver import NoSharedBlenderError, shared_blender

#: What each computes: two drives, an emotion, and a motion. Blender itself hands its arguments over after `--`.
SCRIPT = """
import sys
package, target = sys.argv[-2:]
sys.path.insert(0, package)
import numpy as np
import risorius.api as api
face = api.default_face()
joy, fear = api.expression("joy"), api.expression("fear", activation=6.0)
clip = face.simulate(api.envelope(joy, onset=0.4, apex=0.2, offset=0.4, fps=10.0), fps=10.0)
poses = [face.pose(joy.frame(), emotion=joy.weights), face.pose(fear.frame(), drive="exact")]
np.savez(target, motion=clip.positions[::3], poses=[pose.positions for pose in poses],
         achieved=[pose.achieved for pose in poses])
print(np.__version__, sys.version.split()[0])
"""
STRICT = ("-W", "error::DeprecationWarning:risorius", "-W", "error::FutureWarning:risorius")
#: Blenders that a shared program keeps: its arguments before those of the script.
SHARED = {"shared 5.2": ("background", "--python-exit-code", "1", "--python"), "shared 5.3": ("bpy53", *STRICT)}
PYTHONS = {name: place.python for name, place in ENVIRONMENTS.items() if name == "dev" or name.startswith("bpy-")}


def command_of(name: str) -> list[str]:
    """How to run a script in an environment or in a Blender of the shared program; skipped where it is not here."""
    if name in SHARED:
        try:
            return [sys.executable, str(shared_blender()), *SHARED[name]]
        except NoSharedBlenderError as absent:
            pytest.skip(str(absent))
    if not PYTHONS[name].exists():
        pytest.skip(f"the environment {name} is not set up")
    return [str(PYTHONS[name]), *STRICT]


def computed(command: list[str], folder: Path) -> dict[str, np.ndarray]:
    """What one Python computes."""
    script, target = folder / "script.py", folder / "found.npz"
    script.write_text(SCRIPT, encoding="utf-8")
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    run = subprocess.run(
        [*command, script, "--", ensure_link(), target],
        env=environment, capture_output=True, text=True, timeout=280, check=False,
    )  # fmt: skip
    assert run.returncode == 0, (run.stdout + run.stderr)[-2000:]
    assert "deprecat" not in (run.stdout + run.stderr).lower(), (run.stdout + run.stderr)[-2000:]
    with np.load(target) as found:
        return {name: found[name] for name in found.files}


@pytest.fixture(scope="module")
def here(tmp_path_factory: pytest.TempPathFactory) -> dict[str, np.ndarray]:
    """What this Python computes."""
    return computed([sys.executable, *STRICT], tmp_path_factory.mktemp("here"))


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name, path in PYTHONS.items() if path != Path(sys.executable)] + [*SHARED])
def test_another_python_computes_the_same(name: str, here: dict[str, np.ndarray], tmp_path: Path) -> None:
    there = computed(command_of(name), tmp_path)
    for what in ("poses", "motion"):
        assert np.abs(there[what] - here[what]).max() < 1e-6, what
    np.testing.assert_allclose(there["achieved"], here["achieved"], atol=0.05)
