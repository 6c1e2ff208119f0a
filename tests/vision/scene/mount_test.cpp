// SPDX-License-Identifier: BSD-3-Clause
//
// Cameras on bodies: what they see of the ground when the body tilts.
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/vehicles/quadrotor_dynamics.h>
#include <vericone/internal/vision/scene/attitude.h>
#include <vericone/vehicles/quadrotor.h>
#include <vericone/vision/scene/scene.h>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace vericone::vision::mount_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180;

Camera camera() { return Camera::of_field_of_view(1000, 800, 50 * kDegree); }

TEST(Mount, AttitudeIsTheQuadrotors) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> part(-1, 1);
  for (int i = 0; i < 200; ++i) {
    const Vector3d a = 6 * Vector3d(part(engine), part(engine), part(engine));
    const double heading = 3 * part(engine);
    vehicles::QuadrotorState state;
    state.angles.z() = -heading;
    state.angles.y() = vehicles::thrust_and_tilt({}, state, a).pitch;
    state.angles.x() = vehicles::thrust_and_tilt({}, state, a).roll;
    EXPECT_LT((attitude_for(a, heading) - vehicles::quadrotor_rotation(state)).norm(), 1e-12);
  }
}

TEST(Mount, StrapdownLosesThePointBelowAtHalfItsField) {
  const std::vector<Vector3d> below{{0, 0, 0}};
  const Vector3d position(0, 0, 200);
  // Errata 5.2: 50 degrees by 5:4, sideways 3.66 m/s^2. The picture's edge is half a pixel beyond the last
  // middle.
  const double sideways = most_acceleration_in_sight(camera(), position, 0, below, {0, 1});
  EXPECT_NEAR(sideways, 9.81 * 0.8 * std::tan(25 * kDegree), 1e-6);
  EXPECT_NEAR(sideways, 3.66, 0.005);
  const double ahead = most_acceleration_in_sight(camera(), position, 0, below, {1, 0});
  EXPECT_NEAR(ahead, 9.81 * std::tan(25 * kDegree), 1e-6);
  // Turned by a quarter it is the other way round, and climbing takes more tilt for the same.
  EXPECT_NEAR(most_acceleration_in_sight(camera(), position, 90 * kDegree, below, {0, 1}), ahead, 1e-6);
  EXPECT_NEAR(most_acceleration_in_sight(camera(), position, 0, below, {0, 1}, 20, 0, 9.81), 2 * sideways,
              1e-5);
  // What it says is the edge.
  for (const double factor : {0.999, 1.001}) {
    const Pose pose{position, attitude_for({0, factor * sideways, 0}, 0) * nadir()};
    EXPECT_EQ(camera().sees(*camera().project(pose.to_body(below[0]))), factor < 1);
  }
}

TEST(Mount, LimitMindsAllPointsAndItsMargin) {
  const Vector3d position(0, 0, 100);
  const std::vector<Vector3d> points{{10, 5, 0}, {-20, -15, 0}};
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> part(-1, 1);
  for (int i = 0; i < 50; ++i) {
    const Vector2d direction = Vector2d(part(engine), part(engine)).normalized();
    const double heading = 3 * part(engine), margin = 20;
    const double most =
        most_acceleration_in_sight(camera(), position, heading, points, direction, 20, margin);
    const auto seen = [&](double a) {
      const Pose pose{position, attitude_for({a * direction.x(), a * direction.y(), 0}, heading) * nadir()};
      bool all = true;
      for (const Vector3d& p : points) all &= camera().sees(*camera().project(pose.to_body(p)), margin);
      return all;
    };
    for (double a = 0; a < most; a += 0.05) EXPECT_TRUE(seen(a));
    EXPECT_FALSE(seen(most + 1e-3));
    EXPECT_LT(most, most_acceleration_in_sight(camera(), position, heading, points, direction));
  }
  const std::vector<Vector3d> out{{80, 0, 0}};
  EXPECT_EQ(most_acceleration_in_sight(camera(), position, 0, out, {1, 0}), 0);
  EXPECT_EQ(most_acceleration_in_sight(camera(), position, 0, points, {1, 0}, 0.5), 0.5);
  EXPECT_THROW(static_cast<void>(most_acceleration_in_sight(camera(), position, 0, out, {0, 0})), InputError);
}

TEST(Mount, KindsHangAsTheySay) {
  const Pose body{{1, 2, 50}, attitude_for({2, -1, 0}, 0.3)};
  EXPECT_EQ(CameraMount({MountKind::north_up}).at(0, body).rotation, nadir());
  EXPECT_EQ(CameraMount({MountKind::strapdown}).at(0, body).rotation, Matrix3d(body.rotation * nadir()));
  EXPECT_LT((CameraMount({MountKind::gimbal}).at(0, body).rotation - nadir()).norm(), 1e-12);
  // At a point: in the middle of the picture, north to the top.
  const Vector3d point(30, -10, 0);
  const Pose at = CameraMount({MountKind::gimbal}).at(0, body, point);
  EXPECT_LT((*camera().project(at.to_body(point)) - camera().centre).norm(), 1e-9);
  EXPECT_LT(camera().project(at.to_body(point + Vector3d(0, 1, 0)))->y(), camera().centre.y());
  EXPECT_NEAR(at.rotation.determinant(), 1, 1e-12);
  EXPECT_EQ(looking_at({0, 0, 5}, {0, 0, 0}), nadir());
}

TEST(Mount, GimbalTurnsNoFasterThanItsRate) {
  MountOptions options{MountKind::gimbal, 0.5, 0};
  CameraMount mount(options);
  Pose body{{0, 0, 100}, Matrix3d::Identity()};
  mount.at(0, body);
  // The body tilts at once by 20 degrees: the camera is off, and comes back at its rate.
  body.rotation = Eigen::AngleAxisd(20 * kDegree, Vector3d::UnitX()).toRotationMatrix();
  double before = 20 * kDegree;
  for (int k = 1; k <= 80; ++k) {
    const Pose at = mount.at(0.01 * k, body);
    const double off = std::acos(std::clamp(at.rotation.col(2).dot(-Vector3d::UnitZ()), -1.0, 1.0));
    EXPECT_NEAR(off, std::max(0.0, 20 * kDegree - 0.5 * 0.01 * k), 1e-6);
    EXPECT_LE(before - off, 0.5 * 0.01 + 1e-6);
    before = off;
  }
  EXPECT_THROW(mount.at(0.1, body), InputError);
}

TEST(Mount, LatencyIsOldKnowledge) {
  CameraMount prompt({MountKind::gimbal, 100, 0}), late({MountKind::gimbal, 100, 0.1});
  for (int k = 0; k <= 200; ++k) {
    const double t = 0.01 * k, roll = 0.3 * std::sin(2 * t);
    const Pose body{{0, 0, 100}, Eigen::AngleAxisd(roll, Vector3d::UnitX()).toRotationMatrix()};
    EXPECT_LT((prompt.at(t, body).rotation - nadir()).norm(), 1e-9);
    const Matrix3d off = late.at(t, body).rotation;
    if (t < 0.2) continue;
    // It undoes the roll of a tenth of a second ago.
    const double left = roll - 0.3 * std::sin(2 * (t - 0.1));
    EXPECT_NEAR(std::abs(Eigen::AngleAxisd(Matrix3d(off * nadir().transpose())).angle()), std::abs(left),
                1e-6);
  }
  EXPECT_THROW(CameraMount({MountKind::gimbal, 0, 0}), InputError);
  EXPECT_THROW(CameraMount({MountKind::gimbal, 1, -1}), InputError);
}

}  // namespace
}  // namespace vericone::vision::mount_test
