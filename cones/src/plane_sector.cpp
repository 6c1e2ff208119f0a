// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/plane_sector.h>

#include <vericone/cones/contact_frame.h>
#include <vericone/geometry/error.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "plane_axis.h"

namespace vericone {
namespace {

using Eigen::Vector3d;

/// rho_A + rho_B along n = u + tau e + s p with u, e, p orthonormal, and its derivatives.
class Width {
 public:
  Width(const Ellipsoid& a, const Ellipsoid& b, const Vector3d& u, const Vector3d& e, const Vector3d& p)
      : bodies_{Part(a, u, e, p), Part(b, u, e, p)} {}

  struct Value {
    double width, by_tau, by_s, by_ss;
  };

  Value at(double tau, double s) const {
    Value v{0, 0, 0, 0};
    for (const Part& f : bodies_) {
      const Vector3d n = f.u + tau * f.e + s * f.p;
      const double rho = n.norm(), slope = n.dot(f.p) / rho;
      v.width += rho;
      v.by_tau += n.dot(f.e) / rho;
      v.by_s += slope;
      v.by_ss += (f.p.squaredNorm() - slope * slope) / rho;
    }
    return v;
  }

  /// The s of least width for a tau: between the two bodies' own minimisers; convex, Newton kept in the
  /// bracket.
  double narrowest(double tau, double guess) const {
    const auto own = [&](const Part& f) { return -(f.u + tau * f.e).dot(f.p) / f.p.squaredNorm(); };
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
    Part(const Ellipsoid& body, const Vector3d& u_in, const Vector3d& e_in, const Vector3d& p_in)
        : u(body.factor().transpose() * u_in),
          e(body.factor().transpose() * e_in),
          p(body.factor().transpose() * p_in) {}
  };
  Part bodies_[2];
};

}  // namespace

SectorPlanes::SectorPlanes(const Ellipsoid& a, const Ellipsoid& b)
    : a_(a), b_(b), c_(b.center() - a.center()), line_of_sight_(c_.normalized()) {
  const ContactFrame<3> frame(a, b);
  separating_ = frame.separating_normal();
  auto certified = triage_relation<3>(a, b, frame);
  if (!certified) certified = interval_relation<3>(a, b, frame);
  disjoint_ = certified == Relation::disjoint;
}

PlaneSector exact_sector(const Ellipsoid& a, const Ellipsoid& b, const Vector3d& across) {
  const SectorPlanes planes(a, b);
  if (!planes.disjoint())
    if (const Relation rel = relation<3>(a, b); rel != Relation::disjoint)
      throw InputError("bodies", to_string(rel), "disjoint for a sector with two edges");
  return planes.on(across);
}

PlaneSector SectorPlanes::on(const Vector3d& across) const {
  const Ellipsoid &a = a_, &b = b_;
  const Vector3d& c = c_;
  PlaneSector sector;
  sector.line_of_sight = line_of_sight_;
  const Vector3d& u = sector.line_of_sight;
  sector.across = second_axis(u, across);
  const Vector3d& e = sector.across;
  const Vector3d p = u.cross(e);
  const double distance = c.norm();
  const Width width(a, b, u, e, p);

  // The plane's sector is polar to the projection of the separating normals N = { width <= |c| } (n.u = 1)
  // onto the plane: its ends are the extreme tau of N. G(tau) = |c| - min_s width is concave and positive at
  // the separating normal; from a point beyond the root Newton comes down monotonically.
  const Vector3d start = separating_ / separating_.dot(u);
  const auto edge = [&](double side) {
    double tau = start.dot(e), s = start.dot(p);
    double reach = 1 + std::abs(tau);
    for (int doubling = 0; doubling < 1100; ++doubling, reach *= 2) {
      tau += side * reach;
      s = width.narrowest(tau, s);
      if (width.at(tau, s).width > distance) break;
    }
    for (int iteration = 0; iteration < 100; ++iteration) {
      const Width::Value v = width.at(tau, s);
      const double step = (distance - v.width) / v.by_tau;
      if (!std::isfinite(step)) break;
      tau += step;
      s = width.narrowest(tau, s);
      if (std::abs(step) <= 1e-15 * (1 + std::abs(tau))) break;
    }
    PlaneSector::Edge result;
    result.normal = (u + tau * e + s * p).normalized();
    const Vector3d ua = a.factor().transpose() * result.normal, ub = b.factor().transpose() * result.normal;
    const Vector3d reach_ab = a.factor() * (ua / ua.norm()) + b.factor() * (ub / ub.norm());
    result.contact = c - reach_ab;
    // The edge is perpendicular to (1, tau) in the plane; 1 is written as width / |c|, which is what it
    // equals.
    result.angle = std::atan2(width.at(tau, s).width / distance, side * tau);
    return result;
  };
  sector.left = edge(-1);
  sector.right = edge(1);
  return sector;
}

PlaneSectorRates exact_sector_rates(const PlaneSector& sector, const Ellipsoid& a, const Ellipsoid& b,
                                    const SpatialMotion& motion) {
  const Vector3d &u = sector.line_of_sight, &e = sector.across;
  const Vector3d c_rate = motion.v_b - motion.v_a;
  const double distance = (b.center() - a.center()).norm();
  const Vector3d turning = u.cross(c_rate) / distance + motion.plane_spin * u;  // of the frame (u, e)
  const auto width_rate = [](const Ellipsoid& body, const Vector3d& n, const Vector3d& omega,
                             const Eigen::Matrix3d& extra) {
    // Turning: S' = W S - S W with W = [omega x], so n.S'n / 2 = (S n).(n x omega).
    const Vector3d sn = body.factor() * (body.factor().transpose() * n);
    return (sn.dot(n.cross(omega)) + 0.5 * n.dot(extra * n)) / body.radius(n);
  };
  // On the boundary n.q = g(n, t) stays 0 with q = kappa d, and grad g = q: q.n' = -g_t. Differentiating n.d
  // = 0 gives n.d' = g_t / kappa, where d' is phi' along the turned direction plus the turning of the frame.
  const auto edge_rate = [&](const PlaneSector::Edge& edge, double side) {
    const double cosine = std::cos(edge.angle), sine = side * std::sin(edge.angle);
    const Vector3d d = cosine * u + sine * e, turned = -sine * u + cosine * e;
    const Vector3d& n = edge.normal;
    const double kappa = edge.contact.dot(d);
    const double g_t = n.dot(c_rate) - width_rate(a, n, motion.omega_a, motion.shape_rate_a) -
                       width_rate(b, n, motion.omega_b, motion.shape_rate_b);
    return side * (g_t / kappa - n.dot(turning.cross(d))) / n.dot(turned);
  };
  return {edge_rate(sector.left, 1), edge_rate(sector.right, -1), c_rate.dot(e) / distance};
}

}  // namespace vericone
