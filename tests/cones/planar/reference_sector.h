// SPDX-License-Identifier: BSD-3-Clause
//
// The planar sector with 50 digits, by bisection of the tangency condition. Slow to compile and to run.
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <vericone/internal/cones/ellipsoids/contact_frame.h>
#include <array>
#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <stdexcept>

namespace vericone::testing {

using Wide = boost::multiprecision::cpp_bin_float_50;

/// n(beta).c - rho_A - rho_B changes its sign once on each side of a separating normal, within half a turn.
class ReferenceSector {
 public:
  ReferenceSector(const Ellipse& a, const Ellipse& b) : a_(a), b_(b) {
    const Eigen::Vector2d start = ContactFrame<2>(a, b).separating_normal();
    const Wide n0 = atan2(Wide(start.y()), Wide(start.x()));
    if (!(gap(n0) > 0)) throw std::logic_error("no separating normal to start from");
    const Wide pi = boost::math::constants::pi<Wide>();
    const Wide up = root(n0, n0 + pi), down = root(n0, n0 - pi);
    psi = pi - (up - down);
    theta_b = (up + down) / 2;
  }

  Wide psi, theta_b;  // theta_b up to whole turns

  double relative_error_of_psi(double x) const { return static_cast<double>(abs((x - psi) / psi)); }
  double error_of_theta_b(double x) const {
    const Wide turn = 2 * boost::math::constants::pi<Wide>();
    const Wide d = (x - theta_b) / turn;
    return static_cast<double>(abs(d - round(d)) * turn);
  }

 private:
  static Wide radius(const Ellipse& body, const Wide& x, const Wide& y) {
    if (body.defined_by_factor()) {
      const auto& f = body.factor();
      const Wide u = x * f(0, 0) + y * f(1, 0), v = x * f(0, 1) + y * f(1, 1);
      return sqrt(u * u + v * v);
    }
    const auto& s = body.shape();
    return sqrt(x * x * s(0, 0) + 2 * x * y * s(0, 1) + y * y * s(1, 1));
  }
  Wide gap(const Wide& beta) const {
    const Wide x = cos(beta), y = sin(beta);
    return x * (Wide(b_.center().x()) - a_.center().x()) + y * (Wide(b_.center().y()) - a_.center().y()) -
           radius(a_, x, y) - radius(b_, x, y);
  }
  /// To 1e-30.
  Wide root(Wide inside, Wide outside) const {
    for (int i = 0; i < 103; ++i) {
      const Wide mid = (inside + outside) / 2;
      (gap(mid) > 0 ? inside : outside) = mid;
    }
    return inside;
  }

  Ellipse a_, b_;
};

}  // namespace vericone::testing
