// SPDX-License-Identifier: BSD-3-Clause
//
// Upright blocks as the rays of a camera's pixels meet them.
#pragma once

#include <vericone/geometry/camera.h>
#include <vericone/geometry/pose.h>
#include <vericone/vision/scene/scene.h>
#include <Eigen/Core>
#include <limits>
#include <vector>

namespace vericone::vision {

enum class Face : std::uint8_t { along, across, level };  // whose normal is the block's x, y or z axis

struct Block {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero(), half = Eigen::Vector2d::Zero();  // m, x ahead
  double heading = 0, bottom = 0, top = 0;
  bool covers = false;  // all that is under it, at whatever height

  /// All, with the bottom first.
  [[nodiscard]] std::vector<Eigen::Vector3d> corners() const;
};
Block block_of(const VehicleLook& look, const PlacedVehicle& placed);
Block block_of(const Occluder& occluder);

/// Pixels, ends included: of all that a block may cover.
struct Span2 {
  int left = 0, top = 0, right = -1, bottom = -1;
  [[nodiscard]] bool empty() const { return right < left || bottom < top; }
  [[nodiscard]] bool meets(const Span2& o) const {
    return left <= o.right && o.left <= right && top <= o.bottom && o.top <= bottom;
  }
};

/// A block and a camera.
class BlockView {
 public:
  BlockView(const Block& block, const Camera& camera, const Pose& pose);

  static constexpr double kMissed = std::numeric_limits<double>::infinity();
  struct Hit {
    double depth = kMissed;  // m, along the camera's axis
    Face face = Face::level;
    Eigen::Vector3d place;  // in the block's axes, from the middle of its bottom plane at z = 0
  };
  /// Where the ray of (u, v) enters.
  [[nodiscard]] Hit hit(double u, double v) const;
  /// Its depth alone; 0 of blocks that cover.
  [[nodiscard]] double depth(double u, double v) const;

  [[nodiscard]] const Block& block() const { return block_; }
  [[nodiscard]] const Eigen::Vector3d& eye() const { return eye_; }  // the camera, in the block's axes
  /// The silhouette's upright box, px; empty where a corner is not in front of the camera.
  [[nodiscard]] const Box& box() const { return box_; }
  /// What of the picture it may cover: all of it where a corner is not in front.
  [[nodiscard]] const Span2& span() const { return span_; }

 private:
  struct Slabs {
    double near, far;
    Face face;
  };
  [[nodiscard]] Slabs slabs(const Eigen::Vector3d& direction) const;

  Block block_;
  Eigen::Vector3d eye_;
  Eigen::Matrix3d direction_;  // (u, v, 1) to the ray in the block's axes
  Box box_;
  Span2 span_;
};

}  // namespace vericone::vision
