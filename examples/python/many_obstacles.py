# SPDX-License-Identifier: BSD-3-Clause
"""A navigator past twenty moving bodies to a destination: one step of guidance after the other."""
import numpy as np
from numpy.typing import NDArray

import vericone as vc
from vericone import guidance

random = np.random.default_rng(7)
ball = vc.Ellipsoid.from_axes([0, 0, 0], [0.5, 0.5, 0.5])  # m
positions = np.column_stack([random.uniform(8, 40, 20), random.uniform(-6, 6, 20), random.uniform(-3, 3, 20)])
drift = random.normal(0, 0.5, size=(20, 3))  # m/s
agent, velocity = np.zeros(3), np.array([3.0, 0, 0])
goal = np.array([50.0, 0, 0])
step, keep = 0.1, 0.3  # s, m
navigator = guidance.Navigator(guidance.NavigatorOptions(required=keep, most=4.0))
destination = guidance.Destination(point=goal, most=2.0)


def state(position: NDArray[np.float64], moving: NDArray[np.float64]) -> guidance.BodyState:
    return guidance.BodyState(shape=vc.WorldBody(vc.CombinedEllipsoid(ball.translated(position))), position=position,
                              velocity=moving)


nearest, time = np.inf, 0.0
while agent[0] < goal[0] and time < 40:
    others = [state(p, v) for p, v in zip(positions, drift)]
    answer = navigator.step(state(agent, velocity), others, destination, time, step)
    speed = np.linalg.norm(velocity)
    velocity = velocity + step * np.asarray(answer.acceleration)
    velocity *= speed / np.linalg.norm(velocity)  # the command is across it
    agent, positions, time = agent + step * velocity, positions + step * drift, time + step
    nearest = min(nearest, float(np.linalg.norm(positions - agent, axis=1).min()) - 1.0)
print("there after %.1f s, never nearer than %.2f m at the steps" % (time, nearest))
assert nearest > 0 and agent[0] >= goal[0]
