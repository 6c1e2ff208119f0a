// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/simulation/mesh_track.h>
#include <vericone/simulation/proof.h>

#include <vericone/simulation/curve.h>
#include <Eigen/Geometry>

namespace vericone::simulation {

guidance::OrificeState MovingOrifice::at(double t) const {
  const guidance::OrificeState start{{opening, position, rotation.leftCols<2>()}, velocity, spin};
  guidance::OrificeState now = start.after(t - appears);
  if (!window) return now;
  Eigen::Matrix3d frame;
  frame << now.opening.axes, now.opening.normal();
  const Eigen::Vector3d aside = frame * flat_center;
  now.opening.center += aside;
  now.opening.axes = frame * flat_axes;
  now.velocity += spin.cross(aside);
  return now;
}

Track mesh_track(const MovingOrifice& orifice, double to) {
  const Motion start{orifice.position, orifice.velocity, orifice.rotation};
  Track track(RigidShape{orifice.window->mesh()}, start, Orientation::fixed, orifice.appears);
  track.append(Curve::steady(start, orifice.spin, orifice.appears, to));
  return track;
}

}  // namespace vericone::simulation
