// stub
#pragma once
#include <vericone/cones/opening/opening.h>
#include <vericone/geometry/world_body.h>
#include <cmath>
#include <Eigen/Geometry>
namespace vericone {
struct OpeningClearance { double distance = 0; Eigen::Vector3d normal = Eigen::Vector3d::Zero(), rim, support; double time = 0; };
inline OpeningClearance opening_clearance(const WorldBody& body, const PlacedOpening& o, const Eigen::Vector3d& w) {
  const Eigen::Vector3d u = w.normalized(), e1 = u.unitOrthogonal(), e2 = u.cross(e1);
  OpeningClearance best; best.distance = 1e300;
  for (int i = 0; i < 360; ++i) {
    const double t = 2 * M_PI * i / 360;
    const Eigen::Vector3d n = std::cos(t) * e1 + std::sin(t) * e2;
    const Eigen::Vector3d s = *body.support_point(n);
    Eigen::Vector3d far = o.center; double top = -1e300;
    for (int k = 0; k < 360; ++k) {
      const double q = 2 * M_PI * k / 360;
      Eigen::Vector2d p = o.opening.polygonal() ? o.opening.vertices()[k % o.opening.vertices().size()] : Eigen::Vector2d(o.opening.semi_axes().x() * std::cos(q), o.opening.semi_axes().y() * std::sin(q));
      const Eigen::Vector3d x = o.center + o.axes * p;
      if (n.dot(x) > top) { top = n.dot(x); far = x; }
    }
    const double m = top - n.dot(s);
    if (m < best.distance) best = {m, n, far, s, (far - s).dot(w) / w.squaredNorm()};
  }
  return best;
}
}
