// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/sector.h>
#include <vericone/geometry/double_double.h>
#include <cmath>
#include <numbers>

#include "planar_frame.h"
#include "sector_parts.h"

namespace vericone {
namespace {

using Eigen::Vector2d;

/// rho(n)^2 with 31 digits, from the matrix that defines the body.
DoubleDouble squared_radius(const Ellipse& body, const Vector2d& n) {
  const DoubleDouble x = n.x(), y = n.y();
  if (body.defined_by_factor()) {
    const auto& f = body.factor();
    const DoubleDouble u = x * f(0, 0) + y * f(1, 0), v = x * f(0, 1) + y * f(1, 1);
    return u * u + v * v;
  }
  const auto& s = body.shape();
  const DoubleDouble xy = x * y;
  return x * x * s(0, 0) + (xy + xy) * s(0, 1) + y * y * s(1, 1);
}

/// Square root of a positive DoubleDouble, one Newton step from the double one.
DoubleDouble square_root(const DoubleDouble& x) {
  const double r = std::sqrt(static_cast<double>(x));
  if (!(r > 0)) return {0};
  const double correction = static_cast<double>(x - DoubleDouble::two_product(r, r)) / (2 * r);
  return DoubleDouble::two_sum(r, correction);
}

struct Residual {
  double value;       // g(n), nearly correctly rounded
  Vector2d gradient;  // q(n) = c - S_A n / rho_A - S_B n / rho_B
};

Residual residual(const Ellipse& a, const Ellipse& b, const Vector2d& n) {
  const auto difference = [&](int i) { return DoubleDouble::two_sum(b.center()(i), -a.center()(i)); };
  const DoubleDouble cx = difference(0), cy = difference(1);
  const DoubleDouble ra = square_root(squared_radius(a, n)), rb = square_root(squared_radius(b, n));
  const DoubleDouble g = cx * DoubleDouble(n.x()) + cy * DoubleDouble(n.y()) - ra - rb;
  const Vector2d ua = a.factor().transpose() * n, ub = b.factor().transpose() * n;
  const Vector2d q = Vector2d(static_cast<double>(cx), static_cast<double>(cy)) -
                     a.factor() * ua / static_cast<double>(ra) - b.factor() * ub / static_cast<double>(rb);
  return {static_cast<double>(g), q};
}

/// A root of g on the unit circle, as a double normal plus the angle by which it misses the true one.
struct RefinedNormal {
  Vector2d n;
  double turn = 0;  // true normal = n turned by this many radians, away from the inside of {g > 0}
};

/// `side` = +1 when increasing polar angle of n leaves {g >= 0}, -1 otherwise.
RefinedNormal refine(const Ellipse& a, const Ellipse& b, Vector2d n, double side) {
  RefinedNormal result{n.normalized(), 0};
  double last = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < 6; ++iteration) {
    const Residual r = residual(a, b, result.n);
    const Vector2d tangent = side * Vector2d(-result.n.y(), result.n.x());
    const double slope = -r.gradient.dot(tangent);  // > 0: the distance between the points of tangency
    result.turn = r.value / slope;
    const double size = std::abs(result.turn);
    if (!(slope > 0) || size < 1e-17 || size > 0.5 * last) break;
    last = size;
    if (iteration < 5 && size > 1e-16) {
      result.n = (result.n + result.turn * tangent).normalized();
    } else {
      break;
    }
  }
  return result;
}

}  // namespace

Sector sector_by_support(const Ellipse& a, const Ellipse& b) {
  const Relation rel = relation<2>(a, b);
  if (rel == Relation::overlapping) return overlapping_sector(a, b);
  const ContactFrame<2> contact(a, b);
  if (rel == Relation::touching) return touching_sector(a, b, contact.separating_normal());

  const PlanarFrame frame(contact);
  const double orientation = frame.normal_to_space.determinant() > 0 ? 1 : -1;
  // In the frame K lies to the right of the origin; the normal (1, t) with t > 0 bounds it from below, i.e.
  // it is the inner normal of the clockwise edge, unless the map to space is a reflection.
  const Vector2d up = frame.normal_to_space * Vector2d(1, support_tangent_slope(frame, contact, 1));
  const Vector2d down = frame.normal_to_space * Vector2d(1, support_tangent_slope(frame, contact, -1));
  const RefinedNormal right = refine(a, b, orientation > 0 ? up : down, 1);
  const RefinedNormal left = refine(a, b, orientation > 0 ? down : up, -1);

  // psi = pi - angle between the normals; as an angle between directions (-left, right turned) it keeps its
  // relative accuracy when the bodies are far apart and psi is small.
  const auto product = [](double x, double y) { return DoubleDouble::two_product(x, y); };
  const double cross =
      static_cast<double>(product(left.n.x(), right.n.y()) - product(left.n.y(), right.n.x()));
  const double dot = static_cast<double>(product(left.n.x(), right.n.x()) + product(left.n.y(), right.n.y()));
  Sector sector;
  sector.relation = Relation::disjoint;
  sector.psi = std::atan2(cross, -dot) - left.turn - right.turn;
  sector.left = make_edge(a, b, left.n, -1);
  sector.right = make_edge(a, b, right.n, 1);
  sector.theta_b = bisector_angle(sector.right.direction, sector.psi);
  return sector;
}

}  // namespace vericone
