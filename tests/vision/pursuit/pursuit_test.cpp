// SPDX-License-Identifier: BSD-3-Clause
//
// Pursuits in closed loop: exact states against the figures of errata 4.3, and from pixels.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/simulation/run_tables.h>
#include <vericone/simulation/run_tables.h>
#include <vericone/vision/pursuit/pursuit.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

#include "vision/pursuit/printed_pursuits.h"

namespace vericone::vision::testing::pursuit_test {

using Eigen::Vector2d;

Pursuit exact(Pursuit p, Whose law) {
  p.eyes = Eyes::exact;
  p.law = law;
  return p;
}

Pursuit seen(Pursuit p, Eyes eyes, double duration) {
  p.eyes = eyes;
  p.duration = duration;
  return p;
}

/// Mean distances of 40 starts within 1 mm, sorted.
std::vector<double> forty_starts(const Pursuit& pursuit) {
  std::mt19937_64 random(7);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * double(random() >> 11) * 0x1p-53;
  };
  std::vector<double> means;
  for (int i = 0; i < 40; ++i) {
    Pursuit one = pursuit;
    const double angle = uniform(-3.2, 3.2), far = i == 0 ? 0 : uniform(0, 1e-3);
    one.start.position.head<2>() += far * Vector2d(std::cos(angle), std::sin(angle));
    means.push_back(summarise(one, pursue(one)).mean_distance);
  }
  std::sort(means.begin(), means.end());
  return means;
}

TEST(PursuitExact, TheSourcesLawAsErrataHaveItAndOursNearerAndNotChaotic) {
  struct Row {
    Pursuit pursuit;
    double low, high;
  };
  for (const Row& row : {Row{lanes(), 1.5, 3}, Row{squircle(), 4.5, 7}}) {
    SCOPED_TRACE(row.pursuit.name);
    const std::vector<double> source = forty_starts(exact(row.pursuit, Whose::source)),
                              ours = forty_starts(exact(row.pursuit, Whose::ours));
    EXPECT_GT(source[20], row.low);
    EXPECT_LT(source[20], row.high);
    EXPECT_GT(source.back() - source.front(), 0.5);  // chaotic
    EXPECT_LT(ours.back(), 0.1 * source.front());
    EXPECT_LT(ours.back() - ours.front(), 0.01);
  }
}

TEST(PursuitExact, TheBoundaryLayerSpeaksAboutHalfOfTheTimeAndOursNeverNeedsOne) {
  for (const Pursuit& pursuit : {three_lanes(), three_squircles()}) {
    SCOPED_TRACE(pursuit.name);
    const PursuitRun source = pursue(exact(pursuit, Whose::source)),
                     ours = pursue(exact(pursuit, Whose::ours));
    EXPECT_GT(source.layer_share, 0.4);
    EXPECT_EQ(ours.layer_share, 0);
    const PursuitSummary of_source = summarise(pursuit, source), of_ours = summarise(pursuit, ours);
    EXPECT_LT(of_ours.mean_distance, 0.1 * of_source.mean_distance);
    EXPECT_LT(of_ours.mean_speed_error, of_source.mean_speed_error);
  }
}

TEST(PursuitExact, AQuadrotorWithoutAVerticalLawKeepsItsAltitude) {
  Pursuit pursuit = exact(three_lanes(), Whose::ours);
  pursuit.vertical.reset();
  pursuit.duration = 30;
  const PursuitRun run = pursue(pursuit);
  for (const PursuitSample& sample : run.samples)
    EXPECT_NEAR(sample.uas.position.z(), pursuit.start.position.z(), 5) << sample.t;
  EXPECT_NEAR(run.samples.back().uas.position.z(), pursuit.start.position.z(), 0.1);
}

void expect_followed(const Pursuit& pursuit, const PursuitRun& run, double pixels) {
  for (const CarSummary& car : summarise(pursuit, run).cars) {
    SCOPED_TRACE(car.name);
    EXPECT_TRUE(car.followed);
    EXPECT_EQ(car.swaps, 0U);
    EXPECT_LT(car.pixels_rms, pixels);
  }
}

TEST(PursuitFromPixels, ThroughTheFirstBarsByBothCameras) {
  for (const Eyes eyes : {Eyes::source, Eyes::perspective}) {
    SCOPED_TRACE(to_string(eyes));
    const Pursuit pursuit = seen(lanes(), eyes, 12);
    const PursuitRun run = pursue(pursuit);
    expect_followed(pursuit, run, 1.5);
    EXPECT_GT(run.hidden.size(), 0U);
    for (const HiddenTime& hidden : run.hidden) {
      ASSERT_TRUE(hidden.said);
      EXPECT_LE(*hidden.said, 3 * pursuit.picture_step);
      if (hidden.to >= 0 && hidden.to < run.end - 0.5) {
        EXPECT_THAT(hidden.regained, ::testing::Optional(::testing::Le(0.5)));
      }
    }
  }
}

TEST(PursuitFromPixels, ThreeVehiclesFromAQuadrotorByBothCameras) {
  for (const Eyes eyes : {Eyes::source, Eyes::perspective}) {
    SCOPED_TRACE(to_string(eyes));
    const Pursuit pursuit = seen(three_lanes(), eyes, 6);
    expect_followed(pursuit, pursue(pursuit), 1.5);
  }
}

