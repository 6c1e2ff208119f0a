// SPDX-License-Identifier: BSD-3-Clause
//
// How a camera hangs on a body that flies, and how hard the body may accelerate without losing sight.
#pragma once

#include <vericone/geometry/camera.h>
#include <vericone/geometry/pose.h>
#include <vericone/vision/tracker.h>
#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

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

/// The largest acceleration, m/s^2, along a level direction with which all points stay in the picture of a
/// strapdown camera of a body at `position`, `margin` px from its edges: by attitude_for in steps of 0.005
/// rad, then halved to 1e-9. 0 where a point is out already; `most` where none gets out. Vertical
/// acceleration: `climb`. Throws InputError naming "direction" (0) or "most" (not positive). Cost: 40 ns a
/// point and step.
[[nodiscard]] double most_acceleration_in_sight(const Camera& camera, const Eigen::Vector3d& position,
                                                double heading, std::span<const Eigen::Vector3d> points,
                                                const Eigen::Vector2d& direction, double most = 20,
                                                double margin = 0, double climb = 0, double gravity = 9.81);

// Pictures of vehicles on the ground as a camera above sees them: by rays for vehicles, so that they are
// where they are to a small part of a pixel; by a warp for the ground.

/// The ground z = 0: a picture laid on it again and again, or one of our own making, with fields, roads and
/// marks.
struct Ground {
  Image picture;                   // north up, its lower left corner at the origin; empty: made from `seed`
  double metres_per_pixel = 0.25;  // m/px, of the picture; ours repeats after 2048 px
  std::uint64_t seed = 1;
  bool plain = false;  // one colour, with marks of 15 x 0.5 m, as the source's
  double marks = 0;    // of a plain ground, in a square kilometre; the source's chapter 3 has about 800
};

/// An upright block with a flat bottom, that stands on the ground or hangs over it: a bridge, a roof, a
/// tree's crown. One with its top at 0 covers whatever is on the ground there, as the source's bars do.
struct Occluder {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero(), size = Eigen::Vector2d::Zero();  // m, along x and y
  double bottom = 0, top = 0;                                                        // m
  double from = 0, to = 1e300;                                                       // s, when it is there
  double texture = 0;  // 0: one colour, as the source's; 1: as rough as the ground
};

struct VehicleLook {
  Eigen::Vector3d size = Eigen::Vector3d(6, 2.5, 1.6);  // m: length, width, height; height 0: a flat sprite
  std::uint32_t seed = 1;                               // of its colours; equal seeds look alike
};

struct SceneOptions {
  Ground ground;
  std::vector<VehicleLook> vehicles;
  std::vector<Occluder> occluders;
  double noise = 0;      // standard deviation, grey levels
  double blur = 0;       // px, standard deviation, of the lens
  double exposure = 0;   // s, of motion blur
  double light = 1;      // part of full sun; below 0.5 dusk
  bool shadows = false;  // on the ground, towards the north-east
  int channels = 1;
  std::uint64_t seed = 1;  // of the noise
};

/// A vehicle at a time: where the middle of its bottom is, on the ground; heading, rad from x to y. Its
/// velocity is for motion blur alone.
struct PlacedVehicle {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // m
  double heading = 0;
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // m/s
};

/// What is true of a vehicle in a picture, for truth files and metrics alone.
struct VehicleTruth {
  Box box;  // of all of it, as if nothing hid it, even beyond the picture; empty where it is behind
  double visible = 0;  // part of its pixels that the picture shows, 0 to 1, of 32 x 32 rays within the box
};

class Scene {
 public:
  /// Throws InputError naming "ground.picture", "ground.metres_per_pixel", "ground.marks",
  /// "vehicles[i].size", "occluders[i].size", ".bottom", ".texture" or ".to", "noise", "blur", "exposure",
  /// "light" or "channels". Cost: 0.3 s where the ground is made.
  explicit Scene(const SceneOptions& options);
  ~Scene();
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;

  /// The picture at a time t, s; `frame` counts pictures, for the noise: equal arguments give equal pictures.
  /// With `exposure`, `before` is the camera's pose that long earlier (left out: it stood still). One vehicle
  /// for each of SceneOptions::vehicles, else InputError naming "vehicles"; "camera" of more than 1e8 pixels.
  /// Cost: docs/explanation/scene.md.
  void render(const Camera& camera, const Pose& pose, std::span<const PlacedVehicle> vehicles, double t,
              std::uint64_t frame, Image& image, const Pose* before = nullptr);
  [[nodiscard]] std::vector<VehicleTruth> truth(const Camera& camera, const Pose& pose,
                                                std::span<const PlacedVehicle> vehicles, double t) const;

  /// In place of those there were: bars that come again ahead of a camera. Throws as the constructor.
  void set_occluders(std::vector<Occluder> occluders);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace vericone::vision
