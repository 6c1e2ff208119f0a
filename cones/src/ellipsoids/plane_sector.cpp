// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/cones/ellipsoids/plane_sector.h>
#include <vericone/internal/cones/ellipsoids/rungs.h>

#include <vericone/geometry/error.h>
#include <vericone/internal/cones/ellipsoids/contact_frame.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "ellipsoids/plane_axis.h"
#include "ellipsoids/require_disjoint.h"

namespace vericone {
namespace {

using Eigen::Vector3d;

/// A normal n = u + tau e + s p with u, e, p orthonormal.
struct Tilt {
  double tau = 0, s = 0;
};

/// rho_A + rho_B along n = u + tau e + s p, and its derivatives.
class Width {
 public:
  Width(const Ellipsoid& a, const Ellipsoid& b, const Vector3d& u, const Vector3d& e, const Vector3d& p)
      : bodies_{Part(a, u, e, p), Part(b, u, e, p)} {}

  struct Value {
    double width = 0, by_tau = 0, by_s = 0, by_tau_tau = 0, by_tau_s = 0, by_ss = 0;
  };

  Value at(double tau, double s) const {
    Value v;
    for (const Part& f : bodies_) {
      const Vector3d n = f.u + tau * f.e + s * f.p;
      const double rho = n.norm(), inverse = 1 / rho, t = n.dot(f.e) * inverse, slope = n.dot(f.p) * inverse;
      v.width += rho;
      v.by_tau += t;
      v.by_s += slope;
      v.by_tau_tau += (f.ee - t * t) * inverse;
      v.by_tau_s += (f.ep - t * slope) * inverse;
      v.by_ss += (f.pp - slope * slope) * inverse;
    }
    return v;
  }

  /// The s of least width for a tau: between the two bodies' own minimisers; convex, Newton kept in the
  /// bracket.
  double narrowest(double tau, double guess) const {
    const auto own = [&](const Part& f) { return -(f.u + tau * f.e).dot(f.p) / f.pp; };
    double lo = own(bodies_[0]), hi = own(bodies_[1]);
    if (lo > hi) std::swap(lo, hi);
    double s = std::clamp(guess, lo, hi);
    for (int iteration = 0; iteration < 100; ++iteration) {
      const Value v = at(tau, s);
      (v.by_s > 0 ? hi : lo) = s;
      double next = s - v.by_s / v.by_ss;
      if (!(next > lo && next < hi)) next = 0.5 * (lo + hi);
      const double step = next - s;
      s = next;
      // The width is stationary in s: half the digits are enough for it, the rest serve the normal.
      if (std::abs(step) <= 1e-13 * (1 + std::abs(s))) break;
    }
    return s;
  }

