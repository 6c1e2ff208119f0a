# SPDX-License-Identifier: BSD-3-Clause
"""Every overload of every public function, class and method answers at least one call.

They are asked in a process of their own (every_overload.py), which can die without taking the test with it."""

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

PROGRAM = Path(__file__).parent / "search" / "every_overload.py"


def test_every_overload_answers() -> None:
    overloads = Path(os.environ["VERICONE_BUILD"]) / "python" / "overloads.json"
    done = subprocess.run([sys.executable, PROGRAM, overloads], capture_output=True, text=True, check=False, timeout=280)
    died = f"status {done.returncode}\n{done.stdout[-2000:]}\n{done.stderr[-4000:]}"
    assert done.returncode in (0, 1) and done.stdout, died
    report: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    print("\n".join(report["examples_failed"] + report["missing"]))
    # Those of what has no other part than the core alone.
    assert report["overloads"] > 600
    assert report["examples_failed"] == []
    assert report["missing"] == []
