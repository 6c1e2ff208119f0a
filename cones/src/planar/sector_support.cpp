// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/planar/sector.h>
#include <vericone/internal/geometry/double_double.h>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "planar/planar_frame.h"
#include "planar/sector_parts.h"

namespace vericone {
namespace {

using Eigen::Vector2d;

/// Below this excess of the contact function the roots are started from the maximum between them.
constexpr double kNearTouching = 1e-6;

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
RefinedNormal refine(const Ellipse& a, const Ellipse& b, const Vector2d& n, double side) {
  RefinedNormal result{n.normalized(), 0};
  double last = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < 20; ++iteration) {
    const Residual r = residual(a, b, result.n);
    const Vector2d tangent = side * Vector2d(-result.n.y(), result.n.x());
    const double slope = -r.gradient.dot(tangent);  // > 0: the distance between the points of tangency
    if (!(slope > 0)) {
      result.turn = 0;
      break;
    }
    result.turn = r.value / slope;
    const double size = std::abs(result.turn);
    // Below the spacing of doubles the angle itself carries the rest.
    if (size <= 1e-16 || (size < 1e-13 && size > 0.5 * last)) break;
    last = size;
    result.n = (result.n + result.turn * tangent).normalized();
    result.turn = 0;
  }
  return result;
}

/// Starts for refine() where the bodies nearly touch and the contact function is one to rounding: the maximum
/// of g and its curvature there give both roots.
struct NearTouching {
  Vector2d normal;  // at the maximum
  double half = 0;  // angle from there to either root; 0 when it is below what 31 digits tell from 0

  NearTouching(const Ellipse& a, const Ellipse& b, const Vector2d& start) : normal(start.normalized()) {
    const double det_a = a.factor().determinant(), det_b = b.factor().determinant();
    for (int iteration = 0; iteration < 20; ++iteration) {
      const Residual r = residual(a, b, normal);
      const double ra = a.radius(normal), rb = b.radius(normal);
      // rho'' + rho = det S / rho^3.
      const double curvature = det_a * det_a / (ra * ra * ra) + det_b * det_b / (rb * rb * rb) + r.value;
      half = std::sqrt(std::max(2 * r.value / curvature, 0.0));
      const Vector2d tangent(-normal.y(), normal.x());
      const double step = r.gradient.dot(tangent) / curvature;
      // To a thousandth of the distance to the roots is near enough.
      if (!(std::abs(step) > std::max(1e-3 * half, 1e-16))) break;
      normal = (normal + std::clamp(step, -0.1, 0.1) * tangent).normalized();
    }
  }

  Vector2d root(double side) const {
    return normal + std::min(half, 0.5) * side * Vector2d(-normal.y(), normal.x());
  }
};

}  // namespace

Sector sector_by_support(const Ellipse& a, const Ellipse& b) {
  const Relation rel = relation<2>(a, b);
  if (rel == Relation::overlapping) return overlapping_sector(a, b);
  const ContactFrame<2> contact(a, b);
  if (rel == Relation::touching) return touching_sector(a, b, contact.separating_normal());

  RefinedNormal right, left;
  if (contact.contact - 1 < kNearTouching) {
    const NearTouching near(a, b, contact.separating_normal());
    right = refine(a, b, near.root(1), 1);
    left = refine(a, b, near.root(-1), -1);
  } else {
    const PlanarFrame frame(contact);
    const double orientation = frame.normal_to_space.determinant() > 0 ? 1 : -1;
    // In the frame K lies to the right of the origin; the normal (1, t) with t > 0 bounds it from below, i.e.
    // it is the inner normal of the clockwise edge, unless the map to space is a reflection.
    const Vector2d up = frame.normal_to_space * Vector2d(1, support_tangent_slope(frame, contact, 1));
    const Vector2d down = frame.normal_to_space * Vector2d(1, support_tangent_slope(frame, contact, -1));
    right = refine(a, b, orientation > 0 ? up : down, 1);
    left = refine(a, b, orientation > 0 ? down : up, -1);
  }

  // psi = pi - angle between the normals; as an angle between directions (-left, right turned) it keeps its
  // relative accuracy when the bodies are far apart and psi is small.
  const auto product = [](double x, double y) { return DoubleDouble::two_product(x, y); };
  const double cross =
      static_cast<double>(product(left.n.x(), right.n.y()) - product(left.n.y(), right.n.x()));
  const double dot = static_cast<double>(product(left.n.x(), right.n.x()) + product(left.n.y(), right.n.y()));
  Sector sector;
  sector.relation = Relation::disjoint;
  // Normals of nearly touching bodies may cross by a rounding; psi stays below pi.
  sector.psi = cross > 0 || dot < 0 ? std::atan2(cross, -dot) - left.turn - right.turn
                                    : std::numbers::pi - std::max(left.turn + right.turn, 0.0);
  sector.left = make_edge(a, b, left.n, -1);
  sector.right = make_edge(a, b, right.n, 1);
  sector.theta_b = bisector_angle(sector.right.direction, sector.psi);
  // Bodies so far apart that their squared distance is no double have no numbers, and none that is wrong.
  if (!std::isfinite((b.center() - a.center()).squaredNorm()))
    sector.psi = sector.theta_b = std::numeric_limits<double>::quiet_NaN();
  return sector;
}

}  // namespace vericone
