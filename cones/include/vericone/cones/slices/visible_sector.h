// SPDX-License-Identifier: BSD-3-Clause
//
// Collision cones in the plane against an obstacle of which points are known: what sensors see of it (source,
// 6.3.3), for an elliptic agent and for one of any shape (6.3.4).
#pragma once

#include <vericone/cones/planar/sector.h>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace vericone {

/// Why there is no sector.
enum class NoSector : std::uint8_t {
  none,          // there is one
  no_points,     // nothing is seen of the obstacle
  inside_agent,  // a point is inside the elliptic agent, or on it
  no_tangents,   // the agent reaches among the points: no line separates it from them
};
[[nodiscard]] const char* to_string(NoSector reason);

/// The sector between the inner common tangents of the agent's section and the points.
struct VisibleSector {
  std::optional<Sector> sector;  // its relation is `disjoint`
  NoSector reason = NoSector::none;
  std::size_t left_point = 0, right_point = 0;  // indices of the obstacle's points that the edges touch
  int tried = 0;                                // points from which tangents were drawn
};

struct SearchOptions {
  /// Every `keep_every`-th point of the obstacle is kept, and the last one: the source's down-sampling. The
  /// sector is that of the points kept, within the sector of all.
  int keep_every = 1;
};

/// The source's search (6.3.3). `chain`: the points in order, from one extreme end of what is seen to the
/// other. From both ends two tangents each are drawn to the agent; one is taken that has the agent's centre
/// and that of the points on opposite sides and all points on one. Until one is found for each edge the
/// search goes on with the next points inwards. Points within 1e-13 (relative to their distance from the
/// contact) of a tangent count as on it. Where the sector exists the search finds it, whatever the order: the
/// order decides how soon. Time O(n) for each point tried. Throws InputError naming "keep_every", and a
/// number of a point that is not finite ("chain[3][0]"), as all of these do.
[[nodiscard]] VisibleSector visible_sector(const Ellipse& agent, std::span<const Eigen::Vector2d> chain,
                                           const SearchOptions& options = {});

/// The same search for an agent given by points (6.3.4): corners of its section, in any order. The source
/// uses an iteration of an earlier paper; here the tangents from a point to the agent are the lines through
/// the agent's points of extreme bearing, and the rest is the same. Time O(n + m) for each point tried, m the
/// corners of the agent's convex hull.
[[nodiscard]] VisibleSector visible_sector(std::span<const Eigen::Vector2d> agent,
                                           std::span<const Eigen::Vector2d> chain,
                                           const SearchOptions& options = {});

/// The same sector without a search: the largest tangent angle over the points, in one pass for each edge.
/// Points in any order; time O(n).
[[nodiscard]] VisibleSector sector_of_points(const Ellipse& agent, std::span<const Eigen::Vector2d> points);

/// The same for an agent given by points: an edge turns about the contacts of both convex hulls in turn until
/// it rests on both. Time O((m + n) log(m + n)).
[[nodiscard]] VisibleSector sector_of_points(std::span<const Eigen::Vector2d> agent,
                                             std::span<const Eigen::Vector2d> points);

}  // namespace vericone
