// SPDX-License-Identifier: BSD-3-Clause
#include "scan/study_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/scanning/picture.h>
#include <vericone/testing/random_bodies.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "geometry/meshes.h"

namespace vericone::scanning::scan_study_test {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;
using testing::RandomBodies;

/// Several ellipsoids near (6, 0, 0): crossing, apart, some hidden behind others.
Setup heap(RandomBodies& random, int times) {
  testing::Mesh mesh;
  const int count = random.integer(1, 6);
  for (int i = 0; i < count; ++i) {
    const Ellipsoid e = random.ellipsoid(Vector3d(6, 0, 0) + random.in_box(1.5), 0.2, 1.2);
    mesh.append(testing::sphere(times).mapped(e.factor(), e.center()));
  }
  scanning::Setup setup;
  setup.points = mesh.points;
  setup.triangles = mesh.triangles;
  setup.agent = random.ellipsoid({0, 0, 0}, 0.4, 1.5);
  setup.planes = 6;
  return setup;
}

/// A unit ball, seen by a ball of radius 1/2 at a distance of 6.
Setup balls() {
  const testing::Mesh ball = testing::sphere(4).mapped(Eigen::Matrix3d::Identity(), {6, 0, 0});
  Setup setup;
  setup.points = ball.points;
  setup.triangles = ball.triangles;
  setup.agent = Ellipsoid::from_axes({0, 0, 0}, {0.5, 0.5, 0.5});
  setup.planes = 6;
  return setup;
}

lidar::Lidar lidar_at(const Vector3d& position, lidar::BeamPattern beams) {
  lidar::Lidar l;
  l.pose.translation() = position;
  l.beams = std::move(beams);
  return l;
}

TEST(ScanStudy, FromInsideTheAgentNothingOfTheConeIsMissed) {
  // docs/explanation/lidar.md: what the agent touches first on its way can be seen from everywhere in it.
  RandomBodies random(7801);
  SCOPED_TRACE(random.trace());
  double worst = 0, hidden = 0;
  for (int i = 0; i < 25; ++i) {
    scanning::Setup setup = heap(random, 3);
    const Vector3d inside =
        setup.agent.center() + setup.agent.factor() * (0.95 * random.uniform() * random.direction());
    setup.lidars = {lidar_at(inside, lidar::raster(120, 120, 1.6, 1.6))};
    setup.levels = 1;
    const Study s = study(setup);
    hidden = std::max(hidden, 1 - s.visible_area / s.whole_area);
    for (std::size_t j = 0; j < s.whole_cone.edges.size(); ++j) {
      if (std::isnan(s.whole_cone.edges[j])) continue;
      EXPECT_LE(s.visible_cone.edges[j], s.whole_cone.edges[j] + 2e-7);
      worst = std::max(worst, s.whole_cone.edges[j] - s.visible_cone.edges[j]);
    }
  }
  std::cout << "edges lost: at most " << worst << " rad; surface unseen: up to " << 100 * hidden << " %\n";
  EXPECT_LT(worst, 1e-5);  // what counts as seen has a resolution
  EXPECT_GT(hidden, 0.5);
}

TEST(ScanStudy, ConesGrowWithTheBeamsToThatOfTheSeenPart) {
  RandomBodies random(7802);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < 5; ++i) {
    scanning::Setup setup = heap(random, 4);
    setup.lidars = {lidar_at({0, 0, 0}, lidar::raster(20, 20, 1.6, 1.6))};
    setup.levels = 5;
    const Study s = study(setup);
    ASSERT_EQ(s.levels.size(), 5U);
    std::vector<double> mean(5, 0);
    for (std::size_t j = 0; j < s.visible_cone.edges.size(); ++j)
      for (std::size_t k = 0; k < 5; ++k) {
        const double edge = s.levels[k].cone.edges[j];
        mean[k] += (s.visible_cone.edges[j] - edge) / double(s.visible_cone.edges.size());
        EXPECT_LE(edge, s.whole_cone.edges[j] + 2e-7);
        if (k > 0) {
          EXPECT_GE(edge, s.levels[k - 1].cone.edges[j] - 2e-7);
        }
      }
    // 16 times as fine: the edges' error is of the order of the spacing.
    EXPECT_LT(mean[4], mean[0] / 6);
    EXPECT_EQ(s.levels[4].beams, 305U * 305U);
    EXPECT_EQ(s.levels[4].beams, s.levels[4].returned + s.levels[4].missed);
  }
}

