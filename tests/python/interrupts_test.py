# SPDX-License-Identifier: BSD-3-Clause
"""Ctrl-C ends every long call within 0.3 s: KeyboardInterrupt in a child process that gets SIGINT while C++ works."""

from __future__ import annotations

import signal
import subprocess
import sys
import time

import pytest

# What each does is long enough by far; `call` must still be at work when the signal comes.
MAKE = """
import numpy as np, vericone
from vericone import *
from vericone import files, fitting, lidar, montecarlo, simulation
random = np.random.default_rng(1)
def ball(n, scale=1.0):
    x = random.normal(size=(n, 3))
    return scale * x / np.linalg.norm(x, axis=1)[:, None]
def ellipsoid(center, axes=(1, 1, 1)):
    return Ellipsoid.from_axes(center, axes)
def star(center):
    return CombinedEllipsoid(ellipsoid(center, (2, 2, 1)), [hyperboloid(2, [0.9, 0.8, 0.8]), hyperboloid(2, [0.9, 0.8, 0.8],
        rotation_from_heading(1.2, 0.4))])
def scenario(duration=1e5, step=0.01):
    def body(name, x, v):
        return simulation.Body(name=name, shape=simulation.ShapeInTime(simulation.RigidShape(CombinedEllipsoid(ellipsoid([0, 0, 0])))),
                               start=simulation.Motion(position=x, velocity=v))
    return simulation.Scenario(name="long", duration=duration, step=step,
                               bodies=[body("A", [0, 0, 0], [1, 0, 0]), body("B", [1e7, 1, 0], [-1, 0, 0])])
"""

CALLS = {
    "simulate": ("s = scenario()", "vericone.simulate(s)"),
    "campaign": ("", "vericone.campaign(montecarlo.Campaign(engagements=10**6))"),
    "campaign with a folder": ("import tempfile; d = tempfile.mkdtemp()",
                               "vericone.campaign(montecarlo.Campaign(engagements=10**6), out=d)"),
    "fit": ("x = ball(60000) * [3, 2, 1]", "vericone.fit(x, shape='star', mode='least-squares')"),
    "containing fit": ("x = np.concatenate([ball(50000) + [1.5, 0, 0], ball(50000) - [1.5, 0, 0]])", "vericone.fit(x)"),
    "minimum-volume ellipsoid": ("x = ball(10**6)", "[min_volume_ellipsoid(x) for _ in range(100)]"),
    "cone of a mesh": ("x = ball(3000) + [9, 0, 0]; p = Pair(Placed(Body(ellipsoid([0, 0, 0]))), Placed(Body(Assembly.cloud(x, 0.02))))",
                       "[p.cone(ConeOptions(resolution=1e-4)) for _ in range(100)]"),
    "cone of two clouds": ("x = ball(300); p = Pair(Placed(Body(Assembly.cloud(x, 0.1))), Placed(Body(Assembly.cloud(x + [9, 0, 0], 0.1))))",
                           "[p.cone(ConeOptions(resolution=1e-4)) for _ in range(100)]"),
    # Steps of Open3D and Qhull hear nothing, and take seconds here: they are left behind.
    "fusion": ("x = ball(150000) * [3, 2, 1]; s = [x, ball(150000) * [3, 2, 1] + 0.02]",
               "[lidar.fuse(s, [np.eye(4), np.eye(4)]) for _ in range(100)]"),
    "distances": ("x = ball(60000); r = vericone.fit(x[:100], shape='biconvex'); s = fitting.Sample(points=x)",
                  "[fitting.scan_to_hull(r.pieces, s) for _ in range(1000)]"),
    "certificate": ("x = ball(60000); r = vericone.fit(x[:100], shape='biconvex'); s = fitting.Sample(points=x)",
                    "[fitting.check([p.quadrics for p in r.pieces], s) for _ in range(1000)]"),
    "combined cone": ("a, b = star([0, 0, 0]), star([6, 1, 0])", "[Pair(a, b).cone(ConeOptions(tolerance=1e-9)) for _ in range(100)]"),
    "slice cone": ("a, b = ellipsoid([0, 0, 0], (3, 2, 1)), ellipsoid([9, 0, 0])", "[slice_cone(a, b, 1000000) for _ in range(9)]"),
    "combined slice cone": ("a, b = star([0, 0, 0]), star([6, 1, 0])", "[combined_slice_cone(a, b, 1000000) for _ in range(9)]"),
    "trees": ("x = ball(2 * 10**6)", "[Assembly.cloud(x, 0.1) for _ in range(20)]"),
    "surface": ("a = star([0, 0, 0])", "[surface(a, 0.005) for _ in range(50)]"),
    "reading": ("import tempfile, os; f = os.path.join(tempfile.mkdtemp(), 'a.xyz'); files.write_points(f, ball(2 * 10**6))",
                "[files.read_points(f) for _ in range(20)]"),
    "writing": ("import tempfile, os; f = os.path.join(tempfile.mkdtemp(), 'a.xyz'); x = ball(10**6)",
                "[files.write_points(f, x) for _ in range(20)]"),
    "arc": ("m = simulation.Motion(velocity=[2, 0.2, 0])", "simulation.Arc(m, [0, 0.1, 2**31], simulation.Orientation.fixed, 0, 2)"),
    "road": ("r = simulation.squircle_road([0, 0], 10, 0.5, 20)", "simulation.curves_of(r, 0, 0, 5, 1e-300)"),
    "batch": ("p = Pair(Placed(Body(ellipsoid([0, 0, 0]))), Placed(Body(ellipsoid([9, 0, 0])))); w = ball(2 * 10**6)",
              "[p.miss(w, [0, 0, 0]) for _ in range(100)]"),
    "batch in threads": ("p = Pair(Placed(Body(ellipsoid([0, 0, 0]))), Placed(Body(ellipsoid([9, 0, 0])))); w = ball(2 * 10**6)",
                         "[p.miss(w, [0, 0, 0], threads=2) for _ in range(100)]"),
    "LiDAR": ("x = ball(30000) + [9, 0, 0]; m = lidar.MeshScene(x, np.arange(30000, dtype=np.uint32).reshape(-1, 3))\n"
              "l = lidar.Lidar(beams=lidar.raster(3000, 3000, 3.0, 3.0))", "[lidar.scan(m, l, np.eye(4), 1) for _ in range(50)]"),
}
PROGRAM = MAKE + """
import sys, time
{make}
print("ready", flush=True)
try:
    {call}
except KeyboardInterrupt:
    print("interrupted", time.time(), flush=True)
    {after}
else:
    print("finished", time.time(), flush=True)
"""


