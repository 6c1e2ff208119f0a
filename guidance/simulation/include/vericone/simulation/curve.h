// SPDX-License-Identifier: BSD-3-Clause
//
// A piece of any motion, as the dense output of a solver of differential equations gives it.
#pragma once

#include <vericone/simulation/leg.h>
#include <Eigen/Core>
#include <array>

namespace vericone::simulation {

/// A vector that is a polynomial of degree 5 of the time since its beginning: coefficients of 1, t, ..., t^5.
using Quintic = std::array<Eigen::Vector3d, 6>;

/// A vector at a time, in its unit, with its first two derivatives.
struct Jet {
  Eigen::Vector3d value = Eigen::Vector3d::Zero(), first = Eigen::Vector3d::Zero(),
                  second = Eigen::Vector3d::Zero();
};

/// The one that has these jets at 0 and after `duration` seconds (Hermite). Of a function with a sixth
/// derivative it is within duration^6 / 46080 times the most of that.
[[nodiscard]] Quintic quintic(const Jet& from, const Jet& to, double duration);

/// Position p(t), and rotation Exp(phi(t)) R with a rotation vector phi, both quintic.
///
/// Bounds hold for the polynomials, rounded up. A polynomial is within the hull of its Bernstein
/// coefficients, which bounds |p''|, |phi'| and |phi''|. The angular velocity is J phi', where J is the
/// integral of Exp(s phi) over s in [0, 1]: so |omega| <= |phi'|; and as J' is the integral of [omega_s]
/// Exp(s phi) with |omega_s| <= s |phi'|, |omega'| <= |phi''| + |phi'|^2 / 2, the last term gone where phi
/// keeps its direction. |d2/dt2| of a direction of the body is at most |omega|^2 + |omega'|. Cost: 0.5 us
/// to make.
class Curve : public Leg {
 public:
  /// From `from` until `to` > from; the polynomials' time begins at `from`. Throws InputError naming "to", or
  /// "curve" where a coefficient is not finite.
  Curve(const Quintic& position, const Quintic& turned, const Eigen::Matrix3d& rotation, double from,
        double to);

  /// With constant velocity and constant spin, rad/s in world axes.
  [[nodiscard]] static Curve steady(const Motion& start, const Eigen::Vector3d& spin, double from, double to);

  [[nodiscard]] Motion at(double t) const override;
  [[nodiscard]] Eigen::Vector3d acceleration(double t) const override;
  [[nodiscard]] Eigen::Vector3d turn(double t) const override;

 private:
  void bound();

  Quintic position_, turned_;
  Eigen::Matrix3d rotation_;
};

}  // namespace vericone::simulation
