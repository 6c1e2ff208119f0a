// SPDX-License-Identifier: BSD-3-Clause
//
// The geometry of perception: boxes to places on the ground and back, with a tracker that answers as told.
#include <gtest/gtest.h>
#include <vericone/vision/pursuit/perception.h>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace vericone::vision::testing::perception_test {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Says what it is told, and keeps what it was asked.
struct Told : Tracker {
  std::vector<Sighting> answer;
  std::vector<Expectation> asked;
  Eigen::Matrix3d moved = Eigen::Matrix3d::Identity();
  void start(const Image&, std::span<const Box>) override {}
  void add(const Box&) override {}
  const std::vector<Sighting>& step(const Image&, const std::optional<Eigen::Matrix3d>& ground,
                                    std::span<const Expectation> expected) override {
    moved = *ground;
    asked.assign(expected.begin(), expected.end());
    return answer;
  }
};

const Camera kCamera = Camera::of_field_of_view(800, 600, std::numbers::pi / 3);

/// A camera that drifts, climbs and tilts.
Pose camera_at(double t) {
  const double roll = 0.1 * std::sin(t), pitch = 0.15 * std::cos(0.7 * t);
  Eigen::Matrix3d tilt;
  tilt = Eigen::AngleAxisd(roll, Vector3d::UnitX()) * Eigen::AngleAxisd(pitch, Vector3d::UnitY());
  return {{20 * t, -2 * t, 120 + 3 * t}, tilt * nadir()};
}

Vector2d car_at(double t) { return {10 + 21 * t, 5 - 1.5 * t + 0.1 * t * t}; }

Box box_of(const Pose& pose, const Vector2d& place, double height) {
  const auto pixel = kCamera.project(pose.to_body({place.x(), place.y(), height}));
  return {pixel->x() - 10, pixel->y() - 5, 20, 10};
}

TEST(Perception, FindsTheStateOfAVehicleUnderACameraThatTilts) {
  PerceptionOptions options;
  options.camera = kCamera;
  options.height = 0.8;
  auto made = std::make_unique<Told>();
  Told& told = *made;
  Perception perception(options, std::move(made));
  const Box first = box_of(camera_at(0), car_at(0), 0.8);
  perception.start({}, camera_at(0), 0, std::span(&first, 1));
  for (int k = 1; k <= 100; ++k) {
    const double t = 0.04 * k;
    told.answer = {{Sight::no_occlusion, box_of(camera_at(t), car_at(t), 0.8), true,
                    0.01 * Eigen::Matrix2d::Identity(), 1}};
    perception.step({}, camera_at(t), t);
    // The expectation is where the vehicle then is, once its velocity is known.
    if (k > 20) {
      EXPECT_LT((told.asked[0].centre - told.answer[0].box.centre()).norm(), 2);
    }
    // Points of the ground move by the homography.
    const Vector3d point(30, -8, 0);
    const Vector2d before = *kCamera.project(camera_at(t - 0.04).to_body(point)),
                   after = *kCamera.project(camera_at(t).to_body(point));
    EXPECT_LT(((told.moved * before.homogeneous()).hnormalized() - after).norm(), 1e-6);
  }
  const guidance::SingerFilter& filter = perception.vehicles()[0].filter;
  EXPECT_LT((filter.position() - car_at(4)).norm(), 0.05);
  EXPECT_LT((filter.velocity() - Vector2d(21, -0.7)).norm(), 0.2);
  // The box is about the middle here; what is followed of a vehicle is taken to be a little higher.
  ASSERT_TRUE(perception.vehicles()[0].measured);
  EXPECT_LT((*perception.vehicles()[0].measured - car_at(4)).norm(), 0.05);
}

TEST(Perception, AHiddenVehicleGivesNoMeasurementOursAndItsOldPlaceTheSources) {
  for (const bool source : {false, true}) {
    PerceptionOptions options;
    options.camera = kCamera;
    options.source = source;
    auto made = std::make_unique<Told>();
    Told& told = *made;
    Perception perception(options, std::move(made));
    const auto step = [&](double t, bool hidden) {
      told.answer = {{hidden ? Sight::total : Sight::no_occlusion, box_of(camera_at(t), car_at(t), 0),
                      !hidden, 0.01 * Eigen::Matrix2d::Identity(), hidden ? 0.0 : 1.0}};
      perception.step({}, camera_at(t), t);
    };
    const Box first = box_of(camera_at(0), car_at(0), 0);
    perception.start({}, camera_at(0), 0, std::span(&first, 1));
    for (int k = 1; k <= 50; ++k) step(0.04 * k, false);
    const double before = perception.vehicles()[0].filter.belief().covariance(0, 0);
    EXPECT_LT(perception.vehicles()[0].hidden_since, 0);
    for (int k = 51; k <= 100; ++k) step(0.04 * k, true);
    EXPECT_NEAR(perception.vehicles()[0].hidden_since, 2.04, 1e-9);
    EXPECT_FALSE(perception.vehicles()[0].measured);
    const double after = perception.vehicles()[0].filter.belief().covariance(0, 0);
    EXPECT_GT(after, before);
    // Ours grows as the model says; the source's is held down by measurements that are none.
    guidance::SingerFilter free = perception.vehicles()[0].filter;
    EXPECT_LT((free.position() - car_at(4)).norm(), source ? 30 : 3);
  }
}

TEST(Perception, AVehicleBehindTheCameraIsExpectedNowhereInThePicture) {
  PerceptionOptions options;
  options.camera = kCamera;
  auto made = std::make_unique<Told>();
  Told& told = *made;
  Perception perception(options, std::move(made));
  const Box first = box_of(camera_at(0), car_at(0), 0);
  perception.start({}, camera_at(0), 0, std::span(&first, 1));
  Pose up = camera_at(0);
  up.rotation = Eigen::AngleAxisd(std::numbers::pi, Vector3d::UnitX()) * up.rotation;
  told.answer = {{Sight::total, first, false, Eigen::Matrix2d::Identity(), 0}};
  perception.step({}, up, 0.04);
  EXPECT_FALSE(kCamera.sees(told.asked[0].centre));
}

}  // namespace vericone::vision::testing::perception_test
