# SPDX-License-Identifier: BSD-3-Clause
"""A pilot of your own flies past a mesh, beside one of the library's laws; the run proves who kept away from what."""
import numpy as np
import numpy.typing as npt

import vericone as vc
from vericone import guidance, simulation as sim

corners = np.array([[0, 0, 0], [3, 0, 0], [0, 3, 0], [0, 0, 3]])
mesh = vc.WorldBody(vc.Placed(vc.Body(vc.Assembly.mesh(corners, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]))))
ball = sim.RigidShape(vc.WorldBody(vc.CombinedEllipsoid(vc.Ellipsoid.from_axes([0, 0, 0], [0.5, 0.5, 0.5]))))


def steer(t: float, me: guidance.BodyState, others: list[guidance.BodyState]) -> npt.NDArray[np.float64]:
    """m/s^2: across the velocity, up along what makes the nearest miss larger."""
    miss = min((vc.pair_of(me.shape, it.shape).miss(me.velocity, it.velocity) for it in others), key=lambda m: float(m.least))
    return np.array([0, 0, 2.0]) if miss.least < 1 else np.zeros(3)


law = guidance.GuideOptions(law=guidance.Law.clearance, clearance=guidance.ClearanceOptions(required=0.5, most=4))
scenario = sim.Scenario(duration=6, step=0.02, bodies=[
    sim.Body(name="mesh", shape=sim.RigidShape(mesh), start=sim.Motion(position=[12, -1, -1])),
    sim.Body(name="mine", shape=ball, start=sim.Motion(velocity=[4, 0, 0]), pilot=sim.Pilot(own=sim.pilot_by(steer))),
    sim.Body(name="law", shape=ball, start=sim.Motion(position=[0, 2, 0], velocity=[4, -0.2, 0]), pilot=sim.Pilot(guide=law))])
for pair in sim.simulate(scenario).proofs:
    a, b = scenario.bodies[pair.a].name, scenario.bodies[pair.b].name
    print("%s and %s %s: %.2f m" % (a, b, pair.proof.verdict, pair.proof.least_distance))
