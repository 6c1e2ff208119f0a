// SPDX-License-Identifier: BSD-3-Clause
//
// Pictures of vehicles on the ground as a camera above sees them.
#pragma once

#include <vericone/geometry/camera.h>
#include <vericone/vision/image.h>
#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

namespace vericone::vision {

/// The ground: a picture laid on it again and again, or one of our own making.
struct Ground {
  std::filesystem::path picture;  // empty: made from `seed`
  double metres_per_pixel = 0.25;
  std::uint64_t seed = 1;
  bool plain = false;  // one colour with a few marks, as the source's chapter 3
};

/// An upright block with a flat bottom, that stands on the ground or hangs over it: a bridge, a roof, a
/// tree's crown; the source's bars are flat ones at height 0.
struct Occluder {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero(), size = Eigen::Vector2d::Zero();  // m, along x and y
  double bottom = 0, top = 0;                                                        // m
  double from = 0, to = 1e300;                                                       // s, when it is there
};

struct VehicleLook {
  Eigen::Vector3d size = Eigen::Vector3d(6, 2.5, 1.6);  // m: length, width, height; height 0: a flat sprite
  std::uint32_t seed = 1;                               // of its colours; equal seeds look alike
};

struct SceneOptions {
  Ground ground;
  std::vector<VehicleLook> vehicles;
  std::vector<Occluder> occluders;
  double noise = 0;     // standard deviation, grey levels
  double blur = 0;      // px, of the lens
  double exposure = 0;  // s, of motion blur
  double light = 1;     // of full sun; below 0.5 dusk
  bool shadows = false;
  int channels = 1;
  std::uint64_t seed = 1;  // of the noise
};

/// A vehicle at a time: where, m, on the ground; heading, rad from x to y.
struct PlacedVehicle {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double heading = 0;
};

/// What is true of a vehicle in a picture, for truth files and metrics alone.
struct VehicleTruth {
  Box box;             // of all of it, as if nothing hid it, even beyond the picture
  double visible = 0;  // part of its pixels that the picture shows, 0 to 1
};

class Scene {
 public:
  /// Throws InputError naming "ground.picture", "occluders[i].size", "noise", ...
  explicit Scene(const SceneOptions& options);
  ~Scene();
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;

  /// The picture at a time t, s; `frame` counts pictures, for the noise. With `exposure`, `before` is the
  /// camera's pose that long earlier.
  void render(const Camera& camera, const Pose& pose, std::span<const PlacedVehicle> vehicles, double t,
              std::uint64_t frame, Image& image, const Pose* before = nullptr);
  [[nodiscard]] std::vector<VehicleTruth> truth(const Camera& camera, const Pose& pose,
                                                std::span<const PlacedVehicle> vehicles, double t);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace vericone::vision
