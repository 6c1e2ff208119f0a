// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/geometry/error.h>
#include <vericone/simulation/run.h>
#include <vericone/testing/random_bodies.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace vericone::simulation::run_test {
namespace {

using Eigen::Vector3d;
using guidance::Law;
using guidance::PlaneChoice;
using guidance::SectorMethod;
using vericone::testing::RandomBodies;

Body ellipsoid(const std::string& name, const Vector3d& semi_axes, const Vector3d& position,
               const Vector3d& velocity, const Eigen::Matrix3d& rotation = Eigen::Matrix3d::Identity()) {
  Body body;
  body.name = name;
  body.shape = RigidShape{CombinedEllipsoid(Ellipsoid::from_axes(Vector3d::Zero(), semi_axes))};
  body.start = {position, velocity, rotation};
  return body;
}

Body ellipse(const std::string& name, const Eigen::Vector2d& semi_axes, const Eigen::Vector2d& position,
             double speed, double heading) {
  Body body;
  body.name = name;
  body.shape = RigidShape{CombinedEllipse(Ellipse::from_axes({0, 0}, semi_axes))};
  const Vector3d ahead(std::cos(heading), std::sin(heading), 0);
  body.start.position = {position.x(), position.y(), 0};
  body.start.velocity = speed * ahead;
  body.start.rotation.topLeftCorner<2, 2>() = rotation_2d(heading);
  return body;
}

/// The laws themselves; guarded pilots have their own tests (guarded_test.cpp).
Pilot pilot(Law law, double most = 10) {
  Pilot result;
  result.manner = Manner::source;
  result.guide.law = law;
  result.guide.inversion.gain = result.guide.clearance.gain = 2;
  result.guide.inversion.reference = 0.05;
  result.guide.inversion.most = result.guide.clearance.most = most;
  result.guide.clearance.required = 0.5;
  return result;
}

/// Two ellipsoids on a collision course.
Scenario encounter() {
  Scenario scenario;
  scenario.name = "encounter";
  scenario.duration = 8;
  scenario.step = 0.02;
  scenario.bodies.push_back(ellipsoid("A", {3, 1, 1}, {0, 0, 0}, {8, 0.5, 0}));
  scenario.bodies.push_back(ellipsoid("B", {2, 3, 1}, {30, 2, 1}, {-2, 0, 0}));
  return scenario;
}

TEST(Run, FreeFlightTouchesWhenTheConeSays) {
  Scenario scenario = encounter();
  scenario.bodies[0].pilot = pilot(Law::avoidance);
  scenario.bodies[0].pilot->minds = {"B"};
  scenario.bodies[0].pilot->guide.inversion.cease =
      -std::numeric_limits<double>::infinity();  // commands nothing
  const auto run = simulate(scenario);
  ASSERT_EQ(run.verdict(), ProofVerdict::touched);
  const Body &a = scenario.bodies[0], &b = scenario.bodies[1];
  const auto contact =
      time_to_contact(Ellipsoid::from_axes(a.start.position, {3, 1, 1}),
                      Ellipsoid::from_axes(b.start.position, {2, 3, 1}), a.start.velocity - b.start.velocity);
  ASSERT_TRUE(contact);
  EXPECT_LE(run.proofs.at(0).proof.from, *contact + 1e-9);
  EXPECT_GE(run.proofs.at(0).proof.to, *contact - 1e-9);
  EXPECT_LT(run.proofs.at(0).proof.to - run.proofs.at(0).proof.from, 1e-3);
  EXPECT_TRUE(find_event(scenario, run, EventKind::contact, "A", "B"));
}

struct LawCase {
  const char* name;
  Law law;
  SectorMethod sector;
  PlaneChoice plane;
};

class Avoidance : public ::testing::TestWithParam<LawCase> {};

TEST_P(Avoidance, IsProved) {
  Scenario scenario = encounter();
  scenario.bodies[0].pilot = pilot(GetParam().law);
  scenario.bodies[0].pilot->guide.sector = GetParam().sector;
  scenario.bodies[0].pilot->guide.plane.choice = GetParam().plane;
  const auto run = simulate(scenario);
  EXPECT_EQ(run.verdict(), ProofVerdict::avoided);
  EXPECT_GT(run.proofs.at(0).proof.least_distance, 0);
  EXPECT_TRUE(find_event(scenario, run, EventKind::enters_cone, "A", "B"));
  const auto leaves = find_event(scenario, run, EventKind::leaves_cone, "A", "B");
  ASSERT_TRUE(leaves);
  const auto passes = find_event(scenario, run, EventKind::passes, "A", "B");
  ASSERT_TRUE(passes);
  EXPECT_LT(leaves->t, passes->t);
  // The bodies as they were, at a thousand times.
  double least = 1e300;
  for (int i = 0; i <= 1000; ++i) {
    const double t = run.end * i / 1000;
    const auto a = run.tracks[0].state(t), b = run.tracks[1].state(t);
    least =
        std::min(least, separation(a.shape.quadric()->ellipsoid(), b.shape.quadric()->ellipsoid()).distance);
  }
  EXPECT_GE(least, run.proofs.at(0).proof.least_distance);
  if (GetParam().law == Law::clearance) {
    EXPECT_GE(least, 0.5 - 1e-6);
  }
  // Speeds are kept: all accelerations are lateral.
  EXPECT_NEAR(run.tracks[0].motion(run.end).velocity.norm(), scenario.bodies[0].start.velocity.norm(), 1e-8);
}
INSTANTIATE_TEST_SUITE_P(Laws, Avoidance,
                         ::testing::Values(LawCase{"ExactLargestOpening", Law::avoidance,
                                                   SectorMethod::true_cone, PlaneChoice::largest_opening},
                                           LawCase{"ExactOfMotion", Law::avoidance, SectorMethod::true_cone,
                                                   PlaneChoice::of_motion},
                                           LawCase{"SteepestClearance", Law::avoidance,
                                                   SectorMethod::true_cone, PlaneChoice::steepest_clearance},
                                           LawCase{"Clearance", Law::clearance, SectorMethod::true_cone,
                                                   PlaneChoice::of_motion}),
                         [](const auto& param) { return std::string(param.param.name); });

/// What the slice cone costs: the same law on the sections' sectors leaves the slice cone, commands nothing
/// more, and hits.
TEST(Run, SlicesSayClearAndTouch) {
  Scenario scenario = encounter();
  scenario.bodies[0].pilot = pilot(Law::avoidance);
  scenario.bodies[0].pilot->guide.sector = SectorMethod::slice;
  const auto run = simulate(scenario);
  const auto leaves = find_event(scenario, run, EventKind::leaves_cone, "A", "B");
  ASSERT_TRUE(leaves);
  EXPECT_FALSE(find_event(scenario, run, EventKind::enters_cone, "A", "B", leaves->t));
  EXPECT_EQ(run.verdict(), ProofVerdict::touched);
  EXPECT_GT(run.proofs.at(0).proof.to, leaves->t);
}

TEST(Run, IsTheSameEveryTime) {
  Scenario scenario = encounter();
  scenario.bodies[0].pilot = pilot(Law::avoidance);
  const auto one = simulate(scenario), two = simulate(scenario);
  EXPECT_EQ(one.tracks[0].motion(one.end).position, two.tracks[0].motion(two.end).position);
  ASSERT_EQ(one.encounters.size(), two.encounters.size());
  RunOptions silent;
  silent.log = false;
  const auto three = simulate(scenario, silent);
  EXPECT_EQ(one.tracks[0].motion(one.end).position, three.tracks[0].motion(three.end).position);
  EXPECT_TRUE(three.encounters.empty());
}

TEST(Run, TimeOfLeavingDoesNotDependOnTheStep) {
  Scenario scenario = encounter();
  scenario.bodies[0].pilot = pilot(Law::avoidance, 1e3);
  scenario.bodies[0].pilot->guide.inversion.gain = 1;
  scenario.bodies[0].pilot->guide.plane.choice = PlaneChoice::of_motion;
  std::vector<double> times;
  for (const double step : {0.02, 0.01, 0.005}) {
    scenario.step = step;
    const auto run = simulate(scenario);
    const auto leaves = find_event(scenario, run, EventKind::leaves_cone, "A", "B");
    ASSERT_TRUE(leaves);
    times.push_back(leaves->t);
  }
  // y = w + (y(0) - w) exp(-K t) in the limit of small steps; held commands are first order in the step.
  const auto first = [&] {
    const auto run = simulate(scenario);
    return run.encounters.front().step.y;
  }();
  const double ideal = std::log((0.05 - first) / 0.05);
  EXPECT_NEAR(times[2], ideal, 0.01 * ideal + 0.01);
  EXPECT_LT(std::abs(times[2] - ideal), std::abs(times[0] - ideal) + 1e-9);
}

TEST(Run, PassesAtTheClosestApproach) {
  Scenario scenario = encounter();
  scenario.bodies[1].start.position = {30, 12, 1};
  scenario.bodies[0].pilot = pilot(Law::avoidance);
  scenario.bodies[0].pilot->passing = Passing::centres;
  const auto run = simulate(scenario);
  EXPECT_FALSE(find_event(scenario, run, EventKind::enters_cone, "A", "B"));
  const auto passes = find_event(scenario, run, EventKind::passes, "A", "B");
  ASSERT_TRUE(passes);
  const Vector3d c(30, 12, 1), w(10, 0.5, 0);
  EXPECT_NEAR(passes->t, c.dot(w) / w.squaredNorm(), 1e-9);
  EXPECT_NEAR(passes->value, c.cross(w).norm() / w.norm(), 1e-9);
}

TEST(Run, TurnsToItsGoalAndReachesIt) {
  Scenario scenario;
  scenario.duration = 20;
  scenario.bodies.push_back(ellipse("A", {2, 1}, {0, 0}, 5, 0));
  scenario.bodies[0].pilot = pilot(Law::avoidance);
  scenario.bodies[0].pilot->goals = {Goal{{0, 30, 0}, 5, "", 1, Vector3d::Zero(), ""}};
  const auto run = simulate(scenario);
  // A circle of radius v^2/a = 5 m about (0, 5) until the tangent points at the goal: the tangent length from
  // (0, 30) is sqrt(25^2 - 5^2), the angle turned pi - acos(5 / 25) - (angle at the goal's side).
  const auto aligned = find_event(scenario, run, EventKind::aligned, "A", "A");
  ASSERT_TRUE(aligned);
  const double turned = std::numbers::pi - std::acos(5.0 / 25.0);
  EXPECT_NEAR(aligned->t, turned * 5 / 5, 0.011);
  const auto reached = find_event(scenario, run, EventKind::reaches_goal, "A", "A");
  ASSERT_TRUE(reached);
  EXPECT_NEAR(reached->t, turned + (std::sqrt(25.0 * 25 - 25) - 1) / 5, 0.02);
  EXPECT_LT(run.end, scenario.duration);
}

TEST(Run, MatchesVelocitiesAtARendezvous) {
  Scenario scenario;
  scenario.duration = 25;
  scenario.step = 0.01;
  scenario.bodies.push_back(ellipse("A", {2, 1}, {0, 0}, 6, 0.3));
  scenario.bodies.push_back(ellipse("B", {2, 1}, {30, 4}, 3, 0.2));
  Pilot p = pilot(Law::matching_rendezvous, 20);
  p.guide.inversion.reference = 0;
  p.guide.gain_speed = 0.3;
  scenario.bodies[0].pilot = p;
  const auto run = simulate(scenario);
  const double before = (scenario.bodies[0].start.velocity - scenario.bodies[1].start.velocity).squaredNorm();
  const double t = 2;
  const double v2 = (run.tracks[0].motion(t).velocity - run.tracks[1].motion(t).velocity).squaredNorm();
  // y_2' = -K_2 y_2 (5.17).
  EXPECT_NEAR(v2, before * std::exp(-0.3 * t), 0.02 * before);
}

TEST(Run, PartnersCarryOutTheirPart) {
  Scenario scenario = encounter();
  scenario.bodies[0].pilot = pilot(Law::cooperative_avoidance);
  scenario.bodies[0].pilot->guide.mu = -0.5;
  scenario.bodies[0].pilot->partners = {"B"};
  const auto run = simulate(scenario);
  const Vector3d a = run.tracks[0].acceleration(0.01), b = run.tracks[1].acceleration(0.01);
  EXPECT_GT(a.norm(), 0);
  EXPECT_NEAR(b.norm(), 0.5 * a.norm(), 1e-9 * a.norm());
}

/// Two agents, each with a mind of its own, exchange their places: mirror images of each other all the way,
/// and each flies to its goal.
TEST(Run, SeveralAgentsAvoidEachOther) {
  Scenario scenario;
  scenario.duration = 20;
  scenario.step = 0.02;
  scenario.bodies.push_back(ellipsoid("A", {2, 1, 1}, {-20, 0, 0}, {5, 0.2, 0.1}));
  scenario.bodies.push_back(ellipsoid("B", {2, 1, 1}, {20, 0, 0}, {-5, -0.2, -0.1}));
  for (const int i : {0, 1}) {
    scenario.bodies[i].pilot = pilot(Law::clearance);
    scenario.bodies[i].pilot->goals = {
        Goal{-scenario.bodies[i].start.position, 3, "", 1, Vector3d::Zero(), ""}};
  }
  const auto run = simulate(scenario);
  EXPECT_EQ(run.verdict(), ProofVerdict::avoided);
  ASSERT_EQ(run.proofs.size(), 1u);
  // While they are clear they turn to their goals: for one step, 0.02 s at 3 m/s^2 each, until the law is
  // asked again.
  EXPECT_GE(run.proofs[0].proof.least_distance, 0.5 - 0.05);
  const auto a = find_event(scenario, run, EventKind::reaches_goal, "A", "A"),
             b = find_event(scenario, run, EventKind::reaches_goal, "B", "B");
  ASSERT_TRUE(a && b);
  EXPECT_NEAR(a->t, b->t, 1e-6);
  EXPECT_LT(run.end, 10);
  for (const double t : {1.0, 3.0, 5.0})
    EXPECT_LT((run.tracks[0].motion(t).position + run.tracks[1].motion(t).position).norm(), 1e-6) << t;
}

// The farther one is minded as well, and its law demands something; but first things first.
TEST(Run, AttendsToWhatIsMetFirst) {
  Scenario scenario;
  scenario.duration = 8;
  scenario.step = 0.02;
  scenario.bodies.push_back(ellipsoid("A", {1, 1, 1}, {0, 0, 0}, {5, 0, 0}));
  scenario.bodies.push_back(ellipsoid("far", {2, 2, 2}, {35, 0.5, 0}, {0, 0, 0}));
  scenario.bodies.push_back(ellipsoid("near", {1, 1, 1}, {15, 0.5, 0}, {0, 0, 0}));
  scenario.bodies[0].pilot = pilot(Law::clearance);
  const auto run = simulate(scenario);
  EXPECT_EQ(run.verdict(), ProofVerdict::avoided);
  const auto near = sample_at(scenario, run, "A", "near", 0), far = sample_at(scenario, run, "A", "far", 0);
  ASSERT_TRUE(near && far);
  EXPECT_GT(near->step.a.norm(), 0);
  EXPECT_GT(far->step.a.norm(), 0);
  EXPECT_TRUE(near->attended);
  EXPECT_FALSE(far->attended);
}

TEST(Run, BodiesAppearWhenTheyAreSaidTo) {
  Scenario scenario = encounter();
  scenario.bodies[1].appears = 1.2345;
  scenario.bodies[0].pilot = pilot(Law::avoidance);
  const auto run = simulate(scenario);
  EXPECT_EQ(run.encounters.front().t, 1.2345);
  EXPECT_EQ(run.tracks[1].motion(1.2345).position, scenario.bodies[1].start.position);
}

TEST(Run, EndsWhereItIsAskedToStop) {
  Stop stop;
  RunOptions options;
  options.progress = [&](double t) {
    if (t >= 1) stop.request();
    return true;
  };
  const StopScope scope(&stop);
  EXPECT_THROW(static_cast<void>(simulate(encounter(), options)), Interrupted);
}

TEST(Run, CanBeInterrupted) {
  RunOptions options;
  options.progress = [](double t) { return t < 1; };
  const auto run = simulate(encounter(), options);
  EXPECT_TRUE(run.interrupted);
  EXPECT_NEAR(run.end, 1, 0.021);
}

void expect_refused(const Scenario& scenario, const std::string& field) {
  try {
    check(scenario);
    ADD_FAILURE() << "accepted " << field;
  } catch (const InputError& e) {
    EXPECT_EQ(e.field(), field);
  }
}

TEST(ScenarioCheck, NamesTheField) {
  Scenario scenario = encounter();
  scenario.bodies[0].pilot = pilot(Law::avoidance);
  check(scenario);
  const auto with = [&](auto change, const std::string& field) {
    Scenario wrong = scenario;
    change(wrong);
    expect_refused(wrong, field);
  };
  with([](Scenario& s) { s.duration = -1; }, "duration");
  with([](Scenario& s) { s.step = 0; }, "step");
  with([](Scenario& s) { s.bodies[1].name = "A"; }, "bodies[1].name");
  with([](Scenario& s) { s.bodies[0].pilot->minds = {"B", "C"}; }, "bodies[0].pilot.minds[1]");
  with([](Scenario& s) { s.bodies[0].pilot->partners = {"B"}; }, "bodies[0].pilot.partners");
  with([](Scenario& s) { s.bodies[0].pilot->guide.inversion.gain = 0; }, "bodies[0].pilot.gain");
  with([](Scenario& s) { s.bodies[0].start.velocity.setZero(); }, "bodies[0].velocity");
  with([](Scenario& s) { s.bodies[1].appears = 100; }, "bodies[1].appears");
  with([](Scenario& s) { s.bodies[1] = ellipse("B", {1, 1}, {9, 9}, 1, 0); }, "bodies[1].shape");
  with(
      [](Scenario& s) {
        s.bodies[0].pilot->goals = {Goal{{0, 0, 0}, 1, "X", 1, Vector3d::Zero(), ""}};
      },
      "bodies[0].pilot.goals[0].after");
}

TEST(Run, SaysHowLongDecisionsTookAndShowsHowFarProofsAre) {
  Scenario scenario = encounter();
  scenario.bodies[0].pilot = pilot(Law::avoidance);
  RunOptions options;
  std::vector<double> shares;
  options.proving = [&](double share) {
    shares.push_back(share);
    return true;
  };
  const auto run = simulate(scenario, options);
  const auto steps = std::uint64_t(std::lround(std::ceil(run.end / scenario.step - 1e-9)));
  EXPECT_EQ(run.times.decisions,
            steps * std::uint64_t(std::count_if(scenario.bodies.begin(), scenario.bodies.end(),
                                                [](const Body& body) { return body.pilot.has_value(); })));
  EXPECT_GT(run.times.mean, 0);
  EXPECT_GT(run.times.within, 0);
  EXPECT_LE(run.times.within, run.times.worst);
  EXPECT_LE(run.times.mean, run.times.worst);
  EXPECT_GT(run.times.proofs, 0);
  ASSERT_EQ(shares.size(), run.proofs.size());
  EXPECT_EQ(shares.front(), 0);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_LT(shares.back(), 1);
  // No proof more than wanted.
  options.proving = [](double) { return false; };
  const auto stopped = simulate(scenario, options);
  EXPECT_TRUE(stopped.interrupted);
  EXPECT_TRUE(stopped.proofs.empty());
}

TEST(Run, SaysWhatAccelerationWasReached) {
  Scenario scenario = encounter();
  scenario.bodies[0].pilot = pilot(Law::avoidance, 3);
  scenario.bodies[0].pilot->goals = {
      Goal{{0, 90, 0}, 5, "", 1, Vector3d::Zero(), ""}};  // turns harder than its law may
  const auto run = simulate(scenario);
  EXPECT_EQ(most_commanded(*scenario.bodies[0].pilot), 3);
  double most = 0;
  for (double t = 0; t < run.end; t += 0.01) most = std::max(most, run.tracks[0].acceleration(t).norm());
  EXPECT_GE(run.tracks[0].most_acceleration(), most * (1 - 1e-12));
  EXPECT_NEAR(run.tracks[0].most_acceleration(), 5, 1e-9);
  scenario.bodies[0].pilot->guide.law = Law::clearance;
  scenario.bodies[0].pilot->guide.clearance.most = 4;
  EXPECT_EQ(most_commanded(*scenario.bodies[0].pilot), 4);
}

TEST(Run, ACurrentThatMovesNothingIsRefused) {
  Scenario scenario = encounter();
  scenario.water = Current({0, 0, 0.1});
  try {
    check(scenario);
    ADD_FAILURE();
  } catch (const InputError& e) {
    EXPECT_EQ(e.field(), "current");
  }
  scenario.water = {};
  EXPECT_NO_THROW(check(scenario));
}

/// What the check serves the proof serves: of a hull that flies and an obstacle with dents, too.
TEST(Run, OfAHullAndABodyWithDentsIsProved) {
  Scenario scenario = encounter();
  scenario.bodies[0].shape = RigidShape{HullBody::box({-1, -0.5, -0.5}, {1, 0.5, 0.5})};
  scenario.bodies[1].shape = DentedQuadric{{4, 3, 3}, {0.5, 0.2, 1, 0, false}};
  scenario.bodies[0].pilot = pilot(Law::clearance);
  const auto run = simulate(scenario);
  ASSERT_EQ(run.proofs.size(), 1u);
  EXPECT_NE(run.proofs[0].proof.verdict, ProofVerdict::undecided);
}

}  // namespace
}  // namespace vericone::simulation::run_test
