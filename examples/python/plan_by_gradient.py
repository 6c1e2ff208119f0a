# SPDX-License-Identifier: BSD-3-Clause
"""A velocity near the one wanted that passes a mesh at two metres: steps along the gradient of the miss distance."""
import numpy as np

import vericone as vc

corners = np.array([[i & 1, i >> 1 & 1, i >> 2] for i in range(8)], float) * [2, 6, 3] + [10, -2, -1]
sides = np.array([[0, 1, 3], [0, 3, 2], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4], [2, 3, 7], [2, 7, 6], [0, 2, 6],
                  [0, 6, 4], [1, 3, 7], [1, 7, 5]])
wall = vc.Placed(vc.Assembly.mesh(corners, sides))
agent = vc.Placed(vc.Ellipsoid.from_axes([0, 0, 0], [0.5, 0.5, 0.2]))
pair = vc.Pair(agent, wall)
wanted, still, keep = np.array([5.0, 1.0, 0.2]), np.zeros(3), 2.0  # m/s, m/s, m
velocity = wanted.copy()
for count in range(100):
    miss = pair.miss(velocity, still)
    if miss.least >= keep:
        break
    gradient = np.asarray(miss.gradient_velocity())
    if np.linalg.norm(gradient) < 1e-9:  # nothing to gain at this velocity
        break
    velocity = velocity + 1.05 * (keep + 1e-3 - miss.distance) * gradient / (gradient @ gradient)
miss = pair.miss(velocity, still)
print("%s -> %s after %d steps: passes at %.4f m or more, proved" % (wanted, velocity.round(4), count, miss.least))
assert pair.verdict(velocity, still) == vc.Verdict.out and miss.least >= keep
