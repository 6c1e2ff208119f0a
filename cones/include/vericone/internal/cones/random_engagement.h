// SPDX-License-Identifier: BSD-3-Clause
//
// Random pairs of bodies that are apart, for measuring and for tests.
#pragma once

#include <vericone/geometry/combined.h>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

namespace vericone::engagements {

/// Numbers that depend on a seed and a position alone, not on the order or the thread in which they are
/// drawn, and are the same on every machine (splitmix64; Steele, Lea, Flood 2014). Cost: 10 ns a number.
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t index);
  double uniform();  // [0, 1), 53 bits
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  Eigen::Vector3d direction();  // uniform on the sphere
  Eigen::Matrix3d rotation();   // uniform (Shoemake 1992), three numbers

  /// Number `number`, counted from 0, of the generators (seed, first), (seed, first + 1), ...: in (0, 1), 52
  /// bits and a half, the same for u and 1 - u. Cost: 2 ns each.
  static void fill(std::uint64_t seed, std::uint64_t first, std::uint64_t number, std::span<double> u);

 private:
  std::uint64_t next();
  std::uint64_t state_;
};

struct Range {
  double low, high;  // in the unit of what is drawn
};

/// What engagements are drawn from, uniformly.
struct Distribution {
  Range semi_axes{1, 10};         // of both bodies, m
  Range spacing{1.5, 3};          // of the centres, in parts of the distance that just separates
  std::optional<Range> distance;  // of the centres, m, instead; above twice the largest semi-axis
};

/// Agent and obstacle number `index`: semi-axes uniform in 1..10 m, uniform orientations, the agent's centre
/// at the origin and the obstacle's in a uniform direction d at 1.5 to 3 times the distance rho_A(d) +
/// rho_B(d) at which a plane perpendicular to d just separates the bodies, unless `from` says otherwise. The
/// line of centres then always separates them, and the cone's section area is finite. The source does not
/// print its distribution (errata, 4.1). Centres and matrices are rounded. Cost: 1 us. Requires 0 < low <=
/// high of each range.
[[nodiscard]] std::pair<Ellipsoid, Ellipsoid> random_engagement(std::uint64_t seed, std::uint64_t index,
                                                                const Distribution& from = {});

enum class ObstacleKind { ellipsoid, biconcave, biconvex, star };

/// The same engagement with the obstacle delimited, its ellipsoid (semi-axes a, b, c) as it was:
///   biconcave  one hyperboloid of two sheets on the body's axes, semi-axes (u a, v b, v c),
///   biconvex   one of one sheet on the body's axes, semi-axes (v a, u b, u c),
///   star       three of two sheets at uniform orientations, u and v as parts of the ellipsoid's extent along
///              their axes,
/// u uniform in 0.3 to 0.8 (what the dents and the waist leave), v in 0.3 to 1.
[[nodiscard]] std::pair<Ellipsoid, CombinedEllipsoid> random_combined_engagement(
    ObstacleKind kind, std::uint64_t seed, std::uint64_t index, const Distribution& from = {});

/// Approach `index` of an ellipsoidal agent to a given obstacle: the agent has semi-axes of 0.2 to 1 times
/// the obstacle's mean one, and the rest is as above.
[[nodiscard]] Ellipsoid random_agent(const Ellipsoid& obstacle, std::uint64_t seed, std::uint64_t index);

}  // namespace vericone::engagements
