// SPDX-License-Identifier: BSD-3-Clause
#include "slices/plane_slices.h"

#include <vericone/cones/slices/visible_cone.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/slices/visible_sector.h>
#include <vericone/internal/geometry/lengths.h>
#include <vericone/internal/geometry/requires.h>
#include <Eigen/Geometry>
#include <cmath>
#include <vector>

namespace vericone {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using PlaneAxes = Eigen::Matrix<double, 3, 2>;

/// How the section of a body changes in axes (u, e) that turn with the plane.
struct SectionRates {
  Matrix2d shape;
  std::vector<DelimiterRate<2>> delimiters;  // of the section's own
};

/// A quadratic form Q that turns with omega and changes by `rate` as well has P^T Q P changing by
/// P^T rate P - (W^T Q P + P^T Q W), W = omega x P.
Matrix2d form_rate(const PlaneAxes& qp, const PlaneAxes& w) {
  const Matrix2d m = w.transpose() * qp;
  return -(m + m.transpose());
}

SectionRates rates_of(const CombinedEllipse& section, const CombinedEllipsoid& body, const PlaneAxes& p,
                      const Vector3d& omega, const BodyRate* rate) {
  PlaneAxes w;
  w << omega.cross(p.col(0)), omega.cross(p.col(1));
  // The section is { y : y^T M y <= 1 } with M = P^T S^{-1} P, its shape matrix M^{-1}.
  const Matrix3d inverse = scaled_inverse<3>(body.ellipsoid().factor());
  const PlaneAxes sp = inverse.transpose() * (inverse * p);
  Matrix2d form = form_rate(sp, w);
  if (rate) form -= sp.transpose() * rate->shape * sp;
  const Matrix2d& shape = section.ellipsoid().shape();
  SectionRates rates{-(shape * form * shape), {}};
  // A section may leave delimiters out, but keeps the order of the others.
  const auto& own = section.delimiters();
  std::size_t next = 0;
  for (std::size_t i = 0; i < body.delimiters().size() && next < own.size(); ++i) {
    const Delimiter<3>& d = body.delimiters()[i];
    const PlaneAxes dp = d.matrix * p;
    const Matrix2d m = p.transpose() * dp;
    if (d.level != own[next].level || (m - own[next].matrix).norm() > 1e-12 * dp.norm()) continue;
    DelimiterRate<2> change{form_rate(dp, w), 0};
    if (rate && i < rate->delimiters.size()) {
      change.matrix += p.transpose() * rate->delimiters[i].matrix * p;
      change.level = rate->delimiters[i].level;
    }
    rates.delimiters.push_back(change);
    ++next;
  }
  return rates;
}

PlaneAxes axes_of(const Vector3d& u, const Vector3d& e) {
  PlaneAxes p;
  p << u, e;
  return p;
}

}  // namespace

Sections sections_of(const CombinedEllipsoid& a, const CombinedEllipsoid& b, const Vector3d& u,
                     const Vector3d& e) {
  const double distance = (b.center() - a.center()).norm();
  Sections s{central_section(a, u, e, Vector2d::Zero()), central_section(b, u, e, Vector2d(distance, 0)), {}};
  s.sector = combined_sector(s.a, s.b);
  return s;
}

SectorRates section_rates(const Sections& sections, const CombinedEllipsoid& a, const CombinedEllipsoid& b,
                          const Vector3d& u, const Vector3d& e, const SpatialMotion& motion) {
  if (!sections.disjoint())
    throw InputError("obstacle", "a body that meets the agent on the plane", "apart from it");
  const Vector3d v = motion.v_b - motion.v_a;
  const double distance = (b.center() - a.center()).norm();
  // The axes (u, e) turn with the line of sight, and about it.
  const Vector3d plane = u.cross(v) / distance + motion.plane_spin * u;
  const PlaneAxes p = axes_of(u, e);
  const SectionRates of_a = rates_of(sections.a, a, p, motion.omega_a - plane, motion.rate_a),
                     of_b = rates_of(sections.b, b, p, motion.omega_b - plane, motion.rate_b);
  PlanarMotion planar;
  planar.v_b = Vector2d(v.dot(u), 0);
  planar.shape_rate_a = of_a.shape;
  planar.shape_rate_b = of_b.shape;
  SectorRates rates = combined_sector_rates(sections.sector, sections.a, sections.b, planar, of_a.delimiters,
                                            of_b.delimiters);
  rates.theta_b += v.dot(e) / distance;
  return rates;
}

std::optional<Sector> hull_section(const Ellipsoid& agent, const HullBody& hull, const Vector3d& u,
                                   const Vector3d& e) {
  // The section's corners are crossings of segments between points on both sides; every such crossing is in
  // the section, so all pairs may be taken.
  const Vector3d n = u.cross(e);
  const auto flat = [&](const Vector3d& x) { return Vector2d(x.dot(u), x.dot(e)); };
  std::vector<Vector3d> above, below;
  std::vector<Vector2d> corners;
  for (const Vector3d& point : hull.points()) {
    const Vector3d x = point - agent.center();
    const double height = n.dot(x);
    if (height == 0) corners.push_back(flat(x));
    if (height > 0) above.push_back(x);
    if (height < 0) below.push_back(x);
  }
  for (const Vector3d& x : above)
    for (const Vector3d& y : below) {
      const double hx = n.dot(x), hy = -n.dot(y);
      corners.push_back(flat((hy * x + hx * y) / (hx + hy)));
    }
  if (corners.empty()) return std::nullopt;
  const CombinedEllipse section = central_section(CombinedEllipsoid(agent), u, e, Vector2d::Zero());
  return sector_of_points(section.ellipsoid(), corners).sector;
}

}  // namespace vericone
