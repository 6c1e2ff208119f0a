# SPDX-License-Identifier: BSD-3-Clause
"""A guidance law of your own in a scenario, flown in steps, and the proof that what it flew keeps away."""
import pathlib

import numpy as np
import numpy.typing as npt

import vericone as vc
from vericone import guidance, simulation as sim

scenarios = pathlib.Path(__file__).resolve().parents[2] / "docs/examples/scenarios"
scenario = vc.read_scenario(scenarios / "clearance.yaml")
agent, *others = [sim.Track(b.shape, b.start, b.orientation, b.appears) for b in scenario.bodies]
step, keep, most = 0.02, 1.0, 15.0  # s, m, m/s^2


def law(me: guidance.BodyState, seen: list[guidance.BodyState]) -> npt.NDArray[np.float64]:
    """m/s^2, across the velocity: away from whom it will pass too near, and soonest."""
    misses = [vc.pair_of(me.shape, it.shape).miss(me.velocity, it.velocity) for it in seen]
    near = [miss for miss in misses if miss.least < keep]
    if not near:
        return np.zeros(3)
    away = min(near, key=lambda miss: float(miss.time)).gradient_velocity()  # m per m/s: where the distance grows
    away = away - away @ me.velocity / (me.velocity @ me.velocity) * me.velocity
    size = np.linalg.norm(away)
    return np.asarray(most * away / size) if size > 1e-9 else np.zeros(3)


count = round(scenario.duration / step)
for other in others:
    other.advance([0, 0, 0], count * step)
for i in range(count):
    agent.advance(law(agent.state(i * step), [other.state(i * step) for other in others]), (i + 1) * step)
for other in others:
    proof = sim.prove(agent, other, 0, count * step)
    print("%s: %.3f m or more, between the steps too" % (proof.verdict, proof.least_distance))
    assert proof.verdict == sim.ProofVerdict.avoided
