// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies that a word and its sizes give, and margins: against constructors, closed forms and each other.
#include <gtest/gtest.h>
#include <unistd.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/scenes/words.h>
#include <vericone/scenes/scene.h>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "support/random.h"

namespace vericone::word_bodies_test {
namespace {

using Eigen::Vector3d;
using scenes::Scene, scenes::SceneBody, scenes::scene_of_text;

/// A scene of the body with a ball of radius 1 about (9, 0, 0), both at rest.
Scene scene_with(const std::string& body,
                 const std::string& ball = "{center: [9, 0, 0], semi_axes: [1, 1, 1]}") {
  return scene_of_text("agent: " + ball + "\nobstacle: " + body, "none.yaml");
}

SceneBody body_of(const std::string& text) { return scene_with(text).obstacle; }

void expect_same(const Convex& a, const Convex& b) {
  EXPECT_EQ(a.pieces(), b.pieces());
  EXPECT_EQ(a.margin(), b.margin());
}

TEST(WordBodies, AreThoseOfTheirConstructors) {
  struct Case {
    const char* text;
    Convex body;
    const char* name;
  };
  const Case cases[] = {
      {"{cylinder: {radius: 0.3, height: 2}}", Convex::cylinder(0.3, 2), "cylinder"},
      {"{cylinder: {semi_axes: [0.3, 1], height: 2}}", Convex::elliptic_cylinder(0.3, 1, 2), "cylinder"},
      {"{capsule: {radius: 0.3, length: 2}}", Convex::capsule(0.3, 2), "capsule"},
      {"{cone: {radius: 0.3, height: 2}}", Convex::cone(0.3, 2), "cone"},
      {"{frustum: {radii: [0.3, 0.1], height: 2}}", Convex::frustum(0.3, 0.1, 2), "frustum"},
      {"{disc: {radius: 0.3}}", Convex::disc(0.3), "disc"},
      {"{disc: {semi_axes: [0.3, 0.2]}}", Convex::ellipse(0.3, 0.2), "disc"},
      {"{cylinder: {radius: 0.3, height: 2}, margin: 0.1}", Convex::cylinder(0.3, 2).swollen(0.1),
       "cylinder with a margin of 0.1 m"},
      {"{box: {half_widths: [1, 2, 3]}, margin: 0.5}", Convex::box({1, 2, 3}).swollen(0.5),
       "box with a margin of 0.5 m"},
      // Where a capsule is its segment with a margin.
      {"{points: [[0, 0, -1], [0, 0, 1]], margin: 0.3}", Convex::capsule(0.3, 2),
       "hull of 2 points with a margin of 0.3 m"}};
  for (const Case& one : cases) {
    SCOPED_TRACE(one.text);
    const SceneBody body = body_of(one.text);
    ASSERT_TRUE(body.placed.body.convex() != nullptr);
    expect_same(*body.placed.body.convex(), one.body);
    EXPECT_EQ(body.name, one.name);
    EXPECT_TRUE(body.placed.pose.position.isZero(0) && body.placed.pose.rotation.isIdentity(0));
  }
}

TEST(WordBodies, ThatAreHullsAreHulls) {
  for (const char* text :
       {"{box: {half_widths: [1, 2, 3]}, center: [7, 0, 0]}",
        "{points: [[-1, -2, -3], [1, -2, -3], [-1, 2, -3], [1, 2, -3], [-1, -2, 3], [1, -2, 3], "
        "[-1, 2, 3], [1, 2, 3]], center: [7, 0, 0]}"}) {
    const SceneBody body = body_of(text);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(body.placed.body.support(Vector3d::Unit(axis)), axis + 1) << text;
      EXPECT_EQ(body.placed.body.support(-Vector3d::Unit(axis)), axis + 1) << text;
    }
    EXPECT_EQ(body.placed.pose.position, Vector3d(7, 0, 0));
  }
  EXPECT_TRUE(body_of("{box: {half_widths: [1, 2, 3]}}").hull() != nullptr);
  EXPECT_EQ(body_of("{cylinder: {radius: 0, height: 2}}").hull()->points().size(), 2U);
}

TEST(WordBodies, MarginsAddAndAreThoseOfAllParts) {
  // Of a ball it adds to the radius, of a cloud to each ball's.
  const Body ball = body_of("{center: [0, 0, 0], semi_axes: [1, 1, 1], margin: 0.25}").placed.body;
  ASSERT_TRUE(ball.convex() != nullptr);
  EXPECT_EQ(ball.convex()->margin(), 1.25);
  const SceneBody parts = body_of(
      "{pieces: [{center: [0, 0, 0], semi_axes: [1, 1, 1]}, {points: [[5, 0, 0], [6, 0, 0]], margin: 0.5},"
      " {cylinder: {radius: 1, height: 2}, center: [9, 0, 0]}], margin: 0.125}");
  const Assembly* all = parts.placed.body.assembly();
  ASSERT_TRUE(all != nullptr);
  ASSERT_EQ(all->size(), 3U);
  EXPECT_EQ(all->convex_piece(0).margin(), 1.125);
  EXPECT_EQ(all->convex_piece(1).margin(), 0.625);
  expect_same(all->convex_piece(2), Convex::cylinder(1, 2).translated({9, 0, 0}).swollen(0.125));
  EXPECT_EQ(parts.placed.body.support(Vector3d::UnitX()), 10.125);
  EXPECT_EQ(parts.placed.body.support(-Vector3d::UnitX()), 1.125);
}

TEST(WordBodies, OfAFileHaveItsMarginAndThatBesideItsName) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("vericone_words_" + std::to_string(::getpid()));
  std::filesystem::create_directory(folder);
  std::ofstream(folder / "pin.yaml")
      << "{cylinder: {radius: 1, height: 4}, center: [1, 0, 0], margin: 0.25}\n";
  const Scene scene = scene_of_text(
      "agent: {center: [9, 0, 0], semi_axes: [1, 1, 1]}\n"
      "obstacle: {file: pin.yaml, center: [0, 2, 0], margin: 0.5}",
      folder / "none.yaml");
  std::filesystem::remove_all(folder);
  expect_same(*scene.obstacle.placed.body.convex(), Convex::cylinder(1, 4).swollen(0.75));
  EXPECT_EQ(scene.obstacle.placed.pose.position, Vector3d(1, 2, 0));
}

