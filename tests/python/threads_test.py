# SPDX-License-Identifier: BSD-3-Clause
"""Eight threads on shared objects get the answers of one; and while the library works, Python goes on."""

import copy
import json
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any, Callable

import numpy as np
import pytest

import vericone

PROGRAM = Path(__file__).parent / "search" / "same_answers.py"
THREADS = 8
SANITIZED = "VERICONE_PRELOAD" in os.environ


def at_once(work: Callable[[int], Any], threads: int = THREADS) -> list[Any]:
    """What `work` returns in each thread, all started together."""
    results: list[Any] = [None] * threads
    errors: list[BaseException] = []
    start = threading.Barrier(threads)

    def run(i: int) -> None:
        start.wait()
        try:
            results[i] = work(i)
        except BaseException as error:  # pylint: disable=broad-except
            errors.append(error)

    started = [threading.Thread(target=run, args=(i,)) for i in range(threads)]
    for thread in started:
        thread.start()
    for thread in started:
        thread.join()
    if errors:
        raise errors[0]
    return results


def test_every_call_answers_the_same() -> None:
    done = subprocess.run([sys.executable, PROGRAM, "--calls", "2500" if SANITIZED else "5000", "--threads", str(THREADS)], capture_output=True,
                          text=True, check=False, timeout=280)
    assert done.returncode in (0, 1) and done.stdout, f"status {done.returncode}\n{done.stderr[-6000:]}"
    report = json.loads(done.stdout.splitlines()[-1])
    assert report["differ"] == [], done.stdout
    assert report["compared"] > 100


def bodies() -> dict[str, Any]:
    rng = np.random.default_rng(3)
    points = rng.normal(size=(40, 3))
    ellipsoid = vericone.Ellipsoid.from_axes([0, 0, 0], [1, 1, 0.5])
    hull = vericone.HullBody(points)
    cloud = vericone.Assembly.cloud(points, 0.1)
    return {"ellipsoid": ellipsoid, "hull": hull, "cloud": cloud}


@pytest.mark.parametrize("kind", ["ellipsoid", "hull", "cloud"])
def test_a_pair_is_shared(kind: str) -> None:
    agent = vericone.Placed(vericone.Body(vericone.Ellipsoid.from_axes([0, 0, 0], [1, 0.5, 0.5])), vericone.Pose())
    obstacle = vericone.Placed(vericone.Body(bodies()[kind]), vericone.Pose(position=[10, 0, 0]))
    pair = vericone.Pair(agent, obstacle)
    velocities = np.random.default_rng(4).normal(size=(400, 3)) + [3, 0, 0]
    still = np.zeros(3)
    serial = pair.verdict(velocities, still), pair.miss(velocities, still)
    for verdicts, misses in at_once(lambda i: (pair.verdict(velocities, still, threads=1 + i % 2), pair.miss(velocities, still))):
        assert np.array_equal(verdicts, serial[0])
        assert misses.tobytes() == serial[1].tobytes()


def test_the_first_question_of_many_threads() -> None:
    """What is prepared at the first question is prepared once, whoever asks."""
    for _ in range(20):
        pair = vericone.Pair(*(vericone.Placed(vericone.Body(vericone.HullBody(np.random.default_rng(i).normal(size=(30, 3)))),
                                               vericone.Pose(position=[8 * i, 0, 0])) for i in range(2)))
        answers = at_once(lambda _: pair.verdict([1, 0.1, 0], [0, 0, 0]))
        assert len(set(answers)) == 1


@pytest.mark.skipif(SANITIZED, reason="a sanitizer changes what takes how long")
def test_python_goes_on_while_the_library_works() -> None:
    pair = vericone.ConeOracle(vericone.Ellipsoid.from_axes([0, 0, 0], [1, 1, 0.5]), vericone.Ellipsoid.from_axes([10, 2, 0], [2, 3, 1]))
    velocities = np.random.default_rng(5).normal(size=(3_000_000, 3))
    ticks, busy = 0, threading.Event()

    def work() -> None:
        busy.set()
        for _ in range(20):
            pair.membership(velocities)
        busy.clear()

    thread = threading.Thread(target=work)
    thread.start()
    busy.wait()
    while busy.is_set():
        ticks += 1
        time.sleep(0.001)
    thread.join()
    # Held for a whole call of some 20 ms, the lock would leave one tick or two a call.
    assert ticks > 60


