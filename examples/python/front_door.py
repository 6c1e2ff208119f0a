# SPDX-License-Identifier: BSD-3-Clause
"""Any two bodies: will they meet, when and where, and by how much do they miss?"""
import vericone as vc

agent = vc.Placed(vc.Ellipsoid.from_axes([0, 0, 0], [1, 1, 0.5]))  # m
obstacle = vc.Placed(vc.HullBody.box([-1, -1, -1], [1, 1, 1]), vc.Pose(position=[6, 0, 0]))
pair = vc.Pair(agent, obstacle)  # prepared for many velocities
still = [0, 0, 0]  # m/s
for climb in (0.0, 2.0, 5.0):
    velocity = [8, 0, climb]
    contact = pair.contact(velocity, still)
    print(pair.verdict(velocity, still),  # exact: in, on, out
          "after %.6f s" % contact.time if contact is not None else
          "passes at %.6f m" % pair.miss(velocity, still).distance)
