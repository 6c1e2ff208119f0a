// SPDX-License-Identifier: BSD-3-Clause
//
// Placed bodies, meshes, maps and unions: their proofs, by distances, against those of the same bodies by
// planes and against sampled exact relations; and runs among them.
#include <gtest/gtest.h>
#include <vericone/cones/pair.h>
#include <vericone/geometry/error.h>
#include <vericone/simulation/run.h>
#include <array>

#include "moving_pairs.h"

namespace vericone::simulation::placed_test {
namespace {

/// The sides of a box as triangles: for what comes from outside the same as the solid.
vericone::Body shell(const Vector3d& half) {
  std::vector<Vector3d> corners = HullBody::box(-half, half).points();
  std::vector<Assembly::Triangle> triangles;
  constexpr std::uint32_t kSides[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                          {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
  for (const auto& side : kSides) {
    triangles.push_back({side[0], side[1], side[2]});
    triangles.push_back({side[0], side[2], side[3]});
  }
  return Assembly::mesh(std::move(corners), std::move(triangles));
}

/// A wall across x = 0 with a window about (0, 0, 0), 2 m wide and high.
vericone::Body wall_with_window() {
  return Assembly::boxes({{{-0.1, -6, -6}, {0.1, -1, 6}},
                          {{-0.1, 1, -6}, {0.1, 6, 6}},
                          {{-0.1, -1, -6}, {0.1, 1, -1}},
                          {{-0.1, -1, 1}, {0.1, 1, 6}}});
}

Track moving(Random& random, const ShapeInTime& shape, const Vector3d& position, bool turns) {
  const Vector3d velocity = towards(random, position, 5, 2);
  const Matrix3d rotation = random.rotation();
  return turns ? turning(random, shape, {position, velocity, rotation}, 4, 5)
               : straight(shape, position, velocity, 5, rotation);
}

TEST(ProofOfPlaced, ShellsAreSolidBoxesFromOutside) {
  SCOPED_TRACE("seed 71");
  Random random(71);
  std::array<int, 3> counts{};
  for (int i = 0; i < 120; ++i) {
    const Vector3d half(random.uniform(0.5, 3), random.uniform(0.5, 3), random.uniform(0.5, 3));
    const Vector3d axes(random.uniform(0.3, 2), random.uniform(0.3, 2), random.uniform(0.3, 2));
    const Vector3d p = random.vector(15), q = random.vector(15);
    const Track a = moving(random, ellipsoid(axes), p, i % 2 == 0);
    const Track solid = moving(random, RigidShape{HullBody::box(-half, half)}, q, i % 4 < 2);
    Track hollow(RigidShape{Placed(shell(half))}, solid.motion(0), solid.orientation(), 0);
    for (const auto& leg : solid.legs()) hollow.advance(solid.acceleration(leg->from()), leg->to());
    if (pair_of(a.state(0).shape, solid.state(0).shape).relation() != Relation::disjoint) continue;
    const PairProof by_planes = prove(a, solid, 0, 5), by_distance = prove(a, hollow, 0, 5),
                    exchanged = prove(hollow, a, 0, 5);
    ++counts[static_cast<std::size_t>(by_distance.verdict)];
    EXPECT_EQ(by_distance.verdict, by_planes.verdict) << i;
    EXPECT_EQ(by_distance.verdict, exchanged.verdict) << i;
    if (by_planes.verdict == ProofVerdict::touched) {
      EXPECT_NEAR(by_distance.to, by_planes.to, 1e-5) << i;
      EXPECT_LE(by_distance.from, by_planes.to);
      EXPECT_LE((by_distance.place - by_planes.place).norm(), 1e-2) << i;
    } else {
      const double scale = by_planes.least_distance;
      // Both are lower bounds of the same distance. That by distances is the weaker one where bodies turn, by
      // a part of the first order of a piece's length: how sharp it is, not whether it holds.
      const bool turns = i % 2 == 0 || i % 4 < 2;
      EXPECT_NEAR(by_distance.least_distance, scale, (turns ? 0.1 : 0.02) * scale + 1e-5) << i;
    }
  }
  EXPECT_GT(counts[0], 25);
  EXPECT_GT(counts[1], 25);
  EXPECT_EQ(counts[2], 0);
}

TEST(ProofOfPlaced, UnionsAndCloudsAgainstSampledRelations) {
  SCOPED_TRACE("seed 72");
  Random random(72);
  std::array<int, 3> counts{};
  for (int i = 0; i < 90; ++i) {
    std::vector<CombinedEllipsoid> pieces;
    std::vector<Vector3d> points;
    for (int j = 0; j < 4; ++j) {
      points.push_back(random.vector(4));
      pieces.push_back(Ellipsoid::from_axes(points.back(), {random.uniform(0.3, 1.5), 0.5, 0.7}));
    }
    const vericone::Body body = i % 2 ? vericone::Body::pieces(pieces) : Assembly::cloud(points, 0.6);
    const Vector3d p = random.vector(12), q = random.vector(12);
    const ShapeInTime agent = i % 3 == 0
                                  ? ShapeInTime(RigidShape{HullBody::box({-1, -0.4, -0.3}, {1, 0.4, 0.3})})
                                  : ellipsoid({1, 0.5, 0.3});
    const Track a = moving(random, agent, p, true),
                b = moving(random, RigidShape{Placed(body)}, q, i % 4 < 2);
    const PairProof proof = prove(a, b, 0, 5);
    ++counts[static_cast<std::size_t>(proof.verdict)];
    const auto relation = [&](double t) { return *pair_of(a.state(t).shape, b.state(t).shape).relation(); };
    expect_sampled(proof, 5, [&](double t) { return relation(t) != Relation::disjoint; });
  }
  EXPECT_GT(counts[0], 10);
  EXPECT_GT(counts[1], 10);
  EXPECT_EQ(counts[2], 0);
}

/// Through the window without contact, which no plane and no containing ellipsoid tells.
TEST(ProofOfPlaced, ThroughAWindow) {
  const ShapeInTime wall = RigidShape{Placed(wall_with_window())};
  const Track still = straight(wall, {0, 0, 0}, {0, 0, 0}, 4);
  for (const double aside : {0.0, 0.4, 0.5 - 1e-6, 0.5 + 1e-6, 0.7}) {
    const Track a = straight(ball(0.5), {-4, aside, 0}, {2, 0, 0}, 4);
    const PairProof proof = prove(a, still, 0, 4);
    EXPECT_EQ(proof.verdict, aside < 0.5 ? ProofVerdict::avoided : ProofVerdict::touched) << aside;
    if (aside < 0.5) {
      EXPECT_LE(proof.least_distance, 0.5 - aside);
      EXPECT_GE(proof.least_distance, 0.98 * (0.5 - aside) - 2e-6);
    }
  }
}

/// Metres of closeness below the padding are not proved, and not denied.
TEST(ProofOfPlaced, GrazingIsUndecided) {
  const Track still = straight(RigidShape{Placed(wall_with_window())}, {0, 0, 0}, {0, 0, 0}, 4);
  const Track a = straight(ball(0.5), {-4, 0.5 - 1e-9, 0}, {2, 0, 0}, 4);
  EXPECT_EQ(prove(a, still, 0, 4).verdict, ProofVerdict::undecided);
}

Body body_of(const std::string& name, const ShapeInTime& shape, const Vector3d& position,
             const Vector3d& velocity) {
  Body body;
  body.name = name;
  body.shape = shape;
  body.start.position = position;
  body.start.velocity = velocity;
  return body;
}

Scenario through_the_wall(guidance::Law law, const Vector3d& aim, const Vector3d& drift = {0, 0, 0}) {
  Scenario scenario;
  scenario.duration = 12;
  scenario.step = 0.05;
  scenario.bodies = {body_of("A", ellipsoid({0.4, 0.3, 0.2}), {-8, 0.5, 0.3}, {2, 0.6, 0.2}),
                     body_of("wall", RigidShape{Placed(wall_with_window())}, {0, 0, 0}, drift)};
  Pilot pilot;
  pilot.guide.law = law;
  pilot.guide.inversion.most = pilot.guide.clearance.most = 3;
  pilot.guide.clearance.required = 0.2;
  pilot.guide.clearance.beyond = 0.05;
  pilot.goals = {Goal{aim, 3, "", 0.3, Vector3d::Zero(), ""}};
  scenario.bodies[0].pilot = pilot;
  return scenario;
}

TEST(GuardedAmongPlaced, FliesThroughTheWindow) {
  for (const guidance::Law law : {guidance::Law::clearance, guidance::Law::avoidance}) {
    const Scenario scenario = through_the_wall(law, {6, 0, 0});
    const simulation::Run run = simulate(scenario);
    EXPECT_EQ(run.verdict(), ProofVerdict::avoided);
    EXPECT_TRUE(find_event(scenario, run, EventKind::reaches_goal, "A", "A"));
    // Through the window and not around the wall.
    const Track& way = run.tracks[0];
    for (double t = 0; t < way.end(); t += 0.01)
      if (const Vector3d x = way.motion(t).position; std::abs(x.x()) < 0.2) {
        EXPECT_LT(std::max(std::abs(x.y()), std::abs(x.z())), 1);
      }
  }
}

/// The origin of a map may be anywhere: a body with rooms is passed when the agent is out of its bounds.
TEST(AmongPlaced, AMapIsPassedWhenTheAgentIsOutOfIt) {
  for (const Vector3d& origin : {Vector3d(0, 0, 0), Vector3d(-3, 2, 1), Vector3d(40, -7, 0)}) {
    // Two walls along x, from 2 to 9 m, 4 m apart.
    std::vector<Box> boxes{{Vector3d(2, -3, -1) - origin, Vector3d(9, -2, 1) - origin},
                           {Vector3d(2, 2, -1) - origin, Vector3d(9, 3, 1) - origin}};
    Scenario scenario;
    scenario.duration = 12;
    scenario.step = 0.05;
    scenario.bodies = {body_of("A", ellipsoid({0.4, 0.3, 0.2}), {0, 0, 0}, {1, 0, 0}),
                       body_of("map", RigidShape{Placed(Assembly::boxes(boxes))}, origin, {0, 0, 0})};
    scenario.bodies[0].pilot.emplace();
    const simulation::Run run = simulate(scenario);
    std::vector<Event> passes;
    for (const Event& e : run.events)
      if (e.kind == EventKind::passes) passes.push_back(e);
    ASSERT_EQ(passes.size(), 1u);
    EXPECT_NEAR(passes[0].t, 9, 1e-6);
    EXPECT_NEAR(passes[0].value, 3.5, 1e-6);  // from the middle of the bounds
  }
}

TEST(GuardedAmongPlaced, GoesBesideWhereTheWayIsBlocked) {
  const Scenario scenario = through_the_wall(guidance::Law::clearance, {7, 3, 0}, {-0.2, 0, 0});
  const simulation::Run run = simulate(scenario);
  EXPECT_EQ(run.verdict(), ProofVerdict::avoided);
  ASSERT_EQ(run.proofs.size(), 1u);
  EXPECT_TRUE(run.proofs[0].kept()) << run.proofs[0].proof.least_distance;
}

TEST(UnguardedAmongPlaced, TheClearanceLawKeepsAwayFromAShell) {
  Scenario scenario = through_the_wall(guidance::Law::clearance, {0, 0, 0});
  scenario.bodies[1] = body_of("box", RigidShape{Placed(shell({1, 2, 1}))}, {4, 1, 0}, {-0.5, 0, 0});
  scenario.bodies[0].start.velocity = {2, 0, 0};
  Pilot& pilot = *scenario.bodies[0].pilot;
  pilot.manner = Manner::source;
  pilot.goals.clear();
  pilot.guide.clearance.gain = 2;
  EXPECT_EQ(simulate(scenario).verdict(), ProofVerdict::avoided);
  pilot.guide.clearance.most = 1e-6;
  EXPECT_EQ(simulate(scenario).verdict(), ProofVerdict::touched);
}

/// (6.17) on the sectors of the shell itself; and of an agent that is a shell, too.
TEST(UnguardedAmongPlaced, TheSourcesLawKeepsAwayFromAShell) {
  for (const bool both : {false, true}) {
    Scenario scenario = through_the_wall(guidance::Law::avoidance, {0, 0, 0});
    scenario.bodies[1] = body_of("box", RigidShape{Placed(shell({1, 2, 1}))}, {4, 1, 0}, {-0.5, 0, 0});
    scenario.bodies[0].start.velocity = {2, 0, 0};
    Pilot& pilot = *scenario.bodies[0].pilot;
    if (both) {
      // Meshes against meshes have slow sectors (docs/reference/pairs.md): few planes, few steps.
      scenario.bodies[0].shape = RigidShape{Placed(shell({0.4, 0.3, 0.2}))};
      scenario.duration = 7;
      scenario.step = 0.1;
      pilot.guide.plane.planes = 3;
      pilot.guide.plane.refine = false;
    }
    pilot.manner = Manner::source;
    pilot.goals.clear();
    pilot.guide.inversion.gain = 4;
    pilot.guide.inversion.reference = 0.02;
    pilot.guide.inversion.cease = 0.01;
    EXPECT_EQ(simulate(scenario).verdict(), ProofVerdict::avoided) << both;
    pilot.guide.inversion.most = 1e-6;
    EXPECT_EQ(simulate(scenario).verdict(), ProofVerdict::touched) << both;
  }
}

TEST(Scenarios, LawsBySlicesRefusePlacedBodies) {
  Scenario scenario = through_the_wall(guidance::Law::avoidance, {6, 0, 0});
  scenario.bodies[0].pilot->manner = Manner::source;
  scenario.bodies[0].pilot->guide.sector = guidance::SectorMethod::slice;
  try {
    check(scenario);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(e.field(), "bodies[0].pilot.law");
    EXPECT_NE(e.value().find("wall"), std::string::npos);
  }
}

}  // namespace
}  // namespace vericone::simulation::placed_test
