// SPDX-License-Identifier: BSD-3-Clause
//
// Sectors against what a sensor sees on one plane, and the points of a plane.
#pragma once

#include <vericone/cones/slices/visible_cone.h>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace vericone {

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

/// Half of the distance between neighbouring beams at the farthest point: the thinnest slab that every plane
/// through a cloud of beams `spacing` radians apart meets about once a beam. Metres.
[[nodiscard]] double slab_half_thickness(std::span<const Eigen::Vector3d> cloud,
                                         const Eigen::Vector3d& sensor, double spacing);

/// The corners of the section of a mesh (mesh_section.h), or of the part of one that is given by some of its
/// triangles. Keeps both.
[[nodiscard]] PlanePoints mesh_section_points(std::vector<Eigen::Vector3d> points,
                                              std::vector<std::array<std::uint32_t, 3>> triangles);

/// Points (m) of a plane in the order of their bearing from its origin, the nearer first: from one extreme
/// end to the other for points on the side of its x axis.
void order_by_bearing(std::vector<Eigen::Vector2d>& points);

}  // namespace vericone
