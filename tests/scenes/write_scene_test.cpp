// SPDX-License-Identifier: BSD-3-Clause
//
// Scenes that are written read as the same.
#include <gtest/gtest.h>
#include <vericone/files/files.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/random_engagement.h>
#include <vericone/scenes/scene.h>

#include <filesystem>
#include <string>
#include <vector>

namespace vericone::write_scene_test {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using scenes::Scene, scenes::SceneBody, scenes::read_scene, scenes::scene_of_text, scenes::write_scene;

class WriteScene : public ::testing::Test {
 protected:
  WriteScene() {
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "sub");
  }
  ~WriteScene() override { fs::remove_all(folder_); }

  Scene written(const Scene& scene, const std::string& name = "sub/scene.yaml") const {
    write_scene(scene, folder_ / name);
    return read_scene(folder_ / name);
  }
  std::string refused_field(const Scene& scene) const {
    try {
      write_scene(scene, folder_ / "sub" / "refused.yaml");
    } catch (const InputError& e) {
      return e.field();
    }
    return "";
  }

  const fs::path folder_ =
      fs::path(::testing::TempDir()) /
      (std::string("vericone_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

void expect_same(const CombinedEllipsoid& a, const CombinedEllipsoid& b) {
  EXPECT_EQ(a.center(), b.center());
  EXPECT_EQ(a.ellipsoid().factor(), b.ellipsoid().factor());
  EXPECT_EQ(a.ellipsoid().shape(), b.ellipsoid().shape());
  EXPECT_EQ(a.ellipsoid().defined_by_factor(), b.ellipsoid().defined_by_factor());
  ASSERT_EQ(a.delimiters().size(), b.delimiters().size());
  for (std::size_t i = 0; i < a.delimiters().size(); ++i) {
    EXPECT_EQ(a.delimiters()[i].matrix, b.delimiters()[i].matrix);
    EXPECT_EQ(a.delimiters()[i].level, b.delimiters()[i].level);
  }
}

Scene random_scene(engagements::Random& random) {
  const auto ellipsoid = [&] {
    return Ellipsoid::from_axes(random.uniform(0, 9) * random.direction(),
                                {random.uniform(0.1, 9), random.uniform(0.1, 9), random.uniform(0.1, 9)},
                                random.rotation());
  };
  Scene scene;
  scene.agent.placed = Placed(Body(ellipsoid()));
  const Ellipsoid other = ellipsoid();
  scene.obstacle.placed = Placed(Body(Ellipsoid::from_shape(other.center(), other.shape())));
  scene.agent.velocity = random.direction();
  scene.obstacle.velocity = 1e-7 * random.direction();
  return scene;
}

TEST_F(WriteScene, EllipsoidsOfProgramsReadBackBitForBit) {
  for (std::uint64_t i = 0; i < 200; ++i) {
    engagements::Random random(1, i);
    const Scene scene = random_scene(random), read = written(scene);
    expect_same(*read.agent.quadric(), *scene.agent.quadric());
    expect_same(*read.obstacle.quadric(), *scene.obstacle.quadric());
    EXPECT_EQ(read.agent.velocity, scene.agent.velocity);
    EXPECT_EQ(read.obstacle.velocity, scene.obstacle.velocity);
  }
}

TEST_F(WriteScene, BodiesOfFilesReadBackBitForBit) {
  const char* bodies[] = {
      "{center: [5, 0.1, 0], semi_axes: [1, 1.3, 1], rotation: [0.5, 0.5, 0.5, 0.5], hyperboloids: [{sheets: "
      "2, "
      "semi_axes: [0.5, 0.4, 0.4], rotation: [[0, -1, 0], [1, 0, 0], [0, 0, 1]]}]}",
      "{points: [[4, 0, 0], [5, 1, 1], [5, -1, 1], [5, 0, -1]], center: [0.1, 0, 0], scale: 0.3}",
      "{pieces: [{center: [5, 0, 0], semi_axes: [1, 1, 1]}, {center: [6, 0, 0], semi_axes: [1, 1, 1], "
      "hyperboloids: "
      "[{sheets: 2, semi_axes: [0.5, 0.4, 0.4]}]}], rotation: [[0, -1, 0], [1, 0, 0], [0, 0, 1]]}",
      "{mesh: m.ply, center: [1, 2, 3]}",
      "{cloud: m.ply, radius: 0.1}",
      "{hull: m.ply, scale: 0.1}",
      "{file: body.yaml, center: [0.1, 0.2, 0.3]}"};
  files::write_points(folder_ / "m.ply", std::vector<Vector3d>{{4, 0, 0}, {4, 1, 0}, {4, 0, 1}, {5, 5, 5}},
                      std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {1, 2, 3}});
  scenes::write_body(
      scene_of_text("agent: {center: [0, 0, 0], semi_axes: [1, 1, 1]}\nobstacle: {mesh: m.ply}",
                    folder_ / "a.yaml")
          .obstacle,
      folder_ / "body.yaml");
  for (const char* body : bodies) {
    SCOPED_TRACE(body);
    const Scene scene = scene_of_text(
        std::string("agent: {center: [0, 0, 0], semi_axes: [1, 1, 1], velocity: [0.1, 0, 0]}\nobstacle: ") +
            body,
        folder_ / "scene.yaml");
    const Scene read = written(scene);
    EXPECT_EQ(read.agent.velocity, scene.agent.velocity);
    EXPECT_EQ(read.obstacle.name, scene.obstacle.name);
    EXPECT_EQ(read.obstacle.placed.pose.position, scene.obstacle.placed.pose.position);
    EXPECT_EQ(read.obstacle.placed.pose.rotation, scene.obstacle.placed.pose.rotation);
    const Body &a = read.obstacle.placed.body, &b = scene.obstacle.placed.body;
    ASSERT_EQ(a.kind(), b.kind());
    if (a.quadric()) expect_same(*a.quadric(), *b.quadric());
    if (a.quadrics()) {
      for (std::size_t i = 0; i < a.quadrics()->size(); ++i)
        expect_same((*a.quadrics())[i], (*b.quadrics())[i]);
    }
    if (a.hull()) {
      EXPECT_EQ(a.hull()->points(), b.hull()->points());
    }
    if (a.assembly()) {
      EXPECT_EQ(a.assembly()->by_slot().triangles, b.assembly()->by_slot().triangles);
      EXPECT_EQ(a.assembly()->by_slot().balls, b.assembly()->by_slot().balls);
      EXPECT_EQ(a.assembly()->radius(), b.assembly()->radius());
    }
  }
}

TEST_F(WriteScene, PlanarScenesReadBackBitForBit) {
  const Scene scene = scene_of_text(
      "agent: {center: [0, 0], semi_axes: [1, 2], rotation: 0.3}\n"
      "obstacle: {center: [5, 1], a_c: 1, b_c: 2, k: 0.3, phi: 0.2, velocity: [-1, 0.1]}",
      folder_ / "scene.yaml");
  const Scene read = written(scene);
  ASSERT_TRUE(read.planar);
  EXPECT_EQ(read.planar->agent.ellipsoid().factor(), scene.planar->agent.ellipsoid().factor());
  EXPECT_EQ(read.planar->obstacle.delimiters()[0].matrix, scene.planar->obstacle.delimiters()[0].matrix);
  EXPECT_EQ(read.obstacle.velocity, scene.obstacle.velocity);
}

TEST_F(WriteScene, MeshesAndCloudsOfProgramsStandBesideIt) {
  engagements::Random random(2, 0);
  std::vector<Vector3d> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t i = 0; i < 50; ++i) {
    points.push_back(9 * random.direction());
    triangles.push_back({i, (i * 7 + 1) % 50, (i * 3 + 2) % 50});
  }
  Scene scene = random_scene(random);
  scene.agent.placed = Placed(Body(Assembly::cloud(points, 0.1)), {random.direction(), random.rotation()});
  scene.obstacle.placed =
      Placed(Body(Assembly::mesh(points, triangles)), {{1, 2, 3}, Eigen::Matrix3d::Identity()});
  const Scene read = written(scene, "sub/pair.yaml");
  EXPECT_TRUE(fs::exists(folder_ / "sub" / "pair-agent.ply"));
  EXPECT_TRUE(fs::exists(folder_ / "sub" / "pair-obstacle.ply"));
  EXPECT_EQ(read.agent.placed.body.assembly()->by_slot().balls,
            scene.agent.placed.body.assembly()->by_slot().balls);
  EXPECT_EQ(read.agent.placed.pose.rotation, scene.agent.placed.pose.rotation);
  EXPECT_EQ(read.obstacle.placed.body.assembly()->by_slot().triangles,
            scene.obstacle.placed.body.assembly()->by_slot().triangles);
  EXPECT_EQ(read.obstacle.placed.pose.position, scene.obstacle.placed.pose.position);
}

TEST_F(WriteScene, WritesWhatABodyIsNotWhatItWas) {
  Scene scene = scene_of_text(
      "agent: {center: [0, 0, 0], semi_axes: [1, 1, 1]}\nobstacle: {center: [5, 0, 0], semi_axes: [1, 1, 1]}",
      folder_ / "scene.yaml");
  scene.obstacle.placed = Placed(Body(Ellipsoid::from_axes({7, 0, 0}, {2, 1, 1})));
  EXPECT_EQ(written(scene).obstacle.ellipsoid()->center(), Vector3d(7, 0, 0));
}

TEST_F(WriteScene, RefusesWhatNoFieldsGive) {
  engagements::Random random(3, 0);
  Scene scene = random_scene(random);
  scene.obstacle.placed = Placed(Body(Assembly::boxes({Box{{0, 0, 0}, {1, 1, 1}}})));
  EXPECT_EQ(refused_field(scene), "obstacle");
  scene = random_scene(random);
  scene.agent.placed =
      Placed(Body(CombinedEllipsoid(Ellipsoid(), {hyperboloid(2, {0.5, 0.4, 0.4}, random.rotation())})));
  EXPECT_EQ(refused_field(scene), "agent");
  EXPECT_FALSE(fs::exists(folder_ / "sub" / "refused.yaml"));
  scene = random_scene(random);
  EXPECT_THROW(write_scene(scene, folder_ / "missing" / "a.yaml"), std::runtime_error);
  EXPECT_THROW(write_scene(scene, folder_), InputError);
}

}  // namespace
}  // namespace vericone::write_scene_test
