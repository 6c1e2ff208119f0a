# SPDX-License-Identifier: BSD-3-Clause
"""Agents that give way to each other, one of them by a law of your own; every pair of the flight is proved."""
import numpy as np
import numpy.typing as npt

from vericone import guidance, swarm


def hurries(t: float, me: guidance.BodyState, others: list[guidance.BodyState]) -> npt.NDArray[np.float64]:
    """m/s^2: straight to its goal, minding nobody. What is flown of it is proved as of all others."""
    return np.array([1.0, 0, 0]) if me.velocity[0] < 1.5 else np.zeros(3)


start = swarm.start_of("circle", agents=10, seed=1)
agents = [*start.agents, swarm.Agent(body=swarm.Solid.ball(1.5), position=[-30, 0, 0], goals=[[40, 0, 0]], steering=hurries)]
flight = swarm.fly(swarm.Swarm(agents, start.obstacles, swarm.SwarmOptions()), swarm.FlightOptions(duration=120))
print("%d pairs touched, %d undecided; %d of %d arrived" % (
    len(flight.touched), len(flight.undecided), np.isfinite(flight.arrived).sum(), len(agents)))
print("no two were nearer than %.2f m: proved" % flight.least_distance)
