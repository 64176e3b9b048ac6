"""The same pose and motion in every Python and Blender that is set up here, to a thousandth of a millimetre."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from environments import ENVIRONMENTS

#: What each computes: two drives, an emotion, and a motion.
SCRIPT = """
import sys
import numpy as np
import risorius.api as api
face = api.default_face()
joy, fear = api.expression("joy"), api.expression("fear", activation=6.0)
clip = face.simulate(api.envelope(joy, onset=0.4, apex=0.2, offset=0.4, fps=10.0), fps=10.0)
poses = [face.pose(joy.frame(), emotion=joy.weights), face.pose(fear.frame(), drive="exact")]
np.savez(sys.argv[1], motion=clip.positions[::3], poses=[pose.positions for pose in poses],
         achieved=[pose.achieved for pose in poses])
print(np.__version__, sys.version.split()[0])
"""
PYTHONS = {name: place.python for name, place in ENVIRONMENTS.items() if name == "dev" or name.startswith("bpy-")}


def computed(python: Path, path: Path) -> dict[str, np.ndarray]:
    """What one Python computes."""
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    run = subprocess.run(
        [python, "-W", "error::DeprecationWarning:risorius", "-c", SCRIPT, path],
        env=environment, capture_output=True, text=True, timeout=250, check=False,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr[-2000:]
    assert "Deprecat" not in run.stderr, run.stderr[-2000:]
    with np.load(path) as found:
        return {name: found[name] for name in found.files}


@pytest.fixture(scope="module")
def here(tmp_path_factory: pytest.TempPathFactory) -> dict[str, np.ndarray]:
    """What this Python computes."""
    return computed(Path(sys.executable), tmp_path_factory.mktemp("here") / "here.npz")


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name, python in PYTHONS.items() if python != Path(sys.executable)])
def test_another_python_computes_the_same(name: str, here: dict[str, np.ndarray], tmp_path: Path) -> None:
    python = PYTHONS[name]
    if not python.exists():
        pytest.skip(f"the environment {name} is not set up")
    there = computed(python, tmp_path / "there.npz")
    for what in ("poses", "motion"):
        assert np.abs(there[what] - here[what]).max() < 1e-6, what
    np.testing.assert_allclose(there["achieved"], here["achieved"], atol=0.05)
