# SPDX-License-Identifier: BSD-3-Clause
"""Nothing that Python passes crashes the interpreter, and only documented exceptions come back.

Everything is called in a process of its own (any_calls.py), which can die without taking the test with it."""

import json
import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

sys.path.append(str(Path(__file__).resolve().parents[1] / "support"))
from drawn import drawn  # noqa: E402

PROGRAM = Path(__file__).parent / "search" / "any_calls.py"


def called(tmp_path: Path, calls: int, seed: int, timeout: int, *more: str) -> dict[str, Any]:
    log = tmp_path / "call"
    done = subprocess.run([sys.executable, PROGRAM, "--calls", str(calls), "--seed", str(seed), "--log", log, *more], capture_output=True,
                          text=True, check=False, timeout=timeout)
    last = log.read_text(encoding="utf-8") if log.exists() else "before the first call"
    died = f"status {done.returncode} in call {last}\n{done.stderr[-4000:]}"
    if done.returncode < 0:
        died = f"{signal.Signals(-done.returncode).name}: {died}"
    assert done.returncode in (0, 1) and done.stdout, died
    report: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    report["text"] = done.stdout
    return report


# Those of a group are called most in one process, which takes as long to begin as for 1,000 calls.
SPACES = ["", "exact.,files.,fits.,octomap.,scanning.", "fitting.,guidance.,vision.", "lidar.,montecarlo.,scenario.,scenes.",
          "simulation.,vehicles."]


@pytest.mark.parametrize("spaces", drawn(SPACES, 2))
def test_any_object_shape_and_dtype(tmp_path: Path, spaces: str) -> None:
    report = called(tmp_path, 1_000 * len(spaces.split(",")) if spaces else 3_000, 1, 280, "--most", spaces)
    assert report["faults"] == 0, report["text"]
    # Not only refusals: enough calls got through.
    assert report["answered"] > 0.1 * report["calls"]


def test_what_hypothesis_chooses(tmp_path: Path) -> None:
    report = called(tmp_path, 1_000, 3, 280, "--hypothesis", "500")
    assert report["faults"] == 0, report["text"]


@pytest.mark.campaign
@pytest.mark.parametrize("seed", range(10, 20))
def test_a_million_calls(tmp_path: Path, seed: int) -> None:
    report = called(tmp_path, 100_000, seed, 3_000)
    assert report["faults"] == 0, report["text"]


def test_the_search_finds_what_is_planted(tmp_path: Path) -> None:
    """A package with a function that crashes and one that raises what it should not: both are found."""
    folder = tmp_path / "vericone"
    folder.mkdir()
    (folder / "__init__.py").write_text(
        "import ctypes\nclass InputError(ValueError):\n    field = value = requirement = 'x'\n"
        "def wrong(a: float) -> float:\n    raise KeyError(a)\n", encoding="utf-8")
    environment = os.environ | {"PYTHONPATH": str(tmp_path)}
    command = [sys.executable, str(PROGRAM), "--calls", "200", "--bare"]
    found = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert found.returncode == 1 and "wrong: KeyError" in found.stdout, found.stdout + found.stderr
    with open(folder / "__init__.py", "a", encoding="utf-8") as file:
        file.write("def crash(a: float) -> float:\n    return ctypes.string_at(0)\n")
    found = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    # A sanitizer reports the crash itself, and ends the program.
    died = 1 if "address" in os.environ.get("VERICONE_SANITIZE", "") else -signal.SIGSEGV
    assert found.returncode == died and "crash" in found.stderr, found.stdout + found.stderr
