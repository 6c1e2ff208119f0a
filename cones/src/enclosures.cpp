// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/enclosures.h>

#include <vericone/cones/clearance.h>
#include <vericone/geometry/error.h>
#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

namespace vericone {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// x with what a function of the mathematics library may be off.
Interval rounded_by_library(double x) { return {x, 2.01 * 0x1p-52 * std::abs(x) + Interval::kTiny}; }

/// Angle of the vectors in a box on the positive side of the y axis.
Interval atan2_enclosed(const Interval& y, const Interval& x) {
  double lo = kInfinity, hi = -kInfinity;
  for (double py : {y.lo(), y.hi()})
    for (double px : {x.lo(), x.hi()}) {
      const Interval angle = rounded_by_library(std::atan2(py, px));
      lo = std::min(lo, angle.lo());
      hi = std::max(hi, angle.hi());
    }
  return Interval::between(lo, hi);
}

/// Angle from u counter-clockwise to v, about 0 to pi.
Interval angle_between(const Vector2d& u, const Vector2d& v) {
  const Interval cross = Interval(u.x()) * Interval(v.y()) - Interval(u.y()) * Interval(v.x());
  const Interval dot = Interval(u.x()) * Interval(v.x()) + Interval(u.y()) * Interval(v.y());
  if (dot.negative()) return Interval(std::numbers::pi, 0x1p-52) - atan2_enclosed(cross, -dot);
  return atan2_enclosed(cross, dot);
}

/// Between a direction in the sector and one out of it, in that order counter-clockwise for the left edge.
std::optional<DirectionEnclosure> enclose_edge(const SectorOracle& oracle, const SectorEdge& edge,
                                               bool left) {
  // The rounded edge is off by a few units in the last place at most, but nothing is taken on trust.
  for (int bits = 53; bits > 1; --bits) {
    const double step = std::ldexp(1.0, -bits);
    const Vector2d inside = edge.direction + step * edge.normal,
                   outside = edge.direction - step * edge.normal;
    const Interval turn =
        Interval(inside.x()) * Interval(outside.y()) - Interval(inside.y()) * Interval(outside.x());
    if (left ? !turn.positive() : !turn.negative()) continue;
    if (oracle.membership(inside) == Membership::out || oracle.membership(outside) == Membership::in)
      continue;
    return left ? DirectionEnclosure{inside, outside} : DirectionEnclosure{outside, inside};
  }
  return std::nullopt;
}

/// The pair projected along w without dividing: with L x = (w_k x_i - w_i x_k, w_k x_j - w_j x_k) the normals
/// perpendicular to w are exactly n = L^T z, z in the plane.
class Shadows {
 public:
  Shadows(const Ellipsoid& a, const Ellipsoid& b, const Vector3d& w) : a_(a), b_(b) {
    int k = 0;
    w.cwiseAbs().maxCoeff(&k);
    // Powers of two: lengths near one, and w too.
    length_ = std::ldexp(
        1.0, std::ilogb(std::max({a.factor().cwiseAbs().maxCoeff(), b.factor().cwiseAbs().maxCoeff(),
                                  (b.center() - a.center()).cwiseAbs().maxCoeff()})));
    const Vector3d v = w * std::ldexp(1.0, -std::ilogb(std::abs(w(k))));
    i_ = (k + 1) % 3;
    j_ = (k + 2) % 3;
    k_ = k;
    v_ = v;
    for (int r = 0; r < 3; ++r)
      c_[r] = (Interval(b.center()(r)) - Interval(a.center()(r))) / Interval(length_);
    for (int r = 0; r < 3; ++r)
      for (int s = 0; s < 3; ++s) {
        m_a_[r][s] = matrix(a, r, s);
        m_b_[r][s] = matrix(b, r, s);
      }
  }

  /// Whether scaling was exact: no entry left the normal numbers.
  bool in_range() const {
    const double least = std::min(a_.factor().cwiseAbs().maxCoeff(), b_.factor().cwiseAbs().maxCoeff());
    return length_ > 1e-140 && length_ < 1e140 && least > 1e-145;
  }
  double length() const { return length_; }

  /// L^T z.
  std::array<Interval, 3> normal(const Interval& x, const Interval& y) const {
    std::array<Interval, 3> n;
    n[i_] = Interval(v_(k_)) * x;
    n[j_] = Interval(v_(k_)) * y;
    n[k_] = -(Interval(v_(i_)) * x + Interval(v_(j_)) * y);
    return n;
  }
  /// The z nearest to a normal about perpendicular to w.
  Vector2d coordinates(const Vector3d& n) const { return Vector2d(n(i_), n(j_)) / v_(k_); }

  static Interval dot(const std::array<Interval, 3>& x, const std::array<Interval, 3>& y) {
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
  }
  static Interval norm(const std::array<Interval, 3>& x) {
    return sqrt(square(x[0]) + square(x[1]) + square(x[2]));
  }

