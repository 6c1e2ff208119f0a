# SPDX-License-Identifier: BSD-3-Clause
"""The notebooks run from their first cell to their last, in a process of their own, and their asserts hold. They are kept
with their outputs, pictures too, for readers who run nothing. VERICONE_NOTEBOOK_OUTPUT names a folder for what the run
made, to look at; examples/notebooks brings what is kept up to date."""
import os
import re
import sys
from pathlib import Path
from typing import Any

import pytest

nbformat = pytest.importorskip("nbformat", reason="Debian's python3-nbformat is not installed")
nbclient = pytest.importorskip("nbclient", reason="Debian's python3-nbclient is not installed")
pytest.importorskip("ipykernel", reason="Debian's python3-ipykernel is not installed")
pytest.importorskip("matplotlib", reason="Debian's python3-matplotlib is not installed")

ROOT = Path(os.environ.get("VERICONE_SOURCE", Path(__file__).resolve().parents[2]))
sys.path.append(str(ROOT / "tests/support"))
from drawn import drawn  # noqa: E402

NOTEBOOKS = sorted((ROOT / "examples" / "notebooks").glob("*.ipynb"))


def read(file: Path) -> Any:
    return nbformat.read(file, as_version=4)


def test_there_are_six() -> None:
    assert [file.stem[0] for file in NOTEBOOKS] == list("123456")


def executed(file: Path, folder: Path) -> Any:
    """The notebook as it is after a run in a folder."""
    notebook = read(file)
    nbclient.NotebookClient(notebook, timeout=120, kernel_name="python3", record_timing=False,
                            resources={"metadata": {"path": str(folder)}}).execute()
    return notebook


def code_of(notebook: Any) -> list[Any]:
    return [cell for cell in notebook.cells if cell.cell_type == "code"]


def words(cell: Any) -> list[tuple[list[str], str]]:
    """What a cell shows, without its numbers, of which some are times: kinds of outputs, and texts. A kernel sends one
    text in as many messages as its timer likes."""
    shown: list[tuple[list[str], str]] = []
    for output in cell.outputs:
        data, text = sorted(output.get("data", {})), output.get("text", "")
        if shown and not data and not shown[-1][0]:
            text = shown.pop()[1] + text
        shown.append((data, text))
    return [(data, re.sub(r"[-+]?[\d.]+(e[-+]\d+)?", "#", text)) for data, text in shown]


@pytest.mark.parametrize("file", drawn(NOTEBOOKS, 2), ids=lambda file: str(file.stem))
def test_runs(file: Path) -> None:
    notebook = executed(file, ROOT)
    shown = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    folder = os.environ.get("VERICONE_NOTEBOOK_OUTPUT")
    if folder:
        nbformat.write(notebook, Path(folder) / file.name)
    assert len([output for output in shown if "image/png" in output.get("data", {})]) >= 2
    code = "\n".join(cell.source for cell in code_of(notebook))
    assert code.count("assert ") >= 4
    if file.stem[0] in "45" and not (ROOT / "build/scans").is_dir():
        return  # what is kept was run with scans
    for cell, kept in zip(code_of(notebook), code_of(read(file)), strict=True):
        assert words(cell) == words(kept), cell.source


@pytest.mark.parametrize("file", drawn((file for file in NOTEBOOKS if file.stem[0] in "45"), 2), ids=lambda file: str(file.stem))
def test_runs_without_scans(file: Path, tmp_path: Path) -> None:
    """It says that there are none, and takes a body of its own."""
    notebook = executed(file, tmp_path)
    assert "no scan here" in "".join(output.get("text", "") for cell in notebook.cells for output in cell.get("outputs", []))


@pytest.mark.parametrize("file", NOTEBOOKS, ids=lambda file: str(file.stem))
def test_keeps_one_whole_run(file: Path) -> None:
    notebook = read(file)
    nbformat.validate(notebook)
    assert [cell.execution_count for cell in code_of(notebook)] == list(range(1, len(code_of(notebook)) + 1))
    assert file.stat().st_size < 800_000
