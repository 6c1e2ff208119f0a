// SPDX-License-Identifier: BSD-3-Clause
//
// What several pieces do together where each of them is only touched, and when the first touch is.
#pragma once

#include <vericone/cones/ellipsoids/predicates.h>
#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "hulls/exact.h"

namespace vericone::exact {

/// What an oracle of two hulls reads; none of others.
inline const HullScene* two_hulls(const HullOracle& oracle) {
  const HullScene& scene = scene_of(oracle);
  return scene.ellipsoid ? nullptr : &scene;
}
inline const HullScene* two_hulls(const ConeOracle&) { return nullptr; }

/// The convex cone of all sums of these vectors with weights >= 0.
using Generators = std::vector<IntegerVector<3>>;

/// The cone of all of K: the differences b_j - a_i, primitive. Of two hulls.
Generators generators(const HullScene& scene);

bool has_interior(const Generators& cone);

/// Normals n such that the cone is where all n.x >= 0.
std::vector<IntegerVector<3>> sides(const Generators& cone);

/// A pair on a stretch; `covered`: where two hulls only touch on it, becomes the cone of all of K there.
Membership within(const ConeOracle& oracle, const Stretch& stretch, Generators* covered = nullptr);
Membership within(const HullOracle& oracle, const Stretch& stretch, Generators* covered = nullptr);

/// Directions of the plane from `low` counter-clockwise to `high`, by at most half a turn.
struct Sector {
  IntegerVector<2> low, high;
};

/// The image of a cone, where that is not the whole plane; nothing where it has no interior.
std::optional<Sector> image(const Generators& cone, const Rows<2>& rows);

/// Whether the sectors together are the whole plane.
bool cover_plane(const std::vector<Sector>& sectors);

/// Whether cones, none of which is all of space, are that together.
bool cover_space(const std::vector<Generators>& cones);

/// Whether all points lie in one plane.
bool is_flat(const std::vector<Eigen::Vector3d>& points);

/// A piece of the agent and one of the obstacle that touch, as seen from where they do.
template <class Part>
struct Touched {
  std::uint32_t agent, obstacle;
  bool agent_flat, obstacle_flat;
  Part part;
};

/// Whether all flat pieces of both bodies together, or one of them and all of the other body, cover
/// everything: covers(parts) is asked.
template <class Part, class Covers>
bool covered_together(std::vector<Touched<Part>> touched, Covers&& covers) {
  if (touched.size() < 2) return false;
  std::vector<Part> parts;
  for (const auto& t : touched)
    if (t.agent_flat && t.obstacle_flat) parts.push_back(t.part);
  if (parts.size() > 1 && covers(parts)) return true;
  if (parts.size() == touched.size()) return false;
  const auto by_piece = [&](auto piece, auto flat) {
    std::sort(touched.begin(), touched.end(),
              [&](const auto& a, const auto& b) { return a.*piece < b.*piece; });
    for (std::size_t i = 0, end = 0; i < touched.size(); i = end) {
      parts.clear();
      for (end = i; end < touched.size() && touched[end].*piece == touched[i].*piece; ++end)
        parts.push_back(touched[end].part);
      if (touched[i].*flat && parts.size() > 1 && covers(parts)) return true;
    }
    return false;
  };
  using T = Touched<Part>;
  return by_piece(&T::agent, &T::agent_flat) || by_piece(&T::obstacle, &T::obstacle_flat);
}

/// The least t >= 0 with t w in K, rounded down and up; nothing where there is none, or it is not
/// within 2^-1000 to 2^1000.
std::optional<std::pair<double, double>> first_time(const HullScene& scene, const Eigen::Vector3d& w);

}  // namespace vericone::exact
