# SPDX-License-Identifier: BSD-3-Clause
"""vericone.campaign by executors: processes, MPI (mpi4py), dask. Each is skipped where it is not installed."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from concurrent.futures import Executor, Future, ProcessPoolExecutor
from pathlib import Path
from typing import Any, Callable

import pytest

import vericone
from vericone import montecarlo

SETTINGS = montecarlo.Campaign(engagements=330, seed=7, laws=["clearance"])  # seven blocks
UNTYPED: Any = vericone


@pytest.fixture(scope="module")
def alone(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """The table by threads of one process."""
    folder = tmp_path_factory.mktemp("alone")
    assert vericone.campaign(SETTINGS, out=folder).finished
    return (folder / "engagements.csv").read_bytes()


def test_processes_fly_the_same(tmp_path: Path, alone: bytes) -> None:
    with ProcessPoolExecutor(2) as executor:
        stopped = vericone.campaign(SETTINGS, out=tmp_path, executor=executor, progress=lambda share: share < 0.4)
        assert not stopped.finished and 0 < len(stopped.rows) < 330
        shares: list[float] = []
        found = vericone.campaign(SETTINGS, out=tmp_path, executor=executor, progress=shares.append)
        assert found.finished and found.summary.engagements == 330 and shares[0] * 330 > len(stopped.rows)
        assert (tmp_path / "engagements.csv").read_bytes() == alone
        assert vericone.campaign(SETTINGS, executor=executor).rows.tolist().__repr__() == found.rows.tolist().__repr__()


def test_mpi_flies_the_same(tmp_path: Path, alone: bytes) -> None:
    pytest.importorskip("mpi4py", reason="not installed: python3-mpi4py")
    if not shutil.which("mpirun"):
        pytest.skip("not installed: openmpi-bin")
    (tmp_path / "fly.py").write_text(
        "from mpi4py.futures import MPIPoolExecutor\nimport vericone\nfrom vericone import montecarlo\n"
        "if __name__ == '__main__':\n"
        "    with MPIPoolExecutor() as executor:\n"
        "        settings = montecarlo.Campaign(engagements=330, seed=7, laws=['clearance'])\n"
        "        assert executor.submit(max, 1, 2).result() == 2\n"
        "        assert vericone.campaign(settings, out='flown', executor=executor).finished\n")
    environment = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}
    done = subprocess.run(["mpirun", "--oversubscribe", "--allow-run-as-root", "-n", "3", sys.executable, "-m", "mpi4py.futures",
                           "fly.py"], cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=200, check=False)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "flown/engagements.csv").read_bytes() == alone


def test_dask_flies_the_same(tmp_path: Path, alone: bytes) -> None:
    distributed = pytest.importorskip("distributed", reason="not installed: python3-distributed")
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None, local_directory=str(tmp_path)) as cluster, \
            distributed.Client(cluster) as client:
        assert vericone.campaign(SETTINGS, out=tmp_path / "flown", executor=client.get_executor()).finished
    assert (tmp_path / "flown/engagements.csv").read_bytes() == alone


class Here(Executor):
    """What it is given is done at once, and then changed."""

    def __init__(self, change: Callable[[str], str]) -> None:
        self.change = change

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        future: Future[Any] = Future()
        try:
            future.set_result(self.change(fn(*args, **kwargs)))
        except Exception as error:  # pylint: disable=broad-except
            future.set_exception(error)
        return future


def test_what_workers_do_wrong_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(RuntimeError, match="got 49 rows for those from 0 to 50"):
        vericone.campaign(SETTINGS, out=tmp_path, executor=Here(lambda rows: rows[rows.index("\n") + 1:]))
    assert not (tmp_path / "engagements.csv").exists()
    with pytest.raises(TypeError, match="executor: got int, must be a concurrent.futures.Executor, or None"):
        UNTYPED.campaign(SETTINGS, executor=3)
    # A worker of another version is refused.
    worker = UNTYPED._runs._engagements
    monkeypatch.setattr(UNTYPED._runs, "_engagements", lambda settings, first, end, version: worker(settings, first, end, "0.0.0"))
    with pytest.raises(RuntimeError, match="a worker has vericone .*, who asks has 0.0.0"):
        vericone.campaign(SETTINGS, executor=Here(str))