TEST(PursuitFromPixels, IdenticalDecoysBesideAreNotFollowed) {
  Pursuit pursuit = seen(three_lanes(), Eyes::perspective, 6);
  for (std::size_t i = 0; i < 3; ++i) {
    Car decoy = pursuit.cars[i];
    decoy.name += "'";
    decoy.followed = false;
    decoy.road =
        simulation::lane_road(pursuit.cars[i].road->at(0).position + Vector2d(-14, 5), {22.22, 0}, {});
    pursuit.cars.push_back(decoy);
  }
  expect_followed(pursuit, pursue(pursuit), 1.5);
}

TEST(PursuitFromPixels, TheSameTwice) {
  const Pursuit pursuit = seen(lanes(), Eyes::perspective, 3);
  const PursuitRun one = pursue(pursuit), two = pursue(pursuit);
  ASSERT_EQ(one.samples.size(), two.samples.size());
  for (std::size_t i = 0; i < one.samples.size(); ++i) {
    EXPECT_EQ(one.samples[i].cars[0].belief.mean, two.samples[i].cars[0].belief.mean);
    EXPECT_EQ(one.samples[i].uas.position, two.samples[i].uas.position);
  }
}

/// What it believes is made of pictures and own states: the same pictures give the same, without the pursuit.
TEST(PursuitFromPixels, NothingOfTheTruthReachesTheEstimates) {
  const Pursuit pursuit = seen(lanes(), Eyes::source, 5);
  std::vector<Image> pictures;
  std::vector<std::vector<guidance::Belief<6>>> beliefs;
  PursuitOptions options;
  options.picture = [&](const Image& image, const PursuitSample&, const std::vector<Followed>& vehicles) {
    pictures.push_back(image);
    beliefs.emplace_back();
    for (const Followed& one : vehicles) beliefs.back().push_back(one.filter.belief());
  };
  const PursuitRun run = pursue(pursuit, options);
  TrackerOptions tracking;
  tracking.frame_seconds = pursuit.picture_step;
  Perception perception(perception_of(pursuit), tracker(tracking));
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const PursuitSample& sample = run.samples[i];
    if (i == 0)
      perception.start(pictures[i], sample.camera, sample.camera_time, run.boxes);
    else
      perception.step(pictures[i], sample.camera, sample.camera_time);
    for (std::size_t k = 0; k < beliefs[i].size(); ++k) {
      EXPECT_EQ(perception.vehicles()[k].filter.belief().mean, beliefs[i][k].mean);
      EXPECT_EQ(perception.vehicles()[k].filter.belief().covariance, beliefs[i][k].covariance);
    }
  }
}

TEST(PursuitFromPixels, ClimbsWhileAVehicleIsHidden) {
  Pursuit pursuit = seen(three_lanes(), Eyes::perspective, 12);
  pursuit.start.position = {100, -135, 200};
  pursuit.start.velocity = {22.22, 0, 0};
  const auto climbed = [&](bool roof) {
    Pursuit one = pursuit;
    if (roof)  // over all of B2's way from 3 s on
      one.perspective_view.scene.occluders = {{{500, -120}, {2 * (400 - 3 * 22.22), 8}, 5, 5}};
    const PursuitRun run = pursue(one);
    return run.samples.back().uas.position.z();
  };
  EXPECT_GT(climbed(true), climbed(false) + 5);
}

TEST(PursuitFromPixels, AVehicleThatIsLostForGoodIsLeftOut) {
  Pursuit pursuit = seen(three_lanes(), Eyes::perspective, 12);
  pursuit.start.position = {100, -135, 200};
  pursuit.start.velocity = {22.22, 0, 0};
  pursuit.give_up = 4;
  pursuit.perspective_view.scene.occluders = {{{500, -120}, {2 * (400 - 3 * 22.22), 8}, 5, 5}};
  const PursuitRun run = pursue(pursuit);
  // The ellipse holds the other two alone: B2 is 30 m and 15 m beside them.
  EXPECT_LT(run.samples.back().ellipse.centre.y(), -136);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(run.samples.back().cars[k].sighting.measured, k != 1);
}

/// A camera fixed in the body would lose what is below it at 3.7 m/s^2 sideways.
TEST(PursuitFromPixels, AStrapdownCameraKeepsTheVehiclesInItsPicture) {
  Pursuit pursuit = seen(three_lanes(), Eyes::perspective, 10);
  pursuit.start.position = {60, -100, 425};
  pursuit.perspective_view.mount.kind = MountKind::strapdown;
  const PursuitRun run = pursue(pursuit);
  for (const PursuitSample& sample : run.samples)
    for (const CarSample& car : sample.cars) EXPECT_GT(car.seen.visible, 0.99) << sample.t;
  const auto off = [](const PursuitSample& sample) {
    return (sample.true_ellipse.centre - sample.uas.position.head<2>()).norm();
  };
  EXPECT_LT(off(run.samples.back()), off(run.samples.front()));
}

