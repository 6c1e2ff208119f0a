// SPDX-License-Identifier: BSD-3-Clause
//
// Runs through orifices: the order, what counts as behind, where the source's law passes, and what is proved.
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/simulation/run.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace vericone::simulation::through_test {
namespace {

using Eigen::Vector3d;

MovingOrifice ring(const std::string& name, const Vector3d& position, const Vector3d& normal, double radius) {
  MovingOrifice orifice;
  orifice.name = name;
  orifice.opening = Opening::circle(radius);
  orifice.position = position;
  orifice.rotation = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), normal).toRotationMatrix();
  orifice.wall = false;
  return orifice;
}

Scenario flight(const Vector3d& velocity, Through::Law law) {
  Scenario scenario;
  scenario.duration = 40;
  scenario.step = 0.05;
  scenario.stop_when_passed = true;
  Body body;
  body.name = "A";
  body.shape = RigidShape{CombinedEllipsoid(
      Ellipsoid::from_axes(Vector3d::Zero(), {0.3, 0.2, 0.2}, Eigen::Matrix3d::Identity()))};
  body.start.velocity = velocity;
  body.start.rotation = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitX(), velocity).toRotationMatrix();
  body.pilot.emplace();
  body.pilot->through.emplace();
  body.pilot->through->law = law;
  body.pilot->through->passage.most = 1;
  body.pilot->through->source.most = 1;
  scenario.bodies.push_back(body);
  return scenario;
}

std::vector<Event> events_of(const Run& run, EventKind kind) {
  std::vector<Event> found;
  std::copy_if(run.events.begin(), run.events.end(), std::back_inserter(found),
               [&](const Event& event) { return event.kind == kind; });
  return found;
}

TEST(Through, OneAfterTheOtherInTheOrderGiven) {
  Scenario scenario = flight({1, 0, 0.2}, Through::Law::passage);
  scenario.orifices = {ring("back", {3, 2, 1}, {1, 0, 0}, 0.8), ring("front", {8, -1, 0}, {1, 0.3, 0}, 0.8)};
  scenario.bodies[0].pilot->through->orifices = {"front", "back"};  // the farther one first: it turns round
  const simulation::Run run = simulate(scenario);
  const auto through = events_of(run, EventKind::goes_through);
  ASSERT_EQ(through.size(), 2u);
  EXPECT_EQ(through[0].obstacle, 1u);
  EXPECT_EQ(through[1].obstacle, 0u);
  EXPECT_LT(run.end, 40);
  ASSERT_EQ(run.passages.size(), 2u);
  for (const PassageOutcome& passage : run.passages) {
    EXPECT_TRUE(passage.ordered);
    EXPECT_EQ(passage.proof.verdict, PassageVerdict::passed);
    EXPECT_GT(passage.proof.least_distance, 0.05);
  }
  EXPECT_NEAR(run.passages[1].proof.time, through[0].t, 1e-6);
  EXPECT_EQ(run.passages[0].proof.direction, -1);
  // It heads for the second one only when all of it has left the plane of the first.
  const auto next = std::find_if(run.orifices.begin(), run.orifices.end(),
                                 [](const OrificeSample& sample) { return sample.orifice == 0; });
  ASSERT_NE(next, run.orifices.end());
  const Motion then = run.tracks[0].motion(next->t);
  const double beyond =
      scenario.orifices[1].rotation.col(2).dot(then.position - scenario.orifices[1].position);
  EXPECT_GT(beyond, 0.2);
  EXPECT_LT(beyond, 0.45);
}

/// y goes to w, so the centres pass sqrt(w + (R_B - R_A)^2) apart, also off an opening that drifts.
TEST(Through, TheSourcesLawPassesOffTheCentreOnPurpose) {
  for (const double w : {-0.1, -0.5, -1.2}) {
    Scenario scenario = flight({1, 0.4, 0.2}, Through::Law::orifice);
    scenario.orifices = {ring("O", {12, 0, 0}, {1, 0, 0}, 1.5)};
    scenario.orifices[0].velocity = {-0.1, 0.05, 0.1};
    Through& through = *scenario.bodies[0].pilot->through;
    through.orifices = {"O"};
    through.source.reference = w;
    through.source.gain = 1;
    const simulation::Run run = simulate(scenario);
    ASSERT_EQ(run.passages.size(), 1u);
    EXPECT_EQ(run.passages[0].proof.verdict, PassageVerdict::passed);
    const OrificeSample& late = *std::find_if(
        run.orifices.rbegin(), run.orifices.rend(),
        [](const auto& sample) { return sample.command.status == guidance::OrificeStatus::steering; });
    // What is left of the start, exp(-K t), and of commands that are held for a step.
    EXPECT_NEAR(late.command.y, w, 3e-3);
    EXPECT_LE(events_of(run, EventKind::goes_through).at(0).value, 1.5);
  }
}

