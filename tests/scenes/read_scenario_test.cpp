// SPDX-License-Identifier: BSD-3-Clause
//
// Scenarios as a user of the library reads and flies them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/scenarios/scenario_files.h>
#include <vericone/simulation/run.h>

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

}  // namespace
}  // namespace vericone::read_scenario_test