  /// rho(n), and (S n).t where asked for.
  Interval radius(bool of_a, const std::array<Interval, 3>& n, const std::array<Interval, 3>* t = nullptr,
                  Interval* along = nullptr) const {
    const auto& m = of_a ? m_a_ : m_b_;
    const bool by_factor = (of_a ? a_ : b_).defined_by_factor();
    std::array<Interval, 3> u, ut;
    for (int s = 0; s < 3; ++s) {
      u[s] = m[0][s] * n[0] + m[1][s] * n[1] + m[2][s] * n[2];
      if (t) ut[s] = m[0][s] * (*t)[0] + m[1][s] * (*t)[1] + m[2][s] * (*t)[2];
    }
    if (t) *along = by_factor ? dot(u, ut) : dot(n, ut);
    return by_factor ? norm(u) : sqrt(dot(n, u));
  }

  /// The supporting point of a body relative to its centre: exactly in the body for each n of the box.
  std::array<Interval, 3> support(bool of_a, const std::array<Interval, 3>& n) const {
    const auto& m = of_a ? m_a_ : m_b_;
    const bool by_factor = (of_a ? a_ : b_).defined_by_factor();
    std::array<Interval, 3> u, p;
    for (int s = 0; s < 3; ++s) u[s] = m[0][s] * n[0] + m[1][s] * n[1] + m[2][s] * n[2];
    const Interval rho = by_factor ? norm(u) : sqrt(dot(n, u));
    for (int r = 0; r < 3; ++r)
      p[r] = (by_factor ? m[r][0] * u[0] + m[r][1] * u[1] + m[r][2] * u[2] : u[r]) / rho;
    return p;
  }

  /// g(n), lengths scaled.
  Interval gap(const std::array<Interval, 3>& n) const {
    return dot(n, c_) - radius(true, n) - radius(false, n);
  }
  const std::array<Interval, 3>& center_line() const { return c_; }
  std::array<Interval, 3> velocity() const { return {v_(0), v_(1), v_(2)}; }

 private:
  Interval matrix(const Ellipsoid& body, int r, int s) const {
    return body.defined_by_factor() ? Interval(body.factor()(r, s)) / Interval(length_)
                                    : Interval(body.shape()(r, s)) / (Interval(length_) * Interval(length_));
  }