 private:
  struct Part {
    Vector3d u, e, p;
    double ee, ep, pp;
    Part(const Ellipsoid& body, const Vector3d& u_in, const Vector3d& e_in, const Vector3d& p_in)
        : u(body.factor().transpose() * u_in),
          e(body.factor().transpose() * e_in),
          p(body.factor().transpose() * p_in),
          ee(e.squaredNorm()),
          ep(e.dot(p)),
          pp(p.squaredNorm()) {}
  };
  Part bodies_[2];
};

/// The normal of largest side * tau with width <= distance, from one within, in some five evaluations;
/// nothing where the iteration does not settle.
///
/// The square of one body's width is a quadratic form of (tau, s), and that of two is nearly one, so the
/// extreme of the form that osculates width^2 is close from anywhere. From near by, Newton on width =
/// distance and d width / ds = 0, whose residuals keep their digits.
std::optional<Tilt> farthest_by_newton(const Width& width, double distance, Tilt at, double side) {
  bool near = false;
  double extent_tau = 0, extent_s = 0;
  for (int iteration = 0; iteration < 16; ++iteration) {
    const Width::Value v = width.at(at.tau, at.s);
    double d_tau, d_s;
    if (!near) {
      // w^2 / 2 with gradient g and Hessian m; l is the level's height above the form's minimum.
      const double tt = v.by_tau * v.by_tau + v.width * v.by_tau_tau,
                   ts = v.by_tau * v.by_s + v.width * v.by_tau_s, ss = v.by_s * v.by_s + v.width * v.by_ss;
      const double g_tau = v.width * v.by_tau, g_s = v.width * v.by_s, determinant = tt * ss - ts * ts;
      const double c_tau = (ts * g_s - ss * g_tau) / determinant, c_s = (ts * g_tau - tt * g_s) / determinant;
      const double l = 0.5 * ((distance - v.width) * (distance + v.width) - g_tau * c_tau - g_s * c_s);
      if (!(determinant > 0) || !(l > 0)) return std::nullopt;
      extent_tau = std::sqrt(2 * l * ss / determinant);
      extent_s = std::sqrt(2 * l * tt / determinant);
      d_tau = c_tau + side * extent_tau;
      d_s = c_s - side * extent_tau * ts / ss;
    } else {
      const double rest = distance - v.width, determinant = v.by_tau * v.by_ss - v.by_s * v.by_tau_s;
      d_tau = (v.by_ss * rest + v.by_s * v.by_s) / determinant;
      d_s = -(v.by_tau * v.by_s + v.by_tau_s * rest) / determinant;
    }
    at.tau += d_tau;
    at.s += d_s;
    const double step = std::max(std::abs(d_tau) / extent_tau, std::abs(d_s) / extent_s);
    if (!(step < 1e3)) return std::nullopt;
    // Newton squares the last step.
    if (near && step < 1e-8) return side * v.by_tau > 0 ? std::optional(at) : std::nullopt;
    near = step < 0.03;
  }
  return std::nullopt;
}

/// The same by steps that cannot fail. G(tau) = distance - min_s width is concave and positive within; from a
/// point beyond the root Newton comes down monotonically.
Tilt farthest_in_brackets(const Width& width, double distance, Tilt at, double side) {
  double reach = 1 + std::abs(at.tau);
  for (int doubling = 0; doubling < 1100; ++doubling, reach *= 2) {
    at.tau += side * reach;
    at.s = width.narrowest(at.tau, at.s);
    if (width.at(at.tau, at.s).width > distance) break;
  }
  for (int iteration = 0; iteration < 100; ++iteration) {
    const Width::Value v = width.at(at.tau, at.s);
    const double step = (distance - v.width) / v.by_tau;
    if (!std::isfinite(step)) break;
    at.tau += step;
    at.s = width.narrowest(at.tau, at.s);
    if (std::abs(step) <= 1e-15 * (1 + std::abs(at.tau))) break;
  }
  return at;
}

}  // namespace

SectorPlanes::SectorPlanes(const Ellipsoid& a, const Ellipsoid& b)
    : a_(a), b_(b), c_(b.center() - a.center()), line_of_sight_(c_.normalized()) {
  // Unless the bodies are near each other the line of centres itself separates them, which is cheap to prove.
  if (triage_separates<3>(a, b, line_of_sight_)) {
    separating_ = line_of_sight_;
    disjoint_ = true;
    return;
  }
  const ContactFrame<3> frame(a, b);
  separating_ = frame.separating_normal();
  auto certified = triage_relation<3>(a, b, frame);
  if (!certified) certified = interval_relation<3>(a, b, frame);
  disjoint_ = certified == Relation::disjoint;
}

PlaneSector true_sector(const Ellipsoid& a, const Ellipsoid& b, const Vector3d& across) {
  return SectorPlanes(a, b).on(across);
}

PlaneSector SectorPlanes::on(const Vector3d& across) const {
  const Ellipsoid &a = a_, &b = b_;
  const Vector3d& c = c_;
  if (!disjoint_) require_disjoint(a, b);
  PlaneSector sector;
  sector.line_of_sight = line_of_sight_;
  const Vector3d& u = sector.line_of_sight;
  sector.across = second_axis(u, across);
  const Vector3d& e = sector.across;
  const Vector3d p = u.cross(e);
  const double distance = c.norm();
  sector.distance = distance;
  sector.distance = distance;
  const Width width(a, b, u, e, p);

  // The plane's sector is polar to the projection of the separating normals N = { width <= |c| } (n.u = 1)
  // onto the plane: its ends are the extreme tau of N.
  const Vector3d normal = separating_ / separating_.dot(u);
  const Tilt start{normal.dot(e), normal.dot(p)};
  const auto edge = [&](double side) {
    const auto quick = farthest_by_newton(width, distance, start, side);
    const auto [tau, s] = quick ? *quick : farthest_in_brackets(width, distance, start, side);
    PlaneSector::Edge result;
    result.normal = (u + tau * e + s * p).normalized();
    const Vector3d ua = a.factor().transpose() * result.normal, ub = b.factor().transpose() * result.normal;
    result.on_a = a.factor() * (ua / ua.norm());
    result.on_b = -(b.factor() * (ub / ub.norm()));
    result.contact = c - (result.on_a - result.on_b);
    // The edge is perpendicular to (1, tau) in the plane; 1 is written as width / |c|, which is what it
    // equals.
    result.angle = std::atan2(width.at(tau, s).width / distance, side * tau);
    return result;
  };
  sector.left = edge(-1);
  sector.right = edge(1);
  return sector;
}

PlaneSectorRates true_sector_rates(const PlaneSector& sector, const Ellipsoid& a, const Ellipsoid& b,
                                   const SpatialMotion& motion) {
  const Vector3d& u = sector.line_of_sight;
  const Vector3d c_rate = motion.v_b - motion.v_a;
  if (u.isZero(0)) throw InputError("sector", "a sector without a plane", "true_sector() of the two bodies");
  if (a.center() == b.center()) throw InputError("bodies", "the same centre", "disjoint");
  const auto width_rate = [](const Ellipsoid& body, const Vector3d& n, const Vector3d& omega,
                             const BodyRate* rate) {
    // Turning: S' = W S - S W with W = [omega x], so n.S'n / 2 = (S n).(n x omega).
    const Vector3d sn = body.factor() * (body.factor().transpose() * n);
    const double change = rate ? 0.5 * n.dot(rate->shape * n) : 0;
    return (sn.dot(n.cross(omega)) + change) / body.radius(n);
  };
  // n.(S n)/rho is where the contact is, so the turning of a shape is that of the contact point.
  const auto speed = [&](const Vector3d& n) {
    return n.dot(c_rate) - width_rate(a, n, motion.omega_a, motion.rate_a) -
           width_rate(b, n, motion.omega_b, motion.rate_b);
  };
  return sector_rates(sector, speed(sector.left.normal), speed(sector.right.normal), c_rate,
                      motion.plane_spin);
}

}  // namespace vericone
