"""The page of speed: its tables say what the figures say."""

from __future__ import annotations

import numpy as np
import pytest
from speed import growth, page


def head(name: str, vertices: int) -> dict[str, object]:
    phase = {"seconds": 0.02, "longest": 0.02, "during": "", "memory": 100.0}
    return {
        "head": name,
        "vertices": vertices,
        "seconds_per_frame": 0.01,
        "phases": {"prepare": phase, "compress": phase},
        "bytes": {"compress": 2e6},
        "bandwidth": 1e10,
        "blender": {"version": "9.9", "vertices": 500, "cloth": 0.08, "soft body": 0.1, "XPBD cloth": "it has none"},
        "error": {"worst": 0.0071, "rms": 0.002},
    }


def test_a_head_is_compared_per_frame_and_per_vertex() -> None:
    (row,) = page.motion_table([head("ict.npz", 1000)]).splitlines()[2:]
    assert row == "| ict | 1,000 | 10 | 8.0 | 16.0 | 10.0 | - | 0.71 % | 0.20 % |"
    assert page.why_not([head("ict.npz", 1000)]) == "Measured in Blender 9.9.\nXPBD cloth: it has none.\n"


def test_a_phase_has_its_share_of_the_bandwidth() -> None:
    said = page.phase_table([head("default", 1000), head("ict.npz", 3000)])
    assert "| compress | 20 | 1.0 % | 20 | 1.0 % |" in said
    assert "| prepare | 20 | - | 20 | - |" in said
    assert "10 GB/s" in said


@pytest.mark.parametrize("power", [0.5, 1.0, 1.3])
def test_a_power_law_is_found(power: float) -> None:
    sizes = np.array([1e4, 1e5, 5e5])
    assert growth.exponent(sizes, 3e-6 * sizes**power) == pytest.approx(power)


def test_a_drag_has_its_median_and_what_most_stay_below() -> None:
    drags = {"word": {"median": 7.96, "most": 11.0}, "wheel": {"median": 8.0, "most": 12.25}}
    said = page.drag_table([{"head": "ict", "vertices": 25959, "steps": 40, "drags": drags}])
    assert "| head | vertices | word | wheel |" in said
    assert "| ict | 25,959 | 8.0, 11.0 ms | 8.0, 12.2 ms |" in said


def test_a_kept_face_is_shown_before_its_pose_is_worked_out() -> None:
    row = {"head": "ict.npz", "vertices": 1000, "read": 0.1, "prepare": 2.0, "pose": 0.2}
    said = page.first_table([{**row, "kept_read": 0.25, "kept_sketch": 0.05, "kept_pose": 0.4}])
    assert "| ict | 1,000 | 0.10 s | 2.00 s | 0.20 s | 2.30 s | 0.30 s | 0.40 s |" in said