TEST(ScanStudy, NarrowViewsMissAndSayHowMuch) {
  scanning::Setup setup = balls();
  setup.lidars = {lidar_at({0, 0, 0}, lidar::raster(12, 60, 1, 0.1))};
  setup.levels = 3;
  const Study s = study(setup);
  const double whole = 2 * pi * (1 - std::sqrt(1 - std::pow(1.5 / 6, 2)));
  EXPECT_NEAR(s.whole_cone.solid_angle, whole * 12 / (2 * pi) * std::sin(2 * pi / 12),
              0.01 * whole);  // a 12-gon
  EXPECT_LT(s.visible_cone.solid_angle, 0.8 * s.whole_cone.solid_angle);
  for (const Level& level : s.levels) EXPECT_LT(level.cone.solid_angle, s.visible_cone.solid_angle * 1.0001);
  EXPECT_GT(s.levels.back().cone.solid_angle, 0.97 * s.visible_cone.solid_angle);
}

TEST(ScanStudy, ScansFromPosesKnownUpToAnErrorAreFused) {
  testing::Mesh mesh = testing::cube().mapped(Vector3d(0.5, 0.8, 0.6).asDiagonal(), {6, 0, 0});
  mesh.append(testing::sphere(4).mapped(0.5 * Eigen::Matrix3d::Identity(), {5.3, 0.4, 0.5}));
  mesh.append(testing::sphere(4).mapped(0.4 * Eigen::Matrix3d::Identity(), {5.4, -0.6, -0.3}));
  scanning::Setup setup = balls();
  setup.points = mesh.points;
  setup.triangles = mesh.triangles;
  setup.lidars = {lidar_at({0, 0.3, 0}, lidar::raster(60, 60, 0.6, 0.6)),
                  lidar_at({0, -0.3, 0.1}, lidar::raster(60, 60, 0.6, 0.6))};
  setup.levels = 2;
  const Study exact = study(setup);
  setup.position_error = 0.03;
  setup.rotation_error = 0.005;
  const Study fused = study(setup);
  for (int k = 0; k < 2; ++k) {
    EXPECT_EQ(exact.levels[k].fusion_error, 0);
    EXPECT_EQ(fused.levels[k].not_fused, "");
    EXPECT_GT(fused.levels[k].fusion_error, 0);
    EXPECT_LT(fused.levels[k].fusion_error, 0.003);
    for (std::size_t j = 0; j < exact.levels[k].cone.edges.size(); ++j)
      EXPECT_NEAR(fused.levels[k].cone.edges[j], exact.levels[k].cone.edges[j], 2e-3);
  }
  // A ball does not tell how the lidars are turned: no answer.
  scanning::Setup ball = balls();
  ball.lidars = setup.lidars;
  ball.levels = 1;
  ball.position_error = 0.03;
  const Study none = study(ball);
  EXPECT_THAT(none.levels[0].not_fused, ::testing::HasSubstr("slide"));
  EXPECT_TRUE(std::isnan(none.levels[0].cone.solid_angle));
  const PlaneSectionPicture picture = plane_section_picture(ball, 0);
  EXPECT_THAT(picture.reason, ::testing::HasSubstr("slide"));
  EXPECT_TRUE(picture.tangents.empty() && !picture.obstacle.empty());
}

TEST(ScanStudy, RefusesWhatHasNoCone) {
  RandomBodies random(7804);
  scanning::Setup setup = heap(random, 2);
  EXPECT_THROW(study(setup), InputError);  // no lidars
  setup.lidars = {lidar_at({0, 0, 0}, lidar::raster(20, 20, 0.2, 0.2))};
  setup.lidars[0].pose.linear() = Eigen::AngleAxisd(pi, Vector3d::UnitZ()).toRotationMatrix();
  EXPECT_THROW(study(setup), InputError);  // looks away
  setup.lidars[0].pose.linear().setIdentity();
  setup.lidars[0].beams = lidar::raster(20, 20, 1.6, 1.6);
  setup.levels = 2;
  EXPECT_NO_THROW(study(setup));
  setup.agent = Ellipsoid::from_axes({6, 0, 0}, {3, 3, 3});
  EXPECT_THROW(study(setup), InputError);  // overlaps
}

TEST(ScanStudy, WritesJson) {
  scanning::Setup setup = balls();
  setup.lidars = {lidar_at({0, 0, 0.1}, lidar::raster(60, 60, 1.6, 1.6))};
  setup.levels = 2;
  std::stringstream text, picture_text;
  write_json(study(setup), text);
  const auto json = nlohmann::json::parse(text);
  EXPECT_EQ(json["levels"].size(), 2U);
  EXPECT_EQ(json["whole"]["cone"]["edges"].size(), 12U);
  const PlaneSectionPicture picture = plane_section_picture(setup, 0.3);
  EXPECT_EQ(picture.tangents.size(), 2U);
  EXPECT_GT(picture.returns.size(), 5U);
  EXPECT_GT(picture.whole_left, 0);
  write_json(picture, picture_text);
  EXPECT_EQ(nlohmann::json::parse(picture_text)["agent"].size(), picture.agent.size());
}

}  // namespace
}  // namespace vericone::scanning::scan_study_test
