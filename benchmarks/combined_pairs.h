// SPDX-License-Identifier: BSD-3-Clause
//
// The engagements of pairs.h with bodies delimited by hyperboloids: same ellipsoids, same places.
#pragma once

#include <benchmarks/pairs.h>
#include <vericone/geometry/combined.h>
#include <vector>

namespace vericone::benchmarks {

enum class Family { ellipsoid, biconcave, biconvex, star };

struct CombinedEngagement {
  CombinedEllipsoid a, b;
  Eigen::Vector3d w;  // half of them aimed near the boundary of the ellipsoids' cone
};

/// Biconcave and biconvex: one hyperboloid on the body's axes that leaves 0.3 to 0.8 of it in the dent or
/// waist, the other semi-axes 0.3 to 1 of the body's; star: three of two sheets at any attitude.
inline CombinedEllipsoid delimited(const Placed& placed, Family family, Dice& dice) {
  if (family == Family::ellipsoid) return placed.body();
  std::vector<Delimiter<3>> delimiters;
  for (int i = 0; i < (family == Family::star ? 3 : 1); ++i) {
    const double u = dice.uniform(0.3, 0.8), v = dice.uniform(0.3, 1);
    const Eigen::Matrix3d turn = family == Family::star ? dice.rotation() : placed.rotation;
    Eigen::Vector3d axes = placed.semi_axes;
    if (family == Family::star)
      for (int k = 0; k < 3; ++k) axes(k) = 1 / CombinedEllipsoid(placed.body()).gauge(turn.col(k));
    const bool waist = family == Family::biconvex;
    const Eigen::Vector3d parts = waist ? Eigen::Vector3d(v, u, u) : Eigen::Vector3d(u, v, v);
    delimiters.push_back(hyperboloid(waist ? 1 : 2, axes.cwiseProduct(parts), turn));
  }
  return {placed.body(), std::move(delimiters)};
}

inline std::vector<CombinedEngagement> combined_engagements(int count, Family a, Family b) {
  Dice dice(3);
  std::vector<CombinedEngagement> all;
  all.reserve(count);
  for (const Engagement& e : engagements(count))
    all.push_back({delimited(e.placed_a, a, dice), delimited(e.placed_b, b, dice), e.w});
  return all;
}

}  // namespace vericone::benchmarks
