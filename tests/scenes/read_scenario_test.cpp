// SPDX-License-Identifier: BSD-3-Clause
//
// Scenarios as a user of the library reads and flies them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/scenarios/scenario_files.h>
#include <vericone/simulation/run.h>
#include <cmath>

namespace vericone::read_scenario_test {
namespace {

TEST(ReadScenario, AnExampleFliesAndIsProved) {
  const auto scenario = scenario::read_scenario(std::string(VERICONE_EXAMPLES) + "/scenarios/clearance.yaml");
  EXPECT_EQ(scenario.name, "two obstacles, clearance");
  const simulation::Run run = simulation::simulate(scenario);
  EXPECT_EQ(run.verdict(), simulation::ProofVerdict::avoided);
}

TEST(ReadScenario, MistakesNameTheirField) {
  const std::string text =
      "bodies: [{name: A, shape: {semi_axes: [1, 1, 1]}, position: [0, 0, 0], velocity: [0, 0]}]";
  try {
    (void)scenario::scenario_of_text(text, "mine.yaml");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(e.field(), "bodies[0].velocity");
  }
}

TEST(ReadScenario, UnitsAndPlacesOnTheEarthAreThoseOfNumbers) {
  const auto read = [](const std::string& body, const std::string& top) {
    return scenario::scenario_of_text(
        top + "bodies: [{name: A, shape: {semi_axes: [1, 1, 1]}, " + body + "}]", "mine.yaml");
  };
  const simulation::Scenario units = read(
      "position: [1 km, 0, 100 ft], speed: 250 kn, heading: [30 deg, -5 deg], appears: 0.5 min, "
      "pilot: {law: clearance, most: 0.5 g, others_most: 1 ft/s^2, goal: {point: [5 nmi, 0, 0], most: 1 "
      "m/s^2}}",
      "duration: 20 min\nstep: 100 ms\n");
  const simulation::Scenario numbers = read(
      "position: [1000, 0, 30.48], speed: 128.61111111111111, heading_deg: [30, -5], appears: 30, "
      "pilot: {law: clearance, most: 4.903325, others_most: 0.3048, goal: {point: [9260, 0, 0], most: 1}}",
      "duration: 1200\nstep: 0.1\n");
  EXPECT_EQ(units.duration, numbers.duration);
  EXPECT_EQ(units.step, numbers.step);
  const simulation::Body &a = units.bodies[0], &b = numbers.bodies[0];
  EXPECT_EQ(a.start.position, b.start.position);
  EXPECT_EQ(a.start.velocity, b.start.velocity);
  EXPECT_EQ(a.start.rotation, b.start.rotation);
  EXPECT_EQ(a.appears, b.appears);
  EXPECT_EQ(a.pilot->others_most, b.pilot->others_most);
  EXPECT_EQ(simulation::most_commanded(*a.pilot), simulation::most_commanded(*b.pilot));
  EXPECT_EQ(a.pilot->goals[0].point, b.pilot->goals[0].point);
  // East of the origin by a hundredth of a degree, and a goal above it.
  const simulation::Scenario earth = read(
      "position: {latitude: 0, longitude: 7.01, altitude: 0}, velocity: [1, 0, 0], pilot: {law: clearance, "
      "goal: {point: {latitude: 0, longitude: 7, altitude: 500 ft}, most: 1}}",
      "origin: {latitude: 0, longitude: 7}\n");
  const double angle = 0.01 * M_PI / 180, radius = 6378137;
  EXPECT_NEAR(earth.bodies[0].start.position.x(), radius * std::sin(angle), 1e-7);
  EXPECT_NEAR(earth.bodies[0].start.position.z(), radius * (std::cos(angle) - 1), 1e-7);
  EXPECT_LE((earth.bodies[0].pilot->goals[0].point - Eigen::Vector3d(0, 0, 152.4)).norm(), 5e-9);
}

/// The ground is a box of its extent: any that holds all that happens gives the same run.
TEST(ReadScenario, GroundIsThePartWithinItsExtent) {
  const auto read = [](const std::string& extent, const std::string& pilot) {
    return scenario::scenario_of_text(
        "duration: 8\nstep: 0.05\nbodies: [{name: Ground, half_space: {normal: [0, 0, 2], offset: 1" +
            extent +
            "}}, {name: A, shape: {cylinder: {radius: 1, height: 2}}, position: [0, 3, 10], velocity: [6, 0, "
            "-2], orientation: fixed, rotation: [1, 0, 0, 0]" +
            pilot +
            "}, {name: B, shape: {semi_axes: [1, 1, 1]}, position: [30, 3, 9], velocity: [-3, 0, 0]}]",
        "mine.yaml");
  };
  const auto scenario = read(", extent: 80", "");
  const Box bounds = scenario.bodies[0].shape.rigid()->placed()->body.bounds();
  EXPECT_NEAR(bounds.high.x(), 80, 1e-9);
  EXPECT_EQ(bounds.high.z(), 0.5);
  // Unguided it comes down on it: at 10 - 2 t - 1 = 0.5.
  const simulation::Run fallen = simulation::simulate(scenario),
                        same = simulation::simulate(read(", extent: 5000", ""));
  ASSERT_EQ(fallen.proofs.size(), same.proofs.size());
  int touched = 0;
  for (std::size_t i = 0; i < fallen.proofs.size(); ++i) {
    EXPECT_EQ(fallen.proofs[i].proof.verdict, same.proofs[i].proof.verdict);
    if (fallen.proofs[i].a != 0 || fallen.proofs[i].b != 1) continue;
    ++touched;
    EXPECT_EQ(fallen.proofs[i].proof.verdict, simulation::ProofVerdict::touched);
    EXPECT_NEAR(fallen.proofs[i].proof.to, 4.25, 1e-4);
  }
  EXPECT_EQ(touched, 1);
  // A guarded pilot keeps off both.
  const std::string guarded = ", pilot: {law: clearance, most: 4, clearance: {required: 0.5}}";
  EXPECT_EQ(simulation::simulate(read(", extent: 80", guarded)).verdict(), simulation::ProofVerdict::avoided);
  try {
    static_cast<void>(read("", ""));
    ADD_FAILURE() << "ground without end";
  } catch (const InputError& e) {
    EXPECT_THAT(std::string(e.what()), ::testing::HasSubstr("half_space.extent"));
  }
}

}  // namespace
}  // namespace vericone::read_scenario_test
