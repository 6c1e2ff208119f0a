// SPDX-License-Identifier: BSD-3-Clause
//
// How a camera hangs on a body that flies, and how hard the body may accelerate without losing sight.
#pragma once

#include <vericone/geometry/camera.h>
#include <vericone/geometry/pose.h>
#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>

namespace vericone::vision {

enum class MountKind : std::uint8_t {
  north_up,   // nadir() whatever the body's attitude is: the source's
  strapdown,  // fixed in the body, nadir() when that is level with the heading 0
  gimbal,     // turned in the body, at a limited rate, to look as north_up does or at a point
};

struct MountOptions {
  MountKind kind = MountKind::north_up;
  double rate = 3;     // rad/s at most, of a gimbal's turn in the body
  double latency = 0;  // s, so old is what a gimbal knows of the body's pose and of the point
};

/// Gives the true pose of the camera. Throws InputError naming "rate" or "latency".
class CameraMount {
 public:
  explicit CameraMount(const MountOptions& options);

  /// The camera at a time, s, never before the last one asked for. A gimbal starts as it wants to be, and
  /// stays as near as its rate allows. `aim`: a point to look at, in the world, the picture's top as far to
  /// the north as can be; left out: straight down. Throws InputError naming "t".
  [[nodiscard]] Pose at(double t, const Pose& body, const std::optional<Eigen::Vector3d>& aim = {});

 private:
  struct Known {
    double t;
    Eigen::Matrix3d wanted;  // of the camera in the body
  };

  MountOptions options_;
  double t_ = 0;
  std::optional<Eigen::Matrix3d> in_body_;
  std::deque<Known> known_;
};

/// Looking at a point that is not straight above, the picture's top as far to the north (world y) as can be.
[[nodiscard]] Eigen::Matrix3d looking_at(const Eigen::Vector3d& from, const Eigen::Vector3d& point);

/// The attitude (body x forward, y left, z up, as a Motion's) in which a thrust along z gives an
/// acceleration, m/s^2, at a heading, rad: (4.28). Not defined where the acceleration is that of free fall.
[[nodiscard]] Eigen::Matrix3d attitude_for(const Eigen::Vector3d& acceleration, double heading,
                                           double gravity = 9.81);

/// The largest acceleration, m/s^2, along a level direction with which all points stay in the picture of a
/// strapdown camera of a body at `position`, `margin` px from its edges: by attitude_for in steps of 0.005
/// rad, then halved to 1e-9. 0 where a point is out already; `most` where none gets out. Vertical
/// acceleration: `climb`. Throws InputError naming "direction" (0) or "most" (not positive). Cost: 40 ns a
/// point and step.
[[nodiscard]] double most_acceleration_in_sight(const Camera& camera, const Eigen::Vector3d& position,
                                                double heading, std::span<const Eigen::Vector3d> points,
                                                const Eigen::Vector2d& direction, double most = 20,
                                                double margin = 0, double climb = 0, double gravity = 9.81);

}  // namespace vericone::vision
