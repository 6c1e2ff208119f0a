// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/camera.h>
#include <vericone/geometry/error.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

namespace vericone {

Camera Camera::of_field_of_view(int width, int height, double field_of_view) {
  if (width < 1) throw InputError("width", std::to_string(width), "a number of pixels, at least 1");
  if (height < 1) throw InputError("height", std::to_string(height), "a number of pixels, at least 1");
  if (!(field_of_view > 0 && field_of_view < std::numbers::pi))
    throw InputError("field_of_view", std::to_string(field_of_view), "above 0 and below pi rad");
  return {
      width, height, 0.5 * width / std::tan(0.5 * field_of_view), {0.5 * (width - 1), 0.5 * (height - 1)}};
}

std::optional<Eigen::Vector2d> Camera::project(const Eigen::Vector3d& point) const {
  if (!(point.z() > 0)) return std::nullopt;
  return centre + focal / point.z() * point.head<2>();
}

Eigen::Matrix<double, 2, 3> Camera::projection_rates(const Eigen::Vector3d& point) const {
  const double scale = focal / point.z();
  Eigen::Matrix<double, 2, 3> rates;
  rates << scale, 0, -scale * point.x() / point.z(), 0, scale, -scale * point.y() / point.z();
  return rates;
}

Eigen::Vector3d Camera::ray(const Eigen::Vector2d& pixel) const {
  return ((pixel - centre) / focal).homogeneous();
}

bool Camera::sees(const Eigen::Vector2d& pixel, double margin) const {
  return pixel.x() >= margin - 0.5 && pixel.y() >= margin - 0.5 && pixel.x() <= width - 0.5 - margin &&
         pixel.y() <= height - 0.5 - margin;
}

Eigen::Matrix3d nadir() {
  Eigen::Matrix3d rotation;
  rotation << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  return rotation;
}

std::optional<Eigen::Vector3d> ground_point(const Camera& camera, const Pose& pose,
                                            const Eigen::Vector2d& pixel, double height) {
  const Eigen::Vector3d ray = pose.rotation * camera.ray(pixel);
  const double along = (height - pose.position.z()) / ray.z();
  if (!(along > 0) || !std::isfinite(along)) return std::nullopt;
  return pose.position + along * ray;
}

Eigen::Matrix3d plane_homography(const Camera& camera, const Pose& pose, double height) {
  // A point (x, y, height) is R' ((x, y, height) - p) in the camera's frame: linear in (x, y, 1).
  Eigen::Matrix3d plane;
  plane.col(0) = pose.rotation.row(0).transpose();
  plane.col(1) = pose.rotation.row(1).transpose();
  plane.col(2) = pose.rotation.transpose() * (Eigen::Vector3d(0, 0, height) - pose.position);
  Eigen::Matrix3d inner;
  inner << camera.focal, 0, camera.centre.x(), 0, camera.focal, camera.centre.y(), 0, 0, 1;
  return inner * plane;
}

}  // namespace vericone
