# SPDX-License-Identifier: BSD-3-Clause
"""Everything that takes one or many answers many as it answers each."""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

PROGRAM = Path(__file__).parent / "search" / "batches.py"


def compared(*arguments: str, timeout: int = 280) -> dict[str, Any]:
    done = subprocess.run([sys.executable, PROGRAM, *arguments], capture_output=True, text=True, check=False, timeout=timeout)
    assert done.returncode in (0, 1) and done.stdout, f"status {done.returncode}\n{done.stderr[-3000:]}"
    assert done.returncode == 0, done.stdout
    report: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    return report


def test_many_are_answered_as_each() -> None:
    report = compared()
    assert report["names"] > 120 and report["compared"] > 2_000
    assert "robust_verdict" not in report["never"]


@pytest.mark.campaign
@pytest.mark.parametrize("seed", range(20, 26))
def test_more_of_them(seed: int) -> None:
    report = compared("--calls", "20000", "--rounds", "8", "--seed", str(seed), timeout=3_000)
    assert report["compared"] > 10_000
