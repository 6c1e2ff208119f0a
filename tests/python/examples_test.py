# SPDX-License-Identifier: BSD-3-Clause
"""The scripts of examples/python run, and print what they say."""
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(os.environ.get("VERICONE_SOURCE", Path(__file__).resolve().parents[2]))
PRINTED = {
    "front_door": "in after 0.500000 s\n",
    "batches": "% collide\n",
    "many_obstacles": "there after ",
    "through_an_opening": "blocked",
    "exact_rationals": "on\nin\nout\n",
    "scene_files": "refused: agent.semi_axes[1]\n",
    "own_law": "avoided: ",
    "own_pilot": "mine and law avoided: ",
    "swarm": "0 pairs touched, 0 undecided; 11 of 11 arrived\n",
    "plan_by_gradient": "m or more, proved\n",
}


def test_all_are_here() -> None:
    assert {file.stem for file in (ROOT / "examples" / "python").glob("*.py")} == set(PRINTED)


@pytest.mark.parametrize("name", PRINTED)
def test_runs(name: str, tmp_path: Path) -> None:
    script = ROOT / "examples" / "python" / (name + ".py")
    done = subprocess.run([sys.executable, str(script)], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert PRINTED[name] in done.stdout
