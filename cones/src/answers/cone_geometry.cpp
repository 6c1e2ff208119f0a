// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/cone_geometry.h>
#include <vericone/internal/cones/cone_size.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace vericone {

AxisFrame::AxisFrame(const Eigen::Vector3d& direction) : axis(direction.normalized()) {
  int smallest = 0;
  axis.cwiseAbs().minCoeff(&smallest);
  e1 = Eigen::Vector3d::Unit(smallest).cross(axis).normalized();
  e2 = axis.cross(e1);
}

double polygon_solid_angle(const Eigen::Vector3d& axis, std::span<const Eigen::Vector3d> directions) {
  // Van Oosterom and Strackee 1983: tan(omega / 2) = a.(b x c) / (1 + a.b + b.c + c.a) for unit vectors.
  // a.(b x c) = a.((b - a) x (c - a)) keeps the digits of narrow cones.
  const Eigen::Vector3d a = axis.normalized();
  double sum = 0;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Eigen::Vector3d b = directions[i].normalized(),
                          c = directions[(i + 1) % directions.size()].normalized();
    sum += 2 * std::atan2(a.dot((b - a).cross(c - a)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
  }
  return sum;
}

double polygon_section_area(const Eigen::Vector3d& axis, std::span<const Eigen::Vector3d> directions) {
  const Eigen::Vector3d a = axis.normalized();
  double sum = 0;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Eigen::Vector3d &b = directions[i], &c = directions[(i + 1) % directions.size()];
    const double hb = a.dot(b), hc = a.dot(c);
    if (!(hb > 0) || !(hc > 0)) return std::numeric_limits<double>::infinity();
    sum += 0.5 * a.dot((b / hb - a).cross(c / hc - a));
  }
  return sum;
}

}  // namespace vericone