LONG = """
import signal, sys, time, numpy as np, vericone
{setup}
print("ready", flush=True)
began = time.perf_counter()
try:
    {call}
    print("ended", time.perf_counter() - began)
except KeyboardInterrupt:
    print("interrupted", time.time())
"""
PAIR = """
pair = vericone.Pair(vericone.Placed(vericone.Body(vericone.Ellipsoid.from_axes([0, 0, 0], [1, 1, 0.5])), vericone.Pose()),
                     vericone.Placed(vericone.Body(vericone.Assembly.cloud(np.random.default_rng(1).normal(size=(20000, 3)), 0.05)),
                                     vericone.Pose(position=[10, 0, 0])))
velocities = np.random.default_rng(2).normal(size=(3_000_000, 3)) * [0.1, 1, 1] + [5, 0, 0]
"""


@pytest.mark.skipif(SANITIZED, reason="a sanitizer changes what takes how long")
@pytest.mark.parametrize(("setup", "call"), [
    (PAIR, "pair.verdict(velocities, [0, 0, 0])"),
    (PAIR, "pair.miss(velocities, [0, 0, 0], threads=2)"),
    (PAIR, "pair.cone(vericone.ConeOptions(resolution=1e-5))"),
])
def test_an_interruption_ends_a_long_call(setup: str, call: str) -> None:
    with subprocess.Popen([sys.executable, "-c", LONG.format(setup=setup, call=call)], stdout=subprocess.PIPE, text=True) as child:
        assert child.stdout
        assert child.stdout.readline() == "ready\n"
        time.sleep(0.7)
        sent = time.time()
        child.send_signal(signal.SIGINT)
        words = child.stdout.read().split()
    assert words[0] == "interrupted", words
    # 0.3 s are promised on a quiet machine.
    assert float(words[1]) - sent < 1.0


def test_what_changes_is_used_by_one_call_at_a_time() -> None:
    """Also where it is an argument, is copied or printed: others read it while one thread changes it."""
    simulation, filters = vericone.simulation, vericone.guidance.SingerFilter()
    filters.start(np.zeros(6), np.eye(6), 0)
    still = simulation.Motion()

    def track(at: float) -> Any:
        return simulation.Track(simulation.ShapeInTime(simulation.RigidShape(vericone.CombinedEllipsoid(vericone.Ellipsoid()))), still.replace(position=[at, 0, 0]),
                                simulation.Orientation.fixed, 0.0)

    moving, other = track(0), track(10)
    moving.advance([0, 0, 0], 1.0)
    other.advance([0, 0, 0], 1.0)

    def work(i: int) -> list[Any]:
        found = []
        for step in range(1, 41):
            if i == 0:
                filters.step(None, np.eye(2), 0.1 * step)
                moving.advance([0.1, 0, 0], moving.end() + 1)
            else:
                found.append((filters.position().tolist(), repr(copy.copy(moving))[:1], simulation.prove(moving, other, 0, 1), len(moving.legs()) > 0))
        return found

    answers = at_once(work)
    assert all(answer == answers[1][0] for found in answers[1:] for answer in found)
    assert moving.end() == 41


def test_a_machine_that_cannot_have_so_many_threads() -> None:
    """Asked for more threads than there can be, the questions are answered by those that there are."""
    program = """
import resource, numpy as np, vericone
pair = vericone.Pair(vericone.Ellipsoid(), vericone.Ellipsoid.from_axes([10, 2, 0], [2, 3, 1]))
velocities = np.random.default_rng(1).normal(size=(20_000, 3))
expected = pair.verdict(velocities, [0, 0, 0])
used = int(next(line for line in open("/proc/self/status") if line.startswith("VmSize")).split()[1]) * 1024
resource.setrlimit(resource.RLIMIT_AS, (used + 2**26, used + 2**26))
assert np.array_equal(pair.verdict(velocities, [0, 0, 0], threads=1000), expected)
print("as before")
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert done.stdout == "as before\n", f"status {done.returncode}\n{done.stderr}"
