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
#include <random>

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
  scenario.bodies[0].pilot->goals = {Goal{{6, 0, 0}, 1, "", 0.5, Vector3d::Zero(), ""}};
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
  other.pilot->goals = {Goal{{6, 9, 0}, 1, "", 0.5, Vector3d::Zero(), ""}};
  scenario.bodies.push_back(other);
  scenario.bodies[0].pilot->through->minds_none = true;
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
  // Of numbers that overflow on the way the field is named that has them.
  bad = good;
  bad.orifices[0].velocity.z() = 1e30;
  EXPECT_EQ(field_of(bad), "orifices[0].velocity[2]");
  bad = good;
  bad.orifices[0].position.x() = -1e200;
  EXPECT_EQ(field_of(bad), "orifices[0].position[0]");
  bad = good;
  bad.orifices[0].spin.y() = 1e99;
  EXPECT_EQ(field_of(bad), "orifices[0].spin[1]");
}

/// These laws see no bodies. One that stands in the way is met, and that is said before.
TEST(Through, BodiesInTheWayAreRefusedUnlessTheyAreMeant) {
  for (const Through::Law law : {Through::Law::orifice, Through::Law::passage}) {
    Scenario scenario = flight({1, 0, 0}, law);
    scenario.orifices = {ring("O", {5, 0, 0}, {1, 0, 0}, 1.5)};
    Through& through = *scenario.bodies[0].pilot->through;
    through.orifices = {"O"};
    through.source.reference = -0.5;
    EXPECT_NO_THROW(check(scenario));
    Body pillar;
    pillar.name = "pillar";
    pillar.shape = RigidShape{CombinedEllipsoid(Ellipsoid::from_axes(Vector3d::Zero(), {0.5, 0.5, 5}))};
    pillar.start.position = {2.5, 0, 0};
    scenario.bodies.push_back(pillar);
    try {
      check(scenario);
      ADD_FAILURE() << to_string(law);
    } catch (const InputError& e) {
      EXPECT_EQ(e.field(), "bodies[0].pilot.minds");
    }
    scenario.bodies[0].pilot->through->minds_none = true;
    EXPECT_EQ(simulate(scenario).verdict(), ProofVerdict::touched);
  }
}

/// Where what was commanded is taken back by more than half: reversals of a law that steers to and fro.
int reversals(const simulation::Run& run) {
  int count = 0;
  const OrificeSample* before = nullptr;
  for (const OrificeSample& sample : run.orifices) {
    const Vector3d& now = sample.command.acceleration;
    if (before && before->orifice == sample.orifice) {
      const Vector3d& last = before->command.acceleration;
      count += now.dot(last) < -0.5 * now.norm() * last.norm();
    }
    before = &sample;
  }
  return count;
}

/// The flight of docs/examples/scenarios/orifices.yaml; before the window it steers between two of its sides.
TEST(Through, NoCommandIsUndoneByTheNext) {
  Scenario scenario = flight({1, 0.4, 0}, Through::Law::passage);
  scenario.step = 0.02;
  scenario.bodies[0].shape =
      RigidShape{CombinedEllipsoid(Ellipsoid::from_axes(Vector3d::Zero(), {0.35, 0.15, 0.15}))};
  scenario.orifices = {ring("round", {6, 0.5, 1}, {1, 0.2, 0}, 0.8),
                       ring("slit", {14, -2, 1.5}, {1, 0, 0.2}, 1),
                       ring("window", {22, 2, 0}, {1, -0.3, 0}, 1)};
  for (MovingOrifice& orifice : scenario.orifices) {  // y as upright as it can be
    const Vector3d n = orifice.rotation.col(2), x = Vector3d::UnitZ().cross(n).normalized();
    orifice.rotation.col(0) = x;
    orifice.rotation.col(1) = n.cross(x);
  }
  scenario.orifices[0].velocity = {0, 0.1, -0.05};
  scenario.orifices[1].opening = Opening::ellipse({1.6, 0.5});
  scenario.orifices[1].spin = {0.15, 0, 0};
  scenario.orifices[2].opening =
      Opening::polygon({{-0.9, -0.6}, {0.9, -0.6}, {0.9, 0.6}, {0, 0.2}, {-0.9, 0.6}});
  scenario.orifices[2].wall = true;
  Through& through = *scenario.bodies[0].pilot->through;
  through.orifices = {"round", "slit", "window"};
  through.passage.most = 0.6;
  const simulation::Run run = simulate(scenario);
  for (const PassageOutcome& passage : run.passages) EXPECT_EQ(passage.proof.verdict, PassageVerdict::passed);
  EXPECT_LE(reversals(run), 1);
  // As near to the rim as the law that steered to and fro had been, or less.
  EXPECT_GE(run.passages.at(2).proof.least_distance, 0.054);
}

/// The same of openings with three to six corners, hulls and ellipsoids, from anywhere.
TEST(Through, NoCommandIsUndoneByTheNextWhateverTheCorners) {
  std::mt19937 generator(12);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution(low, high)(generator);
  };
  int passed = 0, turned = 0, commands = 0;
  for (int i = 0; i < 40; ++i) {
    Scenario scenario =
        flight({between(0.8, 1.2), between(-0.2, 0.2), between(-0.2, 0.2)}, Through::Law::passage);
    scenario.step = 0.02;
    if (i % 2) scenario.bodies[0].shape = RigidShape{HullBody::box({-0.3, -0.2, -0.1}, {0.3, 0.2, 0.1})};
    scenario.orifices = {ring("O", {between(5, 9), between(-1, 1), between(-1, 1)},
                              {1, between(-0.4, 0.4), between(-0.4, 0.4)}, 1)};
    std::vector<Eigen::Vector2d> corners;
    const int count = 3 + i % 4;
    for (int k = 0; k < count; ++k) {
      const double angle = 2 * std::numbers::pi * (k + between(-0.3, 0.3)) / count, r = between(0.45, 0.9);
      corners.emplace_back(r * std::cos(angle), r * std::sin(angle));
    }
    scenario.orifices[0].opening = Opening::polygon(corners);
    scenario.bodies[0].pilot->through->orifices = {"O"};
    scenario.bodies[0].pilot->through->passage.beyond = 0.3;  // more than there is room for
    const simulation::Run run = simulate(scenario);
    passed += run.passages.at(0).proof.verdict == PassageVerdict::passed;
    turned += reversals(run);
    commands += int(run.orifices.size());
  }
  EXPECT_GE(passed, 25);
  EXPECT_LE(turned, commands / 200);
}

}  // namespace
}  // namespace vericone::simulation::through_test