  const Ellipsoid &a_, &b_;
  int i_, j_, k_;
  double length_;
  Vector3d v_;
  std::array<Interval, 3> c_;
  Interval m_a_[3][3], m_b_[3][3];
};

std::array<Interval, 3> cross(const std::array<Interval, 3>& x, const std::array<Interval, 3>& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

/// Whether g(n) <= bound |n| for all n = L^T z with z on one side of the square max |z_i| = 1, side 0..3, its
/// free coordinate in [lo, hi]. Mean value form; halves what it cannot decide. `budget`: boxes left.
bool below_everywhere(const Shadows& shadows, double bound, int side, double lo, double hi, int& budget) {
  if (--budget < 0) return false;
  const double middle = 0.5 * (lo + hi);
  const auto at = [&](const Interval& t) {
    const double fixed = side < 2 ? 1 : -1;
    return side % 2 == 0 ? shadows.normal(fixed, t) : shadows.normal(t, fixed);
  };
  const auto slope_of = side % 2 == 0 ? shadows.normal(0.0, 1.0) : shadows.normal(1.0, 0.0);
  const Interval range = Interval::between(lo, hi);
  const auto n = at(range), n0 = at(middle);
  // h(t) = n.c - rho_A - rho_B - bound |n|
  const Interval value = shadows.gap(n0) - Interval(bound) * Shadows::norm(n0);
  Interval along_a, along_b;
  const Interval ra = shadows.radius(true, n, &slope_of, &along_a),
                 rb = shadows.radius(false, n, &slope_of, &along_b);
  const Interval length = Shadows::norm(n);
  if (ra.positive() && rb.positive() && length.positive()) {
    const Interval slope = Shadows::dot(slope_of, shadows.center_line()) - along_a / ra - along_b / rb -
                           Interval(bound) * (Shadows::dot(n, slope_of) / length);
    const Interval whole = value + slope * (range - Interval(middle));
    if (whole.hi() <= 0) return true;
  }
  if (value.positive() || hi - lo < 1e-13) return false;
  return below_everywhere(shadows, bound, side, lo, middle, budget) &&
         below_everywhere(shadows, bound, side, middle, hi, budget);
}

}  // namespace

std::optional<SectorEnclosure> enclose_sector(const Ellipse& a, const Ellipse& b) {
  const SectorOracle oracle(a, b);
  if (oracle.relation() != Relation::disjoint) return std::nullopt;
  const Sector sector = sector_by_support(a, b);
  const auto left = enclose_edge(oracle, sector.left, true),
             right = enclose_edge(oracle, sector.right, false);
  if (!left || !right) return std::nullopt;
  SectorEnclosure result{*left, *right, {}, {}};
  // In between in the sector's own sense: from the inner ends of the brackets to the outer ones.
  result.psi = hull(angle_between(right->to, left->from), angle_between(right->from, left->to));
  const Interval start = hull(rounded_by_library(std::atan2(right->from.y(), right->from.x())),
                              rounded_by_library(std::atan2(right->from.y(), right->from.x())) +
                                  angle_between(right->from, right->to));
  result.theta_b = start + result.psi * Interval(0.5);
  const Interval turn(2 * std::numbers::pi, 0x1p-51);
  if (result.theta_b.mid() > std::numbers::pi) result.theta_b = result.theta_b - turn;
  if (result.theta_b.mid() <= -std::numbers::pi) result.theta_b = result.theta_b + turn;
  return result;
}

Interval enclose_clearance(const Ellipsoid& a, const Ellipsoid& b, const Vector3d& w) {
  const Clearance near = clearance(a, b, w);  // refuses bad velocities
  const Shadows shadows(a, b, w);
  if (!shadows.in_range()) return {0, kInfinity};
  const double length = shadows.length();
  const Vector2d z = shadows.coordinates(near.normal);
  const auto n = shadows.normal(z.x(), z.y());
  const Interval lower = shadows.gap(n) / Shadows::norm(n);
  if (lower.positive()) {
    // The two supporting points, projected along w, are points of the two shadows.
    const auto pa = shadows.support(true, n), pb = shadows.support(false, n);
    std::array<Interval, 3> q;
    for (int r = 0; r < 3; ++r) q[r] = shadows.center_line()[r] - pa[r] - pb[r];
    const auto v = shadows.velocity();
    const Interval upper = Shadows::norm(cross(q, v)) / Shadows::norm(v);
    return Interval::between(lower.lo(), std::max(lower.hi(), upper.hi())) * Interval(length);
  }
  for (int bits = 40; bits >= 0; bits -= 4) {
    const double bound = lower.hi() + std::ldexp(1.0, -bits);
    int budget = 2000;
    bool proved = true;
    for (int side = 0; side < 4 && proved; ++side)
      proved = below_everywhere(shadows, bound, side, -1, 1, budget);
    if (proved) return Interval::between(lower.lo(), bound) * Interval(length);
  }
  return Interval::between(lower.lo(), 4) * Interval(length);  // |c| <= 2 length bounds every gap
}

Interval enclose_separation(const Ellipsoid& a, const Ellipsoid& b) {
  if (relation<3>(a, b) != Relation::disjoint) return 0.0;
  const Separation near = separation(a, b);
  const Shadows shadows(a, b, Vector3d::UnitX());  // for its lengths
  if (!shadows.in_range()) return {0, kInfinity};
  const std::array<Interval, 3> n{near.normal.x(), near.normal.y(), near.normal.z()};
  const Interval lower = shadows.gap(n) / Shadows::norm(n);
  const auto pa = shadows.support(true, n), pb = shadows.support(false, n);
  std::array<Interval, 3> q;
  for (int r = 0; r < 3; ++r) q[r] = shadows.center_line()[r] - pa[r] - pb[r];
  return Interval::between(std::max(0.0, lower.lo()), std::max(lower.hi(), Shadows::norm(q).hi())) *
         Interval(shadows.length());
}

std::optional<PlaneSectorEnclosure> enclose_plane_sector(const Ellipsoid& a, const Ellipsoid& b,
                                                         const Vector3d& across) {
  const PlaneSector sector = exact_sector(a, b, across);
  const ConeOracle oracle(a, b);
  // u and e as boxes around the true ones: c / |c|, and what is left of `across` without its part along c.
  std::array<Interval, 3> u, e, towards{across.x(), across.y(), across.z()};
  for (int r = 0; r < 3; ++r) u[r] = Interval(b.center()(r)) - Interval(a.center()(r));
  const Interval distance = Shadows::norm(u);
  for (Interval& x : u) x = x / distance;
  const Interval part = Shadows::dot(towards, u);
  for (int r = 0; r < 3; ++r) e[r] = towards[r] - part * u[r];
  const Interval rest = Shadows::norm(e);
  for (Interval& x : e) x = x / rest;
  const auto enclose = [&](double angle, double side) -> std::optional<Interval> {
    const auto membership = [&](double phi) {
      const Interval c = rounded_by_library(std::cos(phi)), s = rounded_by_library(side * std::sin(phi));
      std::array<Interval, 3> w;
      for (int r = 0; r < 3; ++r) w[r] = c * u[r] + s * e[r];
      return oracle.interval_membership(w);
    };
    for (int bits = 50; bits > 3; --bits) {
      const double step = std::ldexp(1.0, -bits);
      // The line of sight is inside, so the ray turns outwards exactly once in the half-plane.
      if (membership(angle - step) == Membership::in && membership(angle + step) == Membership::out)
        return Interval::between(angle - step, angle + step);
    }
    return std::nullopt;
  };
  const auto left = enclose(sector.left.angle, 1), right = enclose(sector.right.angle, -1);
  if (!left || !right) return std::nullopt;
  return PlaneSectorEnclosure{*left, *right};
}

}  // namespace vericone
