# SPDX-License-Identifier: BSD-3-Clause
"""What a type checker says of the package, of the examples and of the code in notebooks; what the stubs say of the modules."""

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def checked(source: Path, tmp_path_factory: pytest.TempPathFactory) -> Callable[..., str]:
    """What mypy prints of files that use the package; "" where it finds nothing. One cache: most of a run is numpy."""
    cache = tmp_path_factory.mktemp("mypy")

    def check(*arguments: str | Path) -> str:
        done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--no-error-summary", "--config-file", source / "pyproject.toml",
                               "--cache-dir", cache, *arguments], capture_output=True, text=True, check=False,
                              env=os.environ | {"MYPYPATH": os.environ["PYTHONPATH"]})
        return done.stdout + done.stderr

    return check


def test_the_package_is_typed(checked: Callable[..., str]) -> None:
    assert checked("-p", "vericone") == ""


def test_examples_are_typed(source: Path, checked: Callable[..., str]) -> None:
    files = sorted((source / "examples/python").glob("*.py"))
    assert files
    assert checked(*files) == ""


def test_code_in_notebooks_is_typed(source: Path, checked: Callable[..., str], tmp_path: Path) -> None:
    """Each notebook as one program, its cells in their order, without the lines for IPython alone."""
    files = []
    for notebook in sorted((source / "examples/notebooks").glob("*.ipynb")):
        cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
        lines = [line for cell in cells if cell["cell_type"] == "code" for line in "".join(cell["source"]).split("\n") if not line.startswith(("%", "!"))]
        files.append(tmp_path / (notebook.stem.replace("-", "_") + ".py"))
        files[-1].write_text("\n".join(lines) + "\n", encoding="utf-8")
    assert files
    assert checked(*files) == ""


def test_wrong_types_are_noticed(checked: Callable[..., str], tmp_path: Path) -> None:
    """The types say something: a pair of numbers is refused, and what comes back is known."""
    file = tmp_path / "wrong.py"
    file.write_text("import vericone\nvericone.Pair(1.0, 2.0)\n"
                    "x: str = vericone.Ellipsoid.from_axes([0, 0, 0], [1, 1, 1]).volume()\n", encoding="utf-8")
    told = checked(file)
    assert "wrong.py:2" in told and "wrong.py:3" in told


def has_stub(name: str, build: Path) -> bool:
    """Whether the module that a full name is in has a stub: others are their own."""
    parts = name.split(".")
    while parts:
        path = build / "python" / Path(*parts)
        if path.with_suffix(".pyi").exists() or (path / "__init__.pyi").exists():
            return True
        if path.with_suffix(".py").exists() or (path / "__init__.py").exists():
            return False
        parts.pop()
    return True


def test_stubs_agree_with_the_modules(source: Path, build: Path, tmp_path: Path) -> None:
    """mypy's stubtest, without exceptions, of all modules that have a stub."""
    done = subprocess.run([sys.executable, "-m", "mypy.stubtest", "vericone", "--concise", "--mypy-config-file", source / "pyproject.toml"],
                          cwd=tmp_path, capture_output=True, text=True, check=False, env=os.environ | {"MYPYPATH": os.environ["PYTHONPATH"]})
    told = [line for line in done.stdout.splitlines() if line.startswith("vericone")]
    assert done.returncode == 0 or told, (done.stdout + done.stderr)[-6000:]
    assert [line for line in told if has_stub(line.split()[0], build)] == []
