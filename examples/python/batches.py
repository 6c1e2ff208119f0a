# SPDX-License-Identifier: BSD-3-Clause
"""A million velocities in one call: verdicts, and for those that pass by how much, with the gradient."""
import numpy as np

import vericone as vc

pair = vc.Pair(vc.Ellipsoid.from_axes([0, 0, 0], [3, 1, 1]), vc.Ellipsoid.from_axes([20, 6, 0], [4, 1.5, 1]))
random = np.random.default_rng(1)
velocities = random.normal([8, 2, 0], 2.0, size=(1_000_000, 3))  # m/s
still = np.zeros(3)
verdicts = pair.verdict(velocities, still, threads=2)  # int8, of vc.Verdict
print("%.2f %% collide" % (100 * np.mean(verdicts == vc.Verdict.in_)))

some = velocities[:10_000]
miss = pair.miss(some, still)  # a record array: distance, least, most, normal, time
passing = verdicts[:10_000] == vc.Verdict.out
print("the nearest of those that pass does so at %.4f m" % miss.distance[passing].min())

# Which way to change a velocity so that it passes farther off? Along the gradient, -time * normal.
i = int(np.argmin(np.where(passing, miss.distance, np.inf)))
gradient = -miss.time[i] * miss.normal[i]  # m per m/s
better = some[i] + 0.1 * gradient / np.linalg.norm(gradient)
print("0.1 m/s that way: %.4f m" % pair.miss(better, still).distance)
assert pair.miss(better, still).distance > miss.distance[i]
