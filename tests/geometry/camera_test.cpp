// SPDX-License-Identifier: BSD-3-Clause
//
// The pinhole camera: there and back, by differences, and the plane's homography.
#include <gtest/gtest.h>
#include <vericone/geometry/camera.h>
#include <vericone/geometry/error.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace vericone::camera_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180;

/// Above the ground, looking down but for at most 0.6 rad.
Pose random_pose(std::mt19937& engine) {
  std::uniform_real_distribution<double> part(-1, 1);
  const Vector3d axis(part(engine), part(engine), part(engine));
  return {{100 * part(engine), 100 * part(engine), 150 + 100 * part(engine)},
          Eigen::AngleAxisd(0.6 * part(engine), axis.normalized()).toRotationMatrix() * nadir()};
}

TEST(Camera, FieldOfViewIsThatOfTheSource) {
  // (4.17) with pixels of 6.25 um: 47 degrees over a sensor of 5 mm, 800 px; errata 4.3 for what it covers.
  const Camera three = Camera::of_field_of_view(800, 600, 47 * kDegree);
  EXPECT_NEAR(three.focal * 6.25e-6, 2.5e-3 / std::tan(23.5 * kDegree), 1e-15);
  for (const auto& [degrees, half] : {std::pair{47.0, 147.8}, {50.0, 158.5}}) {
    const Camera four = Camera::of_field_of_view(1000, 800, degrees * kDegree);
    EXPECT_NEAR(425 * 0.5 * four.height / four.focal, half, 0.06);
  }
  const Camera camera = Camera::of_field_of_view(1000, 800, 50 * kDegree);
  // The field ends at the edges, half a pixel beyond the last middles.
  EXPECT_NEAR(std::atan(camera.ray({999.5, 0}).x()), 25 * kDegree, 1e-15);
  EXPECT_NEAR(std::atan(camera.ray({-0.5, 0}).x()), -25 * kDegree, 1e-15);
  EXPECT_TRUE(camera.sees({999.5, 799.5}));
  EXPECT_FALSE(camera.sees({999.6, 100}));
  EXPECT_FALSE(camera.sees({999, 100}, 1));
  EXPECT_TRUE(camera.sees({998.5, 100}, 1));
  EXPECT_EQ(*camera.project({0, 0, 7}), camera.centre);
  EXPECT_FALSE(camera.project({1, 1, 0}));
  EXPECT_FALSE(camera.project({1, 1, -3}));
}

TEST(Camera, PixelsAndPointsGoThereAndBack) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> part(0, 1);
  const Camera camera = Camera::of_field_of_view(1000, 800, 50 * kDegree);
  double worst = 0, homography = 0;
  for (int i = 0; i < 1000; ++i) {
    const Pose pose = random_pose(engine);
    const Vector2d pixel(1000 * part(engine), 800 * part(engine));
    const double height = 20 * part(engine);
    const auto place = ground_point(camera, pose, pixel, height);
    if (!place) continue;
    EXPECT_NEAR(place->z(), height, 1e-9);
    worst = std::max(worst, (*camera.project(pose.to_body(*place)) - pixel).norm());
    const Vector3d same = plane_homography(camera, pose, height) * Vector3d(place->x(), place->y(), 1);
    homography = std::max(homography, (same.hnormalized() - pixel).norm());
  }
  EXPECT_LT(worst, 1e-9);
  EXPECT_LT(homography, 1e-9);
}

TEST(Camera, NadirHasNorthAtTheTop) {
  const Camera camera = Camera::of_field_of_view(101, 101, 1);
  const Pose pose{{10, 20, 100}, nadir()};
  EXPECT_NEAR(nadir().determinant(), 1, 1e-15);
  EXPECT_EQ(*camera.project(pose.to_body({10, 20, 0})), Vector2d(50, 50));
  EXPECT_LT(camera.project(pose.to_body({10, 21, 0}))->y(), 50);  // north: up
  EXPECT_GT(camera.project(pose.to_body({11, 20, 0}))->x(), 50);  // east: to the right
}

TEST(Camera, RatesAreDifferences) {
  std::mt19937 engine(2);
  std::uniform_real_distribution<double> part(-1, 1);
  const Camera camera = Camera::of_field_of_view(800, 600, 1);
  for (int i = 0; i < 200; ++i) {
    const Vector3d point(20 * part(engine), 20 * part(engine), 30 + 20 * part(engine));
    const Eigen::Matrix<double, 2, 3> rates = camera.projection_rates(point);
    for (int k = 0; k < 3; ++k) {
      constexpr double kStep = 1e-4;
      const Vector3d by = kStep * Vector3d::Unit(k);
      const Vector2d difference = (*camera.project(point + by) - *camera.project(point - by)) / (2 * kStep);
      EXPECT_LT((difference - rates.col(k)).norm(), 1e-7 * (1 + rates.norm()));
    }
  }
}

TEST(Camera, ThereIsNoGroundAboveTheHorizon) {
  const Camera camera = Camera::of_field_of_view(800, 600, 1);
  const Pose level{{0, 0, 10},
                   Eigen::AngleAxisd(90 * kDegree, Vector3d::UnitX()).toRotationMatrix() * nadir()};
  int found = 0;
  for (const double v : {100.0, 500.0}) found += ground_point(camera, level, {400, v}).has_value();
  EXPECT_EQ(found, 1);
  // Nor below a camera that is under the plane and looks down.
  EXPECT_FALSE(ground_point(camera, {{0, 0, 10}, nadir()}, {400, 300}, 20));
}

TEST(Camera, BadOnesAreNamed) {
  const auto refused = [](int width, int height, double field) -> std::string {
    try {
      static_cast<void>(Camera::of_field_of_view(width, height, field));
    } catch (const InputError& e) {
      return e.field();
    }
    return "";
  };
  EXPECT_EQ(refused(0, 1, 1), "width");
  EXPECT_EQ(refused(1, 0, 1), "height");
  EXPECT_EQ(refused(1, 1, 0), "field_of_view");
  EXPECT_EQ(refused(1, 1, 3.2), "field_of_view");
  EXPECT_EQ(refused(1, 1, std::nan("")), "field_of_view");
  EXPECT_EQ(refused(1, 1, 1), "");
}

}  // namespace
}  // namespace vericone::camera_test
