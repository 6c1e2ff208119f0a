// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/vision/scene/attitude.h>
#include <vericone/vision/scene/scene.h>

#include <vericone/geometry/error.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace vericone::vision {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// From one attitude towards another by at most an angle.
Matrix3d turned_towards(const Matrix3d& from, const Matrix3d& to, double most) {
  Eigen::AngleAxisd by(Matrix3d(from.transpose() * to));
  if (std::abs(by.angle()) <= most) return to;
  by.angle() = std::copysign(most, by.angle());
  return from * by.toRotationMatrix();
}

}  // namespace

CameraMount::CameraMount(const MountOptions& options) : options_(options) {
  if (!(options.rate > 0)) throw InputError("rate", to_text(options.rate), "positive (rad/s)");
  if (!(options.latency >= 0) || !std::isfinite(options.latency))
    throw InputError("latency", to_text(options.latency), "a finite number, 0 or more (s)");
}

Pose CameraMount::at(double t, const Pose& body, const std::optional<Vector3d>& aim) {
  if (options_.kind == MountKind::north_up) return {body.position, nadir()};
  if (options_.kind == MountKind::strapdown) return {body.position, body.rotation * nadir()};
  const Matrix3d wanted = body.rotation.transpose() * (aim ? looking_at(body.position, *aim) : nadir());
  if (!in_body_) {
    in_body_ = wanted;
  } else if (t < t_) {
    throw InputError("t", to_text(t), "not before the time asked for last, " + to_text(t_) + " s");
  }
  known_.push_back({t, wanted});
  // What is old enough, and of that the newest. Times that differ by rounding only are one.
  constexpr double kOne = 1e-9;
  while (known_.size() > 1 && known_[1].t <= t - options_.latency + kOne) known_.pop_front();
  in_body_ = turned_towards(*in_body_, known_.front().wanted, options_.rate * (t - t_));
  t_ = t;
  return {body.position, body.rotation * *in_body_};
}

Matrix3d looking_at(const Vector3d& from, const Vector3d& point) {
  const Vector3d ahead = (point - from).normalized();
  // Pictures have y down: to the south. Looking along the meridian itself, up takes its place.
  Vector3d down = -Vector3d::UnitY() + ahead * ahead.y();
  if (down.norm() < 1e-9) down = -Vector3d::UnitZ() + ahead * ahead.z();
  down.normalize();
  Matrix3d rotation;
  rotation << down.cross(ahead), down, ahead;
  return rotation;
}

Matrix3d attitude_for(const Vector3d& acceleration, double heading, double gravity) {
  const Vector3d up = (acceleration + gravity * Vector3d::UnitZ()).normalized();
  const double c = std::cos(heading), s = std::sin(heading);
  const Vector3d ahead = Vector3d(c, s, -(c * up.x() + s * up.y()) / up.z()).normalized();
  Matrix3d rotation;
  rotation << ahead, up.cross(ahead), up;
  return rotation;
}

double most_acceleration_in_sight(const Camera& camera, const Vector3d& position, double heading,
                                  std::span<const Vector3d> points, const Eigen::Vector2d& direction,
                                  double most, double margin, double climb, double gravity) {
  if (!direction.allFinite() || !direction.any())
    throw InputError("direction", "0", "a level direction that is not 0");
  if (!position.allFinite() || !std::isfinite(heading + margin + climb + gravity))
    throw InputError("position, heading, margin, climb, gravity", "a number that is not finite", "finite");
  if (!(most > 0) || !std::isfinite(most)) throw InputError("most", to_text(most), "positive (m/s^2)");
  const Eigen::Vector2d along = direction.normalized();
  const auto in_sight = [&](double a) {
    const Pose pose{position,
                    attitude_for({a * along.x(), a * along.y(), climb}, heading, gravity) * nadir()};
    return std::all_of(points.begin(), points.end(), [&](const Vector3d& point) {
      const auto pixel = camera.project(pose.to_body(point));
      return pixel && camera.sees(*pixel, margin);
    });
  };
  const double up = gravity + climb;
  const auto acceleration = [&](double tilt) { return up * std::tan(tilt); };
  if (!in_sight(0)) return 0;
  constexpr double kStep = 0.005;
  const double end = std::atan2(most, up);
  double low = 0, high = 0;
  do {
    low = high;
    if (low >= end) return most;
    high = std::min(low + kStep, end);
  } while (in_sight(acceleration(high)));
  while (high - low > 1e-9) {
    const double middle = 0.5 * (low + high);
    (in_sight(acceleration(middle)) ? low : high) = middle;
  }
  return acceleration(low);
}

}  // namespace vericone::vision