def interrupted_after(make: str, call: str, wait: float, after: str = "pass") -> float:
    """Seconds from the signal to KeyboardInterrupt."""
    program = PROGRAM.format(make=make, call=call, after=after)
    child = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        assert child.stdout is not None
        ready = child.stdout.readline()
        if ready != "ready\n":
            pytest.fail(child.communicate(timeout=60)[1][-2000:])
        time.sleep(wait)
        sent = time.time()
        child.send_signal(signal.SIGINT)
        out, err = child.communicate(timeout=60)
    finally:
        child.kill()
    word, _, when = out.splitlines()[0].partition(" ") if out else ("", "", "")
    assert word == "interrupted", out + err[-2000:]
    assert child.returncode == 0, err[-2000:]
    return float(when) - sent


@pytest.mark.parametrize("name", CALLS)
def test_ctrl_c_ends_it(name: str) -> None:
    make, call = CALLS[name]
    # Once more where the machine itself did not give the child its turn.
    seconds = interrupted_after(make, call, 0.5)
    assert seconds < 0.3 or interrupted_after(make, call, 0.5) < 0.3


def test_what_was_interrupted_can_be_asked_again() -> None:
    after = "s2 = vericone.simulate(s.replace(duration=0.01)); assert not s2.interrupted"
    assert interrupted_after("s = scenario()", "vericone.simulate(s)", 0.3, after) < 0.6


def test_a_signal_of_another_handler_is_heard() -> None:
    make = """
import signal
class Alarm(Exception): pass
def ring(*_): raise Alarm("rang")
signal.signal(signal.SIGALRM, ring)
signal.setitimer(signal.ITIMER_REAL, 0.3)
s = scenario()
def call():
    try: vericone.simulate(s)
    except Alarm: raise KeyboardInterrupt
"""
    program = PROGRAM.format(make=make, call="call()", after="pass")
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60, check=False)
    assert done.stdout.splitlines()[1].startswith("interrupted"), done.stderr
