// SPDX-License-Identifier: BSD-3-Clause
//
// Times that fall back on the exact one: of ellipsoids/clearance.h.
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/internal/cones/times/contact_time_enclosure.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "ellipsoids/velocity_difference.h"

namespace vericone {

using Eigen::Vector3d;

namespace {

/// Of bodies that will overlap. Where squares of their ratios leave the doubles, or the gap is below rounding
/// and the time zero, the exact time is asked for.
double time_of_contact(const ConeOracle& oracle, const Vector3d& v_a, const Vector3d& v_b) {
  const auto squares = [](double x) { return x > 1e-70 && x < 1e70; };
  const double far = (oracle.b().center() - oracle.a().center()).cwiseAbs().maxCoeff();
  if (squares(far / oracle.a().factor().cwiseAbs().maxCoeff()) &&
      squares(far / oracle.b().factor().cwiseAbs().maxCoeff())) {
    const VelocityDifference d(v_a, v_b);
    const double speed = d.w.cwiseAbs().maxCoeff();
    const int e = squares(speed) ? 0 : std::ilogb(speed);  // of the unit of speed
    const Vector3d w = d.w.unaryExpr([e](double x) { return std::ldexp(x, -e); });
    const double t = contact_time(oracle.a(), oracle.b(), w);
    if (t > 0 && std::isfinite(t)) return std::ldexp(t, -e - d.exponent);
  }
  const auto exact = exact_time_to_contact(oracle, v_a, v_b);
  return exact ? exact->mid() : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::optional<double> time_to_contact(const ConeOracle& oracle, const Vector3d& v_a, const Vector3d& v_b) {
  switch (oracle.verdict(v_a, v_b)) {
    case Verdict::overlapping:
    case Verdict::touching:
      return 0.0;
    case Verdict::out:
    case Verdict::undecided:  // never of ellipsoids
      return std::nullopt;
    case Verdict::in:
      return time_of_contact(oracle, v_a, v_b);
    // A double root loses half the digits; the supporting points of the shadows do not.
    case Verdict::on: {
      const VelocityDifference d(v_a, v_b);
      return std::max(std::ldexp(clearance(oracle.a(), oracle.b(), d.w).time, -d.exponent), 0.0);
    }
  }
  return std::nullopt;
}

std::optional<double> time_to_contact(const Ellipsoid& a, const Ellipsoid& b, const Vector3d& w) {
  return time_to_contact(ConeOracle(a, b), w, Vector3d::Zero());
}

}  // namespace vericone
