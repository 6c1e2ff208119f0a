// SPDX-License-Identifier: BSD-3-Clause
//
// Encounters: how near tracks come against dense samples and closed forms, intervals of risk ratios by how
// often they hold, tables that scenarios fly.
#include "scenarios/encounters/encounter_set.h"

#include <gtest/gtest.h>
#include <unistd.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/random_engagement.h>
#include <vericone/simulation/run.h>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "scenarios/encounters/near_miss.h"
#include "scenarios/encounters/risk.h"

namespace vericone::encounters_test {
namespace {

using namespace encounters;
using Eigen::Vector3d;
using engagements::Random;
using simulation::Orientation, simulation::ShapeInTime, simulation::Track;

const Volume kVolume{"500 ft:100 ft", 152.4, 30.48};

double size(const Vector3d& apart, const Volume& volume) {
  return std::max(apart.head<2>().norm() / volume.radius, std::abs(apart.z()) / volume.half_height);
}

Track flown(Random& random, const Vector3d& from, const Vector3d& velocity, int arcs) {
  Track track(ShapeInTime(), {from, velocity, Eigen::Matrix3d::Identity()}, Orientation::fixed, 0);
  for (int i = 1; i <= arcs; ++i) track.advance(random.uniform(0, 1.5) * random.direction(), 40.0 * i / arcs);
  return track;
}

TEST(Encounters, VolumesHaveUnits) {
  EXPECT_DOUBLE_EQ(volume_of("500 ft:100 ft", "--volumes").radius, 152.4);
  EXPECT_DOUBLE_EQ(volume_of("500 ft:100 ft", "--volumes").half_height, 30.48);
  EXPECT_DOUBLE_EQ(volume_of("5 nmi:300", "--volumes").radius, 9260);
  EXPECT_DOUBLE_EQ(volume_of("1e3:300", "--volumes").radius, 1000);
  for (const char* wrong : {"500", "0:1", "-3:1", "1:x", "1:2 kg", ":", "1:2:3", "nan:1"})
    EXPECT_THROW(volume_of(wrong, "--volumes"), InputError) << wrong;
}

TEST(Encounters, NearnessIsThatOfDenseSamples) {
  int entered = 0, undecided = 0;
  for (std::uint64_t i = 0; i < 300; ++i) {
    Random random(5, i);
    const int arcs = i % 3 == 0 ? 1 : int(random.uniform(2, 12));
    const Vector3d velocity = 60 * random.direction(), start = 900 * random.direction();
    // Without what they do on the way they would meet.
    const Track a = flown(random, Vector3d::Zero(), velocity, arcs),
                b = flown(random, start, velocity - start / random.uniform(5, 30), arcs);
    const Nearness found = nearness(a, b, 0, 40, kVolume);
    double least = 1e9;
    constexpr int kSamples = 8000;
    for (int k = 0; k <= kSamples; ++k) {
      const double t = 40.0 * k / kSamples;
      least = std::min(least, size(a.motion(t).position - b.motion(t).position, kVolume));
    }
    const double said = std::max(found.horizontal / kVolume.radius, found.vertical / kVolume.half_height);
    // Samples are 5 ms apart: up to 0.6 m at 240 m/s.
    EXPECT_LE(said, least * (1 + 1e-6) + 1e-6) << i;
    EXPECT_GE(said, least - 0.05) << i;
    EXPECT_NEAR(size(a.motion(found.time).position - b.motion(found.time).position, kVolume), said, 1e-9);
    if (least < 1) {
      EXPECT_EQ(found.entered, Entered::yes) << i;
    }
    if (least > 1.05) {
      EXPECT_EQ(found.entered, Entered::no) << i;
    }
    entered += found.entered == Entered::yes;
    undecided += found.entered == Entered::undecided;
  }
  EXPECT_GT(entered, 10);
  EXPECT_EQ(undecided, 0);
}

TEST(Encounters, NearnessOfStraightTracksIsInClosedForm) {
  const auto straight = [](const Vector3d& from, const Vector3d& velocity) {
    Track track(ShapeInTime(), {from, velocity, Eigen::Matrix3d::Identity()}, Orientation::fixed, 0);
    track.advance(Vector3d::Zero(), 40);
    return track;
  };
  const Track agent = straight(Vector3d::Zero(), {100, 0, 0});
  // Passes at 152 m across and level: within; at 153 m: not; 31 m above: not; at the surface: cannot be told.
  const auto beside = [&](double across, double up) {
    return nearness(agent, straight({2000, across, up}, {0, 0, 0}), 0, 40, kVolume);
  };
  EXPECT_EQ(beside(152, 0).entered, Entered::yes);
  EXPECT_EQ(beside(152, 30).entered, Entered::yes);
  EXPECT_EQ(beside(153, 0).entered, Entered::no);
  EXPECT_EQ(beside(0, 31).entered, Entered::no);
  EXPECT_EQ(beside(152.4, 0).entered, Entered::undecided);
  EXPECT_NEAR(beside(152, 0).time, 20, 1e-9);
  // From end to end of what doubles have, and so far out that their digits are larger than the volume.
  EXPECT_EQ(nearness(straight({-1.7e308, 0, 0}, {8.5e306, 0, 0}), agent, 0, 40, kVolume).entered,
            Entered::undecided);
  EXPECT_EQ(nearness(straight({1e20, 0, 0}, {0, 0, 0}), straight({1e20, 200, 0}, {0, 0, 0}), 0, 40, kVolume)
                .entered,
            Entered::undecided);
  EXPECT_EQ(nearness(straight({1e307, 0, 0}, {0, 0, 0}), agent, 0, 40, kVolume).entered, Entered::no);
  EXPECT_NEAR(beside(152, 3).horizontal, 152, 1e-9);
  EXPECT_NEAR(beside(152, 3).vertical, 3, 1e-12);
  // Descending through its level 300 m before it: horizontally 300 m then, vertically 0; nearest in between.
  const Nearness steep = nearness(agent, straight({2000, 0, 170}, {0, 0, -10}), 0, 40, kVolume);
  EXPECT_EQ(steep.entered, Entered::yes);
  EXPECT_NEAR(steep.horizontal / kVolume.radius, steep.vertical / kVolume.half_height, 1e-9);
}

TEST(Encounters, IntervalsOfRiskRatiosHold) {
  // Both with 2 %, the first alone 0.4 %, the second alone 3 %; weights of 0.2 to 3 that go with the outcome.
  constexpr int kCampaigns = 400, kCount = 1000;
  int ratios = 0, shares = 0;
  const auto weight_of = [](double v) { return 0.2 + 2.8 * v * v; };
  // E[w] = 0.2 + 2.8 / 3, independent of the outcome.
  const double mean = 0.2 + 2.8 / 3;
  for (int c = 0; c < kCampaigns; ++c) {
    std::vector<Entered> first, second;
    std::vector<double> weights;
    for (int i = 0; i < kCount; ++i) {
      Random random(std::uint64_t(c) + 1, std::uint64_t(i));
      const double u = random.uniform();
      weights.push_back(weight_of(random.uniform()));
      first.push_back(u < 0.024 ? Entered::yes : Entered::no);
      second.push_back(u < 0.02 || (u >= 0.024 && u < 0.054) ? Entered::yes : Entered::no);
    }
    const RiskRatio ratio = risk_ratio(first, second, weights, 3);
    ratios += ratio.bounds.low <= 0.024 / 0.05 && 0.024 / 0.05 <= ratio.bounds.high;
    const Risk risk = risk_of(first, weights, mean, 3);
    shares += risk.bounds.low <= 0.024 && 0.024 <= risk.bounds.high;
    EXPECT_LE(ratio.bounds.low, ratio.ratio);
    EXPECT_GE(ratio.bounds.high, ratio.ratio);
  }
  const int enough = int(0.95 * kCampaigns - 3 * std::sqrt(0.05 * 0.95 * kCampaigns));
  EXPECT_GE(ratios, enough);
  EXPECT_GE(shares, enough);
}

TEST(Encounters, WhatIsUndecidedNarrowsNothing) {
  const std::vector<double> weights(200, 1);
  std::vector<Entered> first(200, Entered::no), second(200, Entered::no);
  for (int i = 0; i < 20; ++i) second[i] = Entered::yes;
  for (int i = 0; i < 5; ++i) first[i] = Entered::yes;
  const RiskRatio sure = risk_ratio(first, second, weights, 1);
  EXPECT_DOUBLE_EQ(sure.ratio, 0.25);
  first[7] = second[30] = Entered::undecided;
  const RiskRatio unsure = risk_ratio(first, second, weights, 1);
  EXPECT_LT(unsure.bounds.low, sure.bounds.low);
  EXPECT_GT(unsure.bounds.high, sure.bounds.high);
  // Nothing seen under the second: no bound above.
  const std::vector<Entered> none(200, Entered::no);
  EXPECT_TRUE(std::isnan(risk_ratio(none, none, weights, 1).ratio));
  EXPECT_TRUE(std::isinf(risk_ratio(first, none, weights, 1).bounds.high));
}

TEST(Encounters, ScenariosFlyTheirTables) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("vericone-encounters-" + std::to_string(getpid()) + ".csv");
  std::ofstream(file)
      << "encounter,body,weight,t [s],x [m],y [m],z [ft]\n"
         "7,agent,2,0,0,0,0\n7,agent,2,30,3000,0,0\n"
         "7,obstacle,2,0,3000,100,100\n7,obstacle,2,10,2000,150,100\n7,obstacle,2,30,500,100,200\n";
  simulation::Scenario scenario;
  scenario.bodies.resize(2);
  for (simulation::Body& body : scenario.bodies)
    body.shape = simulation::RigidShape{CombinedEllipsoid(Ellipsoid())};
  scenario.bodies[0].name = "agent";
  scenario.bodies[1].name = "obstacle";
  const EncounterSet set = read_encounters(file, scenario);
  std::filesystem::remove(file);
  ASSERT_EQ(set.count, 1U);
  const FlownEncounter one = set.at(0);
  EXPECT_EQ(one.weight, 2);
  EXPECT_EQ(one.duration, 30);
  const simulation::Run run = simulate(on_encounter(scenario, one, false));
  EXPECT_NEAR((run.tracks[0].motion(30).position - Vector3d(3000, 0, 0)).norm(), 0, 1e-9);
  for (const auto& [t, place] :
       {std::pair(0.0, Vector3d(3000, 100, 30.48)), std::pair(10.0, Vector3d(2000, 150, 30.48)),
        std::pair(30.0, Vector3d(500, 100, 60.96))})
    EXPECT_NEAR((run.tracks[1].motion(t).position - place).norm(), 0, 1e-6) << t;
  // Catmull and Rom: from the neighbour before to the one after.
  EXPECT_NEAR((run.tracks[1].motion(10).velocity - Vector3d(-2500.0 / 30, 0, 1.016)).norm(), 0, 1e-6);
}

}  // namespace
}  // namespace vericone::encounters_test
