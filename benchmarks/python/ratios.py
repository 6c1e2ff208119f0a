#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""ratios.py BUILD [--rounds N] [--velocities N]: what a question costs through Python, against the library's own loop in
C++, round by round in one run. BUILD is a build folder with the package and vericone_python_peer.

Each row is measured once a round; a ratio is the median of the ratios within the rounds. The bars are requirements: the
last column says whether they are met, and the exit status is 1 where one is not."""

import argparse
import ctypes
import os
import statistics
import subprocess
import sys
import time
import zipfile
from pathlib import Path
from typing import Any, Callable

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def seconds(action: Callable[[], object]) -> float:
    began = time.perf_counter()
    action()
    return time.perf_counter() - began


def sphere(parallels: int, meridians: int) -> tuple[Floats, NDArray[np.uint32]]:
    """Points and triangles of a ball of radius 2 m about (10, 2, 0)."""
    rows = [[np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)] for t in np.linspace(0, np.pi, parallels)
            for p in np.linspace(0, 2 * np.pi, meridians, endpoint=False)]
    faces = []
    for i in range(parallels - 1):
        for j in range(meridians):
            a, b = i * meridians + j, i * meridians + (j + 1) % meridians
            faces += [[a, b, b + meridians], [a, b + meridians, a + meridians]]
    return 2 * np.array(rows) + [10, 2, 0], np.array(faces, dtype=np.uint32)


class Table:
    """Rows of (name, what Python does, what it is measured against, the bar of the ratio)."""

    def __init__(self, rounds: int) -> None:
        self.rounds = rounds
        self.failed = False
        print(f"{'question':44s} {'Python':>10s} {'C++':>10s} {'ratio':>6s} {'bar':>6s}")

    def row(self, name: str, count: int, ours: Callable[[], object], peer: Callable[[], object], bar: float, at_least: bool = False) -> None:
        """Times a question, in nanoseconds; the ratio is ours to the peer's, or, `at_least`, the peer's to ours."""
        ours(), peer()
        pairs = [(seconds(ours), seconds(peer)) for _ in range(self.rounds)]
        ratio = statistics.median((b / a if at_least else a / b) for a, b in pairs)
        a, b = (statistics.median(column) / count * 1e9 for column in zip(*pairs))
        met = ratio >= bar if at_least else ratio <= bar
        self.failed |= not met
        print(f"{name:44s} {a:8.1f}ns {b:8.1f}ns {ratio:6.2f} {'>=' if at_least else '<='}{bar:4.1f} {'' if met else 'not met'}", flush=True)

    def value(self, name: str, value: float, unit: str, bar: float) -> None:
        met = value <= bar
        self.failed |= not met
        print(f"{name:44s} {value:8.3g} {unit:21s} <={bar:4.3g} {'' if met else 'not met'}", flush=True)


def import_seconds(folder: Path) -> float:
    """Of the package where numpy is there already: the least of 15 processes of their own."""
    def once() -> float:
        program = "import time, numpy\nbegan = time.perf_counter()\nimport vericone\nprint(time.perf_counter() - began)"
        return float(subprocess.run([sys.executable, "-c", program], check=True, capture_output=True, text=True,
                                    env=os.environ | {"PYTHONPATH": str(folder)}).stdout)
    return min(once() for _ in range(15))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", type=Path)
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument("--velocities", type=int, default=1_000_000)
    options = parser.parse_args()
    sys.path.insert(0, str(options.build.resolve() / "python"))
    import vericone

    peer = ctypes.CDLL(str(next((options.build / "benchmarks").glob("libvericone_python_peer*"))))

    def at(array: NDArray[Any]) -> ctypes.c_void_p:
        return ctypes.c_void_p(array.ctypes.data)

    n = options.velocities
    rng = np.random.default_rng(1)
    # Half of them near the line of sight, where they collide.
    w: Floats = rng.normal(size=(n, 3)) * [1.0, 3.0, 3.0] + [10.0, 2.0, 0.0]
    bytes_out, doubles_out = np.zeros(n, np.int8), np.zeros(n)
    agent = vericone.Ellipsoid.from_axes([0, 0, 0], [1, 1, 0.5])
    obstacle = vericone.Ellipsoid.from_axes([10, 2, 0], [2, 3, 1])
    oracle, pair = vericone.ConeOracle(agent, obstacle), vericone.Pair(agent, obstacle)
    table = Table(options.rounds)

    def memberships() -> None:
        peer.memberships(at(w), ctypes.c_size_t(n), at(bytes_out))

    memberships()
    assert np.array_equal(oracle.membership(w), bytes_out)
    table.row("membership, C order", n, lambda: oracle.membership(w), memberships, 1.2)
    fortran, strided = np.asfortranarray(w), np.repeat(w, 2, axis=0)[::2]
    table.row("membership, Fortran order", n, lambda: oracle.membership(fortran), memberships, 1.5)
    table.row("membership, strides", n, lambda: oracle.membership(strided), memberships, 1.5)
    single = w.astype(np.float32)
    exact = single.astype(np.float64)
    table.row("membership, float32", n, lambda: oracle.membership(single),
              lambda: peer.memberships(at(exact), ctypes.c_size_t(n), at(bytes_out)), 1.5)
    table.row("membership, two threads against one", n, lambda: oracle.membership(w, threads=2), lambda: oracle.membership(w), 1.7, True)

    def verdicts() -> None:
        peer.verdicts(at(w), ctypes.c_size_t(n), at(bytes_out))

    still = np.zeros(3)
    verdicts()
    assert np.array_equal(pair.verdict(w, still), bytes_out)
    table.row("Pair.verdict", n, lambda: pair.verdict(w, still), verdicts, 1.2)
    table.row("Pair.verdict, two threads against one", n, lambda: pair.verdict(w, still, threads=2), lambda: pair.verdict(w, still), 1.7, True)

    few = n // 5
    part = np.ascontiguousarray(w[:few])

    def clearances() -> None:
        peer.clearances(at(part), ctypes.c_size_t(few), at(doubles_out))

    clearances()
    assert np.array_equal(vericone.clearance(agent, obstacle, part).distance, doubles_out[:few], equal_nan=True)
    table.row("clearance", few, lambda: vericone.clearance(agent, obstacle, part), clearances, 1.2)

    def times() -> None:
        peer.times_to_contact(at(part), ctypes.c_size_t(few), at(doubles_out))

    times()
    assert np.array_equal(vericone.time_to_contact(agent, obstacle, part), doubles_out[:few], equal_nan=True)
    table.row("time_to_contact", few, lambda: vericone.time_to_contact(agent, obstacle, part), times, 1.2)

    points: Floats = rng.normal(size=(100, 3)) + [10, 2, 0]
    hull = vericone.Pair(agent, vericone.HullBody(points))

    def hulls() -> None:
        peer.hull_memberships(at(points), ctypes.c_size_t(len(points)), at(part), ctypes.c_size_t(few), at(bytes_out))

    hulls()
    assert np.array_equal(hull.verdict(part, still), bytes_out[:few])
    table.row("Pair.verdict, hull of 100 points", few, lambda: hull.verdict(part, still), hulls, 1.2)

    vertices, faces = sphere(60, 100)
    mesh = vericone.Pair(agent, vericone.Assembly.mesh(vertices, faces))
    some = n // 50
    least = np.ascontiguousarray(w[:some])

    def meshes(count: int = some) -> None:
        peer.mesh_memberships(at(vertices), ctypes.c_size_t(len(vertices)), at(faces), ctypes.c_size_t(len(faces)), at(least),
                              ctypes.c_size_t(count), at(bytes_out))

    meshes()
    assert np.array_equal(mesh.verdict(least, still), bytes_out[:some])
    # What it takes to prepare the mesh is on both sides.
    table.row(f"Pair.verdict, mesh of {len(faces)} triangles", some,
              lambda: vericone.Pair(agent, vericone.Assembly.mesh(vertices, faces)).verdict(least, still), meshes, 1.2)

    one, repeated = w[0].copy(), 100_000

    def calls() -> None:
        ask = oracle.membership
        for _ in range(repeated):
            ask(one)

    calls()
    table.value("one call", statistics.median(seconds(calls) for _ in range(options.rounds)) / repeated * 1e6, "us", 1.5)
    table.value("import vericone, without numpy's own", import_seconds(options.build / "python"), "s", 0.15)
    for wheel in options.build.glob("*.whl"):
        table.value("wheel", sum(i.compress_size for i in zipfile.ZipFile(wheel).infolist()) / 1e6, "MB", 15)
    return 1 if table.failed else 0


if __name__ == "__main__":
    sys.exit(main())
