// SPDX-License-Identifier: BSD-3-Clause
//
// The probability that two ellipsoids meet whose relative position and velocity are known up to Gaussian
// errors.
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <Eigen/Core>
#include <limits>

namespace vericone {

/// Zero-mean Gaussian errors of c = p_B - p_A and w = v_A - v_B. Matrices that are not symmetric are refused,
/// so are covariances that are not positive semidefinite: InputError naming "position_covariance",
/// "velocity_covariance" or "cross_covariance".
struct GaussianErrors {
  Eigen::Matrix3d position = Eigen::Matrix3d::Zero();  // m^2
  Eigen::Matrix3d velocity = Eigen::Matrix3d::Zero();  // m^2 / s^2
  Eigen::Matrix3d cross = Eigen::Matrix3d::Zero();     // E[dc dw^T], m^2 / s
};

struct Probability {
  double least = 0, most = 1;  // the probability lies between
  double estimate = 0;         // of the probability, between the two
  int points = 0;              // of the shadow's boundary that were needed
};

struct ProbabilityOptions {
  double relative = 1e-4, absolute = 0;  // of most - least, relative or as a probability; the larger counts
  int most_points = 4096;
};

/// That the line of relative motion, from always to for ever, passes through: the integral of the position's
/// density over the shadow of the two bodies along w, which is known. It is also the probability of a
/// collision where the bodies meet fast enough that the past does not count, as in conjunctions of
/// satellites. The integral is taken exactly, by Owen's function, over polygons inside and around the shadow
/// (errors of rounding are allowed for with 1e-11 of every length and 1e-14 of every term). Errors along w
/// play no part. A position known along a line across w or altogether gives the one-dimensional integral, or
/// 0 or 1. Throws InputError naming "relative_velocity" (zero, not finite), "position_covariance",
/// "relative", "absolute" or "most_points". Cost: 0.2 to 0.6 ms for 1e-4.
[[nodiscard]] Probability probability_of_passing_through(const Ellipsoid& a, const Ellipsoid& b,
                                                         const Eigen::Vector3d& w,
                                                         const Eigen::Matrix3d& position_covariance,
                                                         const ProbabilityOptions& options = {});

/// A proved upper bound of the probability of a collision from now until `horizon`.
struct ProbabilityBound {
  double most = 1;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // unit, from A towards B: the plane that separates them
};

/// For any unit n, bodies whose gap along n stays open do not meet. The gap is g(n) = n.c - h_A(n) - h_B(-n)
/// now and g - T n.w at the horizon, and linear between, so with s_p^2 = n^T P n, s_v^2 = n^T W n and s_T^2
/// the variance of n.(dc - T dw), whatever the correlations,
///
///   P <= Phi(-g / s_p) + min(Phi(n.w / s_v), Phi((T n.w - g) / s_T))
///
/// The n of the least bound is searched
/// for; the bound of the n found is proved (rounded up). 1 where the bodies are not apart. Throws InputError
/// as GaussianErrors says, and naming "horizon" (not positive). Cost: 10 to 40 us.
[[nodiscard]] ProbabilityBound collision_probability_bound(
    const Ellipsoid& a, const Ellipsoid& b, const Eigen::Vector3d& w, const GaussianErrors& errors,
    double horizon = std::numeric_limits<double>::infinity());

}  // namespace vericone
