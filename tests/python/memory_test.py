# SPDX-License-Identifier: BSD-3-Clause
"""A call leaves no memory behind, whether it is answered or refused."""

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

PROGRAM = Path(__file__).parent / "search" / "leaks.py"

pytestmark = pytest.mark.skipif("VERICONE_PRELOAD" in os.environ, reason="sanitizers count for themselves what is allocated")


def leaks(*arguments: str, path: str = "", timeout: int = 280) -> dict[str, Any]:
    environment = os.environ | {"PYTHONMALLOC": "malloc"} | ({"PYTHONPATH": path} if path else {})
    done = subprocess.run([sys.executable, PROGRAM, *arguments], env=environment, capture_output=True, text=True, check=False, timeout=timeout)
    assert done.returncode in (0, 1) and done.stdout, f"status {done.returncode}\n{done.stderr[-3000:]}"
    report: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    return report


def test_calls_leave_nothing_behind() -> None:
    report = leaks("--calls", "2500", "--repeats", "40")
    assert report["leaks"] == {}
    assert report["names"] > 100


@pytest.mark.campaign
def test_a_million_calls_leave_nothing_behind() -> None:
    report = leaks("--calls", "100000", "--repeats", "1000", timeout=3000)
    assert report["leaks"] == {}
    assert report["calls"] >= 1_000_000


def test_a_planted_leak_is_found(tmp_path: Path) -> None:
    folder = tmp_path / "vericone"
    folder.mkdir()
    (folder / "__init__.py").write_text("class InputError(ValueError):\n    field = value = requirement = 'x'\nkept = []\n"
                                        "def leaky(a: float) -> None:\n    kept.append(bytes(20))\n"
                                        "def tight(a: float) -> float:\n    return 0.0\n", encoding="utf-8")
    report = leaks("--calls", "200", path=str(tmp_path))
    assert set(report["leaks"]) == {"leaky"} and report["names"] >= 2
