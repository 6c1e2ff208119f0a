// SPDX-License-Identifier: BSD-3-Clause
//
// The probability that two ellipsoids meet whose relative position and velocity are known up to Gaussian
// errors.
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <Eigen/Core>
#include <limits>

namespace vericone {

/// Zero-mean Gaussian errors of c = p_B - p_A and w = v_A - v_B. Covariances as people have them, turned by a
/// product or printed with ten digits, are symmetric and positive semidefinite only to rounding: an asymmetry
/// or a negative eigenvalue up to 1e-8 of the matrix's largest entry is averaged away or raised to 0, and
/// `clipped` of the answer is the largest change of an entry, as a part of the largest one. Beyond that
/// InputError names "position_covariance", "velocity_covariance" or "cross_covariance" (the matrix of all
/// three, in units of the deviations), and the entries or the eigenvalue.
struct GaussianErrors {
  Eigen::Matrix3d position = Eigen::Matrix3d::Zero();  // m^2
  Eigen::Matrix3d velocity = Eigen::Matrix3d::Zero();  // m^2 / s^2
  Eigen::Matrix3d cross = Eigen::Matrix3d::Zero();     // E[dc dw^T], m^2 / s
};

struct Probability {
  double least = 0, most = 1;  // the probability lies between
  double estimate = 0;         // of the probability, between the two
  int points = 0;              // of the shadow's boundary that were needed
  double clipped = 0;          // of the covariance, as a part of its largest entry: see GaussianErrors
};

struct ProbabilityOptions {
  double relative = 1e-10, absolute = 0;  // of most - least, relative or as a probability; the larger counts
  int most_points = 4096;
};

/// That the line of relative motion, from always to for ever, passes through: the integral of the position's
/// density over the shadow of the two bodies along w, which is known. It is also the probability of a
/// collision where the bodies meet fast enough that the past does not count, as in conjunctions of
/// satellites. Gauss's rule along the shadow's boundary, with a proved bound of what it leaves; errors of
/// rounding are bounded node by node, but not in intervals (docs/explanation/robust-law.md). `most - least`
/// is more than was asked for where doubles do not allow less, or `most_points` were used up. Errors along w
/// play no part; a position known along a line across w or altogether gives the one-dimensional integral, or
/// 0 or 1. Below 1e-290 the answer is least = 0 and most = 1e-290. Throws InputError naming
/// "relative_velocity" (zero, not finite), "position_covariance", "relative", "absolute" or "most_points".
/// Cost, whatever the tolerance: 5 us where the bodies are small beside the deviations, 20 to 30 us where
/// they are some deviations large, 0.1 ms at 10^3 deviations.
[[nodiscard]] Probability probability_of_passing_through(const Ellipsoid& a, const Ellipsoid& b,
                                                         const Eigen::Vector3d& w,
                                                         const Eigen::Matrix3d& position_covariance,
                                                         const ProbabilityOptions& options = {});

/// A proved upper bound of the probability of a collision from now until `horizon`.
struct ProbabilityBound {
  double most = 1;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // unit, from A towards B: the plane that separates them
  double clipped = 0;  // of the covariances, as a part of the largest entry: see GaussianErrors
};

/// For any unit n, bodies whose gap along n stays open do not meet. The gap is g(n) = n.c - h_A(n) - h_B(-n)
/// now and g - T n.w at the horizon, and linear between, so with s_p^2 = n^T P n, s_v^2 = n^T W n and s_T^2
/// the variance of n.(dc - T dw), whatever the correlations,
///
///   P <= Phi(-g / s_p) + min(Phi(n.w / s_v), Phi((T n.w - g) / s_T))
///
/// The n of the least bound is searched for: both terms have convex level sets in n, so that a search along
/// two lines finds it; that no other n is better is tested, not proved. The bound of the n found is proved
/// (intervals, rounded up, below 1e-308 too). 1 where the bodies are not apart. Throws InputError as
/// GaussianErrors says, and naming "relative_velocity" or "horizon" (not positive). Cost: 0.1 to 0.3 ms.
[[nodiscard]] ProbabilityBound collision_probability_bound(
    const Ellipsoid& a, const Ellipsoid& b, const Eigen::Vector3d& w, const GaussianErrors& errors,
    double horizon = std::numeric_limits<double>::infinity());

}  // namespace vericone
