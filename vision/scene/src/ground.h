// SPDX-License-Identifier: BSD-3-Clause
//
// A picture that lies on the ground again and again.
#pragma once

#include <vericone/geometry/camera.h>
#include <vericone/geometry/pose.h>
#include <vericone/vision/scene/scene.h>
#include <vericone/vision/tracker.h>
#include <memory>

namespace vericone::vision {

class GroundPicture {
 public:
  GroundPicture(const Ground& ground, int channels);
  ~GroundPicture();

  /// All of the picture, sky beyond the horizon. The texture is taken at the size nearest to that of the
  /// pixels at the picture's middle.
  void draw(const Camera& camera, const Pose& pose, Image& image) const;
  /// How bright the ground is at a place, seen with pixels of so many metres, less its mean: of -1 to 1.
  [[nodiscard]] float relief(double x, double y, double metres) const;

 private:
  struct Level;
  [[nodiscard]] const Level& level(double metres) const;

  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace vericone::vision
