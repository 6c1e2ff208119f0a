// SPDX-License-Identifier: BSD-3-Clause
//
// A pinhole camera above a ground plane. Pixels: u to the right, v down, (0, 0) the middle of the first
// pixel. The camera's own frame: x to the right, y down, z into the picture. World: metres, z up.
#pragma once

#include <vericone/geometry/pose.h>
#include <Eigen/Core>
#include <optional>

namespace vericone {

struct Camera {
  int width = 0, height = 0;                         // px
  double focal = 0;                                  // px
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  // px, of the principal point

  /// (4.17): focal length of a field of view over the width, rad; the principal point in the middle. Throws
  /// InputError naming "width", "height" or "field_of_view" (0 to pi, both out).
  [[nodiscard]] static Camera of_field_of_view(int width, int height, double field_of_view);

  /// Where a point of the camera's own frame appears; nothing where it is not in front (z > 0).
  [[nodiscard]] std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& point) const;
  /// d(pixel) / d(point), of a point in front.
  [[nodiscard]] Eigen::Matrix<double, 2, 3> projection_rates(const Eigen::Vector3d& point) const;
  /// Direction to a pixel in the camera's own frame; z = 1.
  [[nodiscard]] Eigen::Vector3d ray(const Eigen::Vector2d& pixel) const;
  /// Whether a pixel lies in the picture, `margin` px from its edges.
  [[nodiscard]] bool sees(const Eigen::Vector2d& pixel, double margin = 0) const;
};

/// The rotation of a camera that looks straight down, the top of its picture to the north (world y).
[[nodiscard]] Eigen::Matrix3d nadir();

/// Where a pixel's ray meets the plane z = height; nothing where it does not, in front of the camera.
[[nodiscard]] std::optional<Eigen::Vector3d> ground_point(const Camera& camera, const Pose& pose,
                                                          const Eigen::Vector2d& pixel, double height = 0);
/// H of the plane z = height, m to px: (u, v, 1) ~ H (x, y, 1), world x and y.
[[nodiscard]] Eigen::Matrix3d plane_homography(const Camera& camera, const Pose& pose, double height = 0);

}  // namespace vericone
