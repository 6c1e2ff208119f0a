# SPDX-License-Identifier: BSD-3-Clause
"""Will an agent get through a window? The rim is as exact as a body."""
import numpy as np

import vericone as vc

drone = vc.Ellipsoid.from_axes([0, 0, 0], [0.3, 0.3, 0.1])  # m
axes = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])  # the opening's x and y in the world: the plane x = 5
window = vc.PlacedOpening(opening=vc.Opening.polygon([[-1, -0.6], [1, -0.6], [1, 0.6], [0, 0.2], [-1, 0.6]]),
                          center=[5, 0, 0], axes=axes)
oracle = vc.OrificeOracle(drone, window)
for aim in ([5, 0, -0.2], [5, 0, 0.15], [5, 0.9, 0]):
    print(aim, oracle.transit(np.array(aim, float)).name)
