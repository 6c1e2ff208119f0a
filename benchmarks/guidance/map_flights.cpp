// SPDX-License-Identifier: BSD-3-Clause
//
// Prints, in Markdown, what becomes of flights along the corridor of geb079.bt (143,729 boxes, of Debian's
// liboctomap-dev) past a hanging mesh and two birds, and how long their decisions take.
//
// Usage: vericone_map_flights MAP MESH [FLIGHTS [SEED]]
#include <vericone/files/files.h>
#include <vericone/geometry/assembly.h>
#include <vericone/octomap/read_octree.h>
#include <vericone/simulation/run.h>
#include <vericone/testing/random_bodies.h>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

namespace {

using namespace vericone;
using Eigen::Vector3d;
using simulation::Event, simulation::EventKind, simulation::PairOutcome, simulation::ProofVerdict,
    simulation::Scenario;
using vericone::testing::RandomBodies;

simulation::Body still(const std::string& name, const Placed& placed) {
  simulation::Body body;
  body.name = name;
  body.shape = simulation::RigidShape{placed};
  body.orientation = simulation::Orientation::fixed;
  return body;
}

simulation::Body ellipsoid(const std::string& name, const Vector3d& axes, const Vector3d& at,
                           const Vector3d& velocity) {
  simulation::Body body;
  body.name = name;
  body.shape = simulation::RigidShape{CombinedEllipsoid(Ellipsoid::from_axes(Vector3d::Zero(), axes))};
  body.start.position = at;
  body.start.velocity = velocity;
  body.orientation = simulation::Orientation::fixed;
  return body;
}

/// The largest extent 0.8 m, about the origin.
Body obstacle(const files::PointFile& file) {
  Vector3d low = file.points.front(), high = low;
  for (const Vector3d& p : file.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  std::vector<Vector3d> points;
  for (const Vector3d& p : file.points)
    points.emplace_back((p - 0.5 * (low + high)) * 0.8 / (high - low).maxCoeff());
  std::vector<Assembly::Triangle> triangles;
  for (const files::Face& face : file.faces) triangles.push_back({face.at(0), face.at(1), face.at(2)});
  return Body(Assembly::mesh(points, triangles));
}

struct World {
  Body map, mesh;

  /// Somewhere in the corridor with so much room about it.
  Vector3d free(RandomBodies& random, double room) const {
    for (;;) {
      const Vector3d at(random.uniform(0, 22), random.uniform(-0.8, 0.6), random.uniform(0.7, 1.5));
      const Placed ball(Ellipsoid::from_axes(at, Vector3d::Constant(room)));
      if (Pair(ball, Placed(map)).relation() == Relation::disjoint) return at;
    }
  }

  Scenario flight(std::uint64_t seed) const {
    RandomBodies random(seed);
    Scenario scenario;
    scenario.step = 0.05;
    scenario.duration = 60;
    scenario.seed = seed;
    const Vector3d start = free(random, 0.5);
    Vector3d goal = free(random, 0.5);
    while ((goal - start).norm() < 5) goal = free(random, 0.5);
    simulation::Body drone = ellipsoid("drone", {0.2, 0.2, 0.08}, start, Vector3d::Zero());
    simulation::Pilot& pilot = drone.pilot.emplace();
    pilot.guide.law = guidance::Law::clearance;
    pilot.guide.clearance.required = 0.15;
    pilot.guide.clearance.beyond = 0.05;
    pilot.guide.clearance.most = 4;
    pilot.guide.clearance.longitudinal = true;
    pilot.fastest = 3;
    pilot.goals = {simulation::Goal{.point = goal, .most = 4, .reached = 0.5}};
    simulation::Sensor& sensor = pilot.sensor.emplace();
    sensor.noise = simulation::Noise::bounded;
    sensor.position = 0.05;
    sensor.range = 30;
    scenario.bodies = {drone, still("map", Placed(map))};
    // Between the two places, off the middle: on the side there is room to pass.
    const double x = start.x() + random.uniform(0.3, 0.7) * (goal.x() - start.x());
    scenario.bodies.push_back(still(
        "mesh", {mesh, {{x, random.coin() ? 0.6 : -0.8, random.uniform(0.4, 1.8)}, random.rotation()}}));
    for (const char* name : {"bird", "other bird"}) {
      Vector3d at = free(random, 0.2);
      while ((at - start).norm() < 3) at = free(random, 0.2);
      const Vector3d along((at.x() < start.x() ? 1 : -1) * random.uniform(0.5, 2),
                           random.uniform(-0.02, 0.02), 0);
      scenario.bodies.push_back(ellipsoid(name, {0.15, 0.1, 0.08}, at, along));
    }
    return scenario;
  }
};

int main_of(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: vericone_map_flights MAP MESH [FLIGHTS [SEED]]\n");
    return 2;
  }
  const int count = argc > 3 ? std::atoi(argv[3]) : 100;
  const std::uint64_t first = argc > 4 ? std::strtoull(argv[4], nullptr, 10) : 1;
  octomap::OctreeMeaning known;
  known.unknown_occupied = false;
  const std::vector<Box> boxes = octomap::obstacle_boxes(octomap::read_octree(argv[1]), known);
  const files::PointFile mesh = files::read_points(argv[2]);
  const World world{Body(Assembly::boxes(boxes)), obstacle(mesh)};
  std::printf("%zu boxes, a mesh of %zu triangles\n\n", boxes.size(), mesh.faces.size());
  std::printf(
      "| flights | touched | undecided | said that it cannot avoid | arrived | nearest, m | decisions | "
      "mean, ms | the flights' 99 %%, median and worst | worst, ms "
      "|\n|---|---|---|---|---|---|---|---|---|---|\n");
  int touched = 0, undecided = 0, said = 0, arrived = 0;
  double nearest = std::numeric_limits<double>::infinity(), sum = 0, worst = 0;
  std::uint64_t decisions = 0;
  std::vector<double> within;
  for (std::uint64_t seed = first; seed < first + std::uint64_t(count); ++seed) {
    simulation::RunOptions options;
    options.log = false;
    const simulation::Run run = simulate(world.flight(seed), options);
    for (const PairOutcome& pair : run.proofs) {
      if (pair.a != 0) continue;  // birds fly through walls
      touched += pair.proof.verdict == ProofVerdict::touched;
      undecided += pair.proof.verdict == ProofVerdict::undecided;
      nearest = std::min(nearest, pair.proof.least_distance);
    }
    const auto had = [&](EventKind kind) {
      return std::any_of(run.events.begin(), run.events.end(),
                         [&](const Event& e) { return e.kind == kind; });
    };
    said += had(EventKind::cannot_avoid);
    arrived += had(EventKind::reaches_goal);
    if (!had(EventKind::reaches_goal))
      std::fprintf(stderr, "seed %llu did not arrive\n", (unsigned long long)seed);
    decisions += run.times.decisions;
    sum += run.times.mean * double(run.times.decisions);
    worst = std::max(worst, run.times.worst);
    within.push_back(run.times.within);
  }
  std::sort(within.begin(), within.end());
  std::printf("| %d | %d | %d | %d | %d | %.3f | %llu | %.3f | %.2f, %.2f | %.2f |\n", count, touched,
              undecided, said, arrived, nearest, (unsigned long long)decisions, 1e3 * sum / double(decisions),
              1e3 * within[within.size() / 2], 1e3 * within.back(), 1e3 * worst);
  return 0;
}

}  // namespace

int main(int argc, char** argv) try { return main_of(argc, argv); } catch (const std::exception& e) {
  std::fprintf(stderr, "vericone_map_flights: %s\n", e.what());
  return 1;
}