/// What the source's law does not see: a tilted opening, through which it flies into the wall.
TEST(Through, ATiltedOpeningIsTouchedByTheSourcesLawAndPassedByOurs) {
  for (const Through::Law law : {Through::Law::orifice, Through::Law::passage}) {
    Scenario scenario = flight({1, 0.1, 0}, law);
    scenario.orifices = {ring("O", {10, 0, 0}, {0.45, 1, 0}, 0.9)};
    scenario.orifices[0].wall = true;
    scenario.stop_when_passed = false;
    scenario.duration = 13;
    Through& through = *scenario.bodies[0].pilot->through;
    through.orifices = {"O"};
    through.source.reference = -0.05;
    through.source.gain = 1;
    through.passage.margin = 0.05;
    through.passage.beyond = 0.02;
    const simulation::Run run = simulate(scenario);
    EXPECT_EQ(run.passages.at(0).proof.verdict,
              law == Through::Law::orifice ? PassageVerdict::touched : PassageVerdict::passed);
    EXPECT_EQ(run.verdict(), law == Through::Law::orifice ? ProofVerdict::touched : ProofVerdict::avoided);
  }
}

TEST(Through, AMissedRingAndTheGoalThatWaits) {
  Scenario scenario = flight({1, 0, 0}, Through::Law::passage);
  scenario.orifices = {ring("O", {3, 4, 0}, {1, 0, 0}, 0.6)};
  scenario.duration = 6;
  Through& through = *scenario.bodies[0].pilot->through;
  through.orifices = {"O"};
  through.passage.most = 0.01;  // too weak to get there
  scenario.bodies[0].pilot->goal = Goal{{6, 0, 0}, 1, "", 0.5};
  simulation::Run run = simulate(scenario);
  EXPECT_EQ(run.passages.at(0).proof.verdict, PassageVerdict::missed);
  EXPECT_EQ(events_of(run, EventKind::goes_beside).size(), 1u);
  EXPECT_TRUE(events_of(run, EventKind::goes_through).empty());
  EXPECT_TRUE(events_of(run, EventKind::reaches_goal).empty());  // only after the orifice
  through.passage.most = 2;
  scenario.duration = 40;
  run = simulate(scenario);
  EXPECT_EQ(run.passages.at(0).proof.verdict, PassageVerdict::passed);
  const auto reached = events_of(run, EventKind::reaches_goal);
  ASSERT_EQ(reached.size(), 1u);
  EXPECT_GT(reached[0].t, events_of(run, EventKind::goes_through).at(0).t);
}

/// The run ends with another agent's goal before the second ring is there: it was ordered, and is missed.
TEST(Through, AnOrificeThatNeverCameIsMissed) {
  Scenario scenario = flight({1, 0, 0}, Through::Law::passage);
  scenario.orifices = {ring("O", {3, 0, 0}, {1, 0, 0}, 1), ring("late", {20, 0, 0}, {1, 0, 0}, 1)};
  scenario.orifices[1].appears = 30;
  scenario.bodies[0].pilot->through->orifices = {"O", "late"};
  Body other = scenario.bodies[0];
  other.name = "B";
  other.start.position = {0, 9, 0};
  other.pilot.emplace();
  other.pilot->goal = Goal{{6, 9, 0}, 1, "", 0.5};
  scenario.bodies.push_back(other);
  const simulation::Run run = simulate(scenario);
  EXPECT_LT(run.end, 30);
  int late = 0;
  for (const PassageOutcome& passage : run.passages) {
    if (passage.agent != 0) continue;
    const bool is_late = passage.orifice == 1;
    late += is_late;
    EXPECT_EQ(passage.proof.verdict, is_late ? PassageVerdict::missed : PassageVerdict::passed);
  }
  EXPECT_EQ(late, 1);
  // It flew through the very centre of the first one, at the time of a command.
  EXPECT_TRUE(std::any_of(run.orifices.begin(), run.orifices.end(),
                          [](const OrificeSample& sample) { return sample.state.r == 0; }));
}

TEST(Through, ScenariosThatMakeNoSense) {
  const auto field_of = [](const Scenario& scenario) -> std::string {
    try {
      check(scenario);
    } catch (const InputError& e) {
      return e.field();
    }
    return "";
  };
  Scenario good = flight({1, 0, 0}, Through::Law::orifice);
  good.orifices = {ring("O", {3, 0, 0}, {1, 0, 0}, 1)};
  good.bodies[0].pilot->through->orifices = {"O"};
  EXPECT_EQ(field_of(good), "");
  Scenario bad = good;
  bad.orifices.push_back(bad.orifices[0]);
  EXPECT_EQ(field_of(bad), "orifices[1].name");
  bad = good;
  bad.bodies[0].pilot->through->source.reference = 0;
  EXPECT_EQ(field_of(bad), "bodies[0].pilot.reference");
  bad.bodies[0].pilot->through->source.reference = -0.5;  // (1 - 0.3)^2 = 0.49
  EXPECT_EQ(field_of(bad), "bodies[0].pilot.reference");
  bad = good;
  bad.bodies[0].pilot->through->orifices = {"O", "P"};
  EXPECT_EQ(field_of(bad), "bodies[0].pilot.through[1]");
  bad = good;
  bad.orifices[0].rotation.col(0) *= 2;
  EXPECT_EQ(field_of(bad), "orifices[0].rotation");
}

}  // namespace
}  // namespace vericone::simulation::through_test