TEST(PursuitFromPixels, OldPicturesAreSeenAsOld) {
  Pursuit pursuit = seen(three_lanes(), Eyes::source, 5);
  pursuit.source_view.latency = 0.12;
  const PursuitRun run = pursue(pursuit);
  ASSERT_FALSE(run.samples.empty());
  EXPECT_NEAR(run.samples.front().t, 0.12, 1e-9);
  for (const PursuitSample& sample : run.samples) EXPECT_NEAR(sample.t - sample.camera_time, 0.12, 1e-9);
  expect_followed(pursuit, run, 1.5);
}

/// With the shutter open for long, what moves in the picture is drawn out: grey levels next to each other
/// differ less.
TEST(PursuitFromPixels, AnExposureBlursByTheCamerasOwnMotion) {
  const auto roughness = [](double exposure) {
    Pursuit pursuit = seen(three_lanes(), Eyes::perspective, 0.4);
    pursuit.perspective_view.mount.kind = MountKind::north_up;  // the ground passes below at 31 m/s
    pursuit.perspective_view.scene.noise = 0;
    pursuit.perspective_view.scene.exposure = exposure;
    double sum = 0;
    PursuitOptions options;
    options.picture = [&](const Image& image, const PursuitSample&, const std::vector<Followed>&) {
      sum = 0;
      for (std::size_t i = 1; i < image.data.size(); ++i)
        sum += std::abs(int(image.data[i]) - int(image.data[i - 1]));
    };
    static_cast<void>(pursue(pursuit, options));
    return sum;
  };
  EXPECT_LT(roughness(0.03), 0.95 * roughness(0));
}

/// The flight is a run like others: with tracks, tables and proofs.
TEST(PursuitExact, ItsFlightIsProved) {
  Pursuit pursuit = exact(lanes(), Whose::ours);
  pursuit.duration = 6;
  pursuit.source_steps = false;
  PursuitOptions options;
  int told = 0;
  std::vector<PursuitSample> samples;
  options.flown = [&](const simulation::Scenario& scenario, const simulation::Run& run) {
    ++told;
    ASSERT_EQ(run.tracks.size(), 1 + pursuit.cars.size());
    EXPECT_EQ(run.tracks[0].end(), 6);
    const double below = pursuit.start.position.z() - pursuit.cars[0].look.size.z() - pursuit.radius;
    for (const simulation::PairOutcome& pair : run.proofs) {
      EXPECT_EQ(pair.proof.verdict, simulation::ProofVerdict::avoided);
      EXPECT_GT(pair.proof.least_distance, pair.a == 0 ? 0.99 * below : 0);
    }
    const simulation::Table bodies = simulation::bodies_table(scenario, run);
    EXPECT_EQ(bodies.rows(), (1 + std::size_t(std::lround(6 / pursuit.step))) * run.tracks.size());
    for (const double t : {0.0, 2.0, 6.0}) {
      samples.emplace_back().t = t;
      samples.back().uas = run.tracks[0].motion(t);
    }
  };
  const PursuitRun run = pursue(pursuit, options);
  ASSERT_EQ(told, 1);
  for (const PursuitSample& flown : samples) {
    const auto same = std::find_if(run.samples.begin(), run.samples.end(), [&](const PursuitSample& sample) {
      return std::abs(sample.t - flown.t) < 1e-9;
    });
    ASSERT_NE(same, run.samples.end());
    EXPECT_LT((same->uas.position - flown.uas.position).norm(), 1e-9);
    EXPECT_LT((same->uas.velocity - flown.uas.velocity).norm(), 1e-9);
  }
  pursuit.source_steps = true;
  EXPECT_THROW(pursue(pursuit, options), InputError);
}

TEST(PursuitRefuses, WhatItCannotFly) {
  Pursuit pursuit = lanes();
  pursuit.picture_step = 0.25;
  EXPECT_THROW(pursue(pursuit), InputError);
  pursuit = lanes();
  pursuit.cars[0].followed = false;
  EXPECT_THROW(pursue(pursuit), InputError);
  pursuit = seen(lanes(), Eyes::source, 1);
  pursuit.start.position = {500, 0, 150};
  EXPECT_THROW(pursue(pursuit), InputError);  // nothing to see
}

/// All of the printed runs, to their ends.
TEST(PursuitLong, FollowedToTheEndByBothCameras) {
  const char* campaign = std::getenv("VERICONE_CAMPAIGN");
  if (campaign == nullptr) GTEST_SKIP() << "a campaign: with VERICONE_CAMPAIGN=long";
  for (const Pursuit& pursuit : {lanes(), squircle(), three_lanes(), three_squircles()})
    for (const Eyes eyes : {Eyes::source, Eyes::perspective}) {
      SCOPED_TRACE(pursuit.name + " " + to_string(eyes));
      const Pursuit whole = seen(pursuit, eyes, pursuit.duration);
      const PursuitRun run = pursue(whole);
      expect_followed(whole, run, 1.5);
      for (const CarSummary& car : summarise(whole, run).cars) EXPECT_TRUE(car.in_view) << car.name;
    }
}

}  // namespace vericone::vision::testing::pursuit_test
