// SPDX-License-Identifier: BSD-3-Clause
//
// Scenes as a user of the library reads them. What their fields may be is tested by the command (tests/cli).
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/scenes/words.h>
#include <vericone/scenes/scene.h>
#include <thread>

namespace vericone::read_scene_test {
namespace {

using scenes::Scene, scenes::SceneBody, scenes::scene_of_text;
using ::testing::HasSubstr;

const std::filesystem::path kFolder = VERICONE_EXAMPLES;

/// `obstacle` before a unit ball at the origin that flies along x with 1 m/s.
Scene before_ball(const std::string& obstacle) {
  return scene_of_text(
      "agent: {center: [0, 0, 0], semi_axes: [1, 1, 1], velocity: [1, 0, 0]}\nobstacle: " + obstacle,
      kFolder / "none.yaml");
}

Verdict verdict(const Scene& scene) {
  return scene.pair().verdict(scene.agent.velocity, scene.obstacle.velocity);
}

double contact_time(const Scene& scene) {
  return scene.pair().contact(scene.agent.velocity, scene.obstacle.velocity).value().time;
}

TEST(ReadScene, EveryKindOfBodyIsThereAndMeetsTheBallWhenItShould) {
  struct Case {
    const char *obstacle, *name;
    double time;  // of the first contact
  };
  // The front of each is the plane or the point x = 4, which the ball reaches after 3 s.
  const Case cases[] = {
      {"{center: [5, 0, 0], semi_axes: [1, 1, 1]}", "ellipsoid", 3},
      // Its dent along the y axis leaves the point (4, 0, 0) there.
      {"{center: [5, 0, 0], semi_axes: [1, 1, 1], hyperboloids: [{sheets: 2, semi_axes: [0.5, 0.4, 0.4],"
       " rotation: [[0, -1, 0], [1, 0, 0], [0, 0, 1]]}]}",
       "combined quadric", 3},
      {"{points: [[4, 0, 0], [5, 1, 1], [5, -1, 1], [5, 0, -1]]}", "hull of 4 points", 3},
      {"{pieces: [{center: [5, 0, 0], semi_axes: [1, 1, 1]}, {center: [6, 0, 0], semi_axes: [1, 1, 1]}]}",
       "union of 2 pieces", 3}};
  for (const Case& one : cases) {
    SCOPED_TRACE(one.name);
    const Scene scene = before_ball(one.obstacle);
    EXPECT_EQ(scene.obstacle.name, one.name);
    EXPECT_EQ(verdict(scene), Verdict::in);
    EXPECT_NEAR(contact_time(scene), one.time, 1e-6);
    EXPECT_FALSE(scene.planar.has_value());
  }
}

TEST(ReadScene, MeshesAreFoundBesideTheSceneAndSayWhatTheyAre) {
  const Scene scene = before_ball("{mesh: window.obj}");  // a wall at x = 4 with a window of 2 m
  const SceneBody& wall = scene.obstacle;
  EXPECT_EQ(wall.name, "mesh of 8 triangles (window.obj)");
  EXPECT_EQ(wall.field, "mesh");
  EXPECT_EQ(wall.file, "window.obj");
  ASSERT_TRUE(wall.pieces() != nullptr);
  EXPECT_EQ(wall.pieces()->size(), 8u);
  ASSERT_TRUE(wall.reading.has_value());
  EXPECT_THAT(wall.reading->format, HasSubstr("OBJ"));
  EXPECT_EQ(wall.quadric(), nullptr);
  EXPECT_TRUE(scene.agent.ellipsoid() != nullptr);
}

TEST(ReadScene, PlanarScenesHaveTheirBodiesAsGivenAndRaised) {
  const Scene scene = scene_of_text(
      "agent: {center: [0, 0], semi_axes: [2, 1]}\nobstacle: {center: [6, 0.5], semi_axes: [1, 1], velocity: "
      "[-1, 0]}",
      "flat.yaml");
  ASSERT_TRUE(scene.planar.has_value());
  EXPECT_EQ(scene.planar->agent.ellipsoid().semi_axes(), Eigen::Vector2d(2, 1));
  EXPECT_EQ(scene.relative_velocity(), Eigen::Vector3d(1, 0, 0));
  const Pair raised(scene.agent.placed, scene.obstacle.placed);
  EXPECT_EQ(raised.verdict(scene.agent.velocity, scene.obstacle.velocity), verdict(scene));
  // x^2/4 + y^2 = 1 moves along x until it touches the circle about (6, 1/2): a contact between both axes.
  const double t = contact_time(scene);
  EXPECT_GT(t, 3.0);
  EXPECT_LT(t, 3.2);
}

TEST(ReadScene, MistakesNameTheirFieldAndFile) {
  const auto message = [](const std::string& obstacle) -> std::string {
    try {
      (void)before_ball(obstacle);
    } catch (const InputError& e) {
      return e.what();
    }
    return "nothing";
  };
  EXPECT_THAT(message("{center: [5, 0, 0], semi_axes: [1, -1, 1]}"), HasSubstr("obstacle.semi_axes[1]"));
  EXPECT_THAT(message("{mesh: nowhere.obj}"), HasSubstr("obstacle.mesh: got nowhere.obj"));
  EXPECT_THAT(message("{centre: [5, 0, 0], semi_axes: [1, 1, 1]}"), HasSubstr("obstacle.centre"));
  EXPECT_THROW((void)scenes::read_scene(kFolder / "nowhere.yaml"), InputError);
}

TEST(ReadScene, BodiesOfTheirOwnAreReadWithoutAScene) {
  for (const auto& entry : std::filesystem::directory_iterator(kFolder / "bodies")) {
    SCOPED_TRACE(entry.path().string());
    const SceneBody body = scenes::read_body(entry.path());
    EXPECT_FALSE(body.name.empty());
    EXPECT_THAT(scenes::body_words(body.placed), HasSubstr(" m"));
    EXPECT_GT(body.placed.support(Eigen::Vector3d::UnitX()), body.placed.middle().x());
  }
}

TEST(ReadScene, SeveralThreadsReadTheSameMesh) {
  std::vector<std::size_t> sizes(4);
  {
    std::vector<std::jthread> threads;
    for (std::size_t& size : sizes)
      threads.emplace_back([&size] {
        for (int i = 0; i < 20; ++i) size = before_ball("{mesh: window.obj}").obstacle.pieces()->size();
      });
  }
  EXPECT_THAT(sizes, ::testing::Each(8u));
}

}  // namespace
}  // namespace vericone::read_scene_test
