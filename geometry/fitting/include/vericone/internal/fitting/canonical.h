// SPDX-License-Identifier: BSD-3-Clause
//
// A sample in a frame of its own, and what a hull is as written.
#pragma once

#include <vericone/fitting/hull.h>
#include <array>
#include <cstdint>
#include <vector>

namespace vericone::fitting {

/// Indices, increasing, of the points that count: all of a cloud; of a mesh those that triangles use. Throws
/// InputError naming "points[i]" where one of them is not finite and "triangles[i]" for an index that is no
/// point.
[[nodiscard]] std::vector<std::uint32_t> used_points(const Sample& sample);

/// A sample in its own frame: the same for a sample that is turned, moved, scaled or written in another order
/// (to rounding), so that every choice made in the frame is the same.
struct CanonicalSample {
  Frame frame;

  /// Each point once, in the frame, in increasing order of rounded coordinates (below); of a mesh those that
  /// triangles use.
  /// They lie within the unit ball.
  std::vector<Eigen::Vector3d> points;

  /// Share of each in the sample, 1 in all: of a cloud how often it is there, of a mesh a third of the area
  /// of the triangles at it.
  std::vector<double> weights;

  /// Those with area, in increasing order of their least corner, as indices into `points`.
  std::vector<std::array<std::uint32_t, 3>> triangles;

  /// One index into Sample::points for each point.
  std::vector<std::uint32_t> original;

  /// For each of Sample::points its index in `points`; kUnused for those that no triangle of a mesh uses.
  std::vector<std::uint32_t> index;
  static constexpr std::uint32_t kUnused = 0xffffffff;

  [[nodiscard]] bool is_mesh() const { return !triangles.empty(); }
};

/// Throws InputError naming "points" where there is none, where coordinates are not finite or above 1e100,
/// and where all are equal; "triangles[i]" for an index that is no point.
[[nodiscard]] CanonicalSample canonical(const Sample& sample);

/// Sets `quadrics` of a piece without any proof: `body` or `footprint` rounded, each surface scaled to -1 at
/// the centre. Far from the origin the roundings are chosen together, so that the surface stays where it is.
void set_quadrics(Piece& piece);

}  // namespace vericone::fitting
