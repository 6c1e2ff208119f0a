// SPDX-License-Identifier: BSD-3-Clause
//
// What is fitted: points, or a mesh; and the frame in which fits are computed.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace vericone::fitting {

/// Points in metres. A mesh has triangles besides, as indices into the points; what a fit has to do with are
/// then the points that triangles use, and the triangles between them.
struct Sample {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  [[nodiscard]] bool is_mesh() const { return !triangles.empty(); }
};

/// Indices, increasing, of the points that count: all of a cloud; of a mesh those that triangles use. Throws
/// InputError naming "points[i]" where one of them is not finite and "triangles[i]" for an index that is no
/// point.
[[nodiscard]] std::vector<std::uint32_t> used_points(const Sample& sample);

/// Coordinates that belong to the sample: origin at its mean, axes along its principal directions (signs by
/// the third moments), and a length. x = origin + scale * axes * y.
struct Frame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // a rotation
  double scale = 1;

  [[nodiscard]] Eigen::Vector3d to_frame(const Eigen::Vector3d& x) const {
    return axes.transpose() * (x - origin) / scale;
  }
  [[nodiscard]] Eigen::Vector3d to_world(const Eigen::Vector3d& y) const {
    return origin + scale * (axes * y);
  }
};

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

/// Coordinates rounded to 2^-26, a hundred-millionth of the unit ball. Those of the same sample in another
/// frame differ by some 1e-15 and are then (but for one in ten million) the same numbers: searches that
/// branch are done with them, so that they take the same way.
[[nodiscard]] Eigen::Vector3d rounded(const Eigen::Vector3d& y);

/// Throws InputError naming "points" where there is none, where coordinates are not finite or above 1e100,
/// and where all are equal; "triangles[i]" for an index that is no point.
[[nodiscard]] CanonicalSample canonical(const Sample& sample);

}  // namespace vericone::fitting