TEST(WordBodies, AreWrittenAsTheyWereAndByTheirSizes) {
  const auto file =
      std::filesystem::temp_directory_path() / ("vericone_words_" + std::to_string(::getpid()) + ".yaml");
  for (const Convex& body :
       {Convex::cylinder(0.3, 2), Convex::cylinder(0.1, 0.7).swollen(0.2), Convex::capsule(0.3, 0.9),
        Convex::cone(0.7, 0.1), Convex::frustum(0.1, 0.2, 0.3), Convex::disc(0.3), Convex::ellipse(1, 0.1),
        Convex::elliptic_cylinder(1, 2, 3), Convex::box({0.1, 0.2, 0.3}).swollen(0.4)}) {
    SCOPED_TRACE(body.word());
    SceneBody made{Placed(body, {Vector3d(1, 2, 3), Eigen::Matrix3d::Identity()})};
    scenes::write_body(made, file);
    const SceneBody read = scenes::read_body(file);
    ASSERT_TRUE(read.placed.body.convex() != nullptr);
    expect_same(*read.placed.body.convex(), body);
    EXPECT_EQ(read.placed.pose.position, made.placed.pose.position);
    EXPECT_EQ(scenes::body_words(read.placed).substr(0, body.word().size()), body.word());
    scenes::write_body(read, file);
    expect_same(*scenes::read_body(file).placed.body.convex(), body);
  }
  // Of pieces of its own no word tells.
  EXPECT_THROW(scenes::write_body({Placed(Convex::cylinder(1, 2).translated({0, 0, 1}))}, file), InputError);
  std::filesystem::remove(file);
}

TEST(WordBodies, StandAsFarFromABallAsTheClosedFormSays) {
  testing::Random random(91);
  SCOPED_TRACE(random.trace());
  for (int i = 0; i < testing::share(400); ++i) {
    const double r = random.uniform(0.2, 2), h = random.uniform(0.2, 4);
    const Vector3d x(random.uniform(-6, 6), random.uniform(-6, 6), random.uniform(-6, 6));
    const double rho = std::hypot(x.x(), x.y()), beyond = std::max(std::abs(x.z()) - h / 2, 0.0);
    char text[200];
    const auto distance = [&](const char* form) {
      std::snprintf(text, sizeof text, form, r, h);
      char ball[200];
      std::snprintf(ball, sizeof ball, "{center: [%.17g, %.17g, %.17g], semi_axes: [0.1, 0.1, 0.1]}", x.x(),
                    x.y(), x.z());
      const Pair pair = scene_with(text, ball).pair();
      return pair.miss(Vector3d::Zero(), Vector3d::Zero()).distance;
    };
    const double cylinder = std::hypot(std::max(rho - r, 0.0), beyond) - 0.1;
    const double capsule = std::hypot(rho, beyond) - r - 0.1;
    const double box = Vector3d(std::max(std::abs(x.x()) - r, 0.0), std::max(std::abs(x.y()) - r, 0.0),
                                std::max(std::abs(x.z()) - h, 0.0))
                           .norm() -
                       0.1;
    if (cylinder > 0.01) {
      EXPECT_NEAR(distance("{cylinder: {radius: %.17g, height: %.17g}}"), cylinder, 1e-6);
      EXPECT_NEAR(distance("{cylinder: {radius: %.17g, height: %.17g}, margin: 0.005}"), cylinder - 0.005,
                  1e-6);
    }
    if (capsule > 0.01) {
      EXPECT_NEAR(distance("{capsule: {radius: %.17g, length: %.17g}}"), capsule, 1e-6);
    }
    if (box > 0.01) {
      EXPECT_NEAR(distance("{box: {half_widths: [%1$.17g, %1$.17g, %2$.17g]}}"), box, 1e-6);
      EXPECT_NEAR(distance("{box: {half_widths: [%1$.17g, %1$.17g, %2$.17g]}, margin: 0.005}"), box - 0.005,
                  1e-6);
    }
  }
}

}  // namespace
}  // namespace vericone::word_bodies_test
