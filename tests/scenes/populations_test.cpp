// SPDX-License-Identifier: BSD-3-Clause
//
// Populations: what is drawn against its densities, shares against closed forms, intervals by how often they
// hold.
#include "scenarios/populations/population.h"

#include <gtest/gtest.h>
#include <unistd.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/random_engagement.h>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "scenarios/populations/estimate.h"
#include "scenarios/populations/read_population.h"

namespace vericone::populations_test {
namespace {

using namespace populations;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;

Ellipsoid ball(const Vector3d& center, double radius) {
  return Ellipsoid::from_axes(center, Vector3d::Constant(radius));
}

/// Balls of 1 m and 2 m, 1000 m apart along x; the agent flies along x.
Population balls() {
  Population population;
  population.scene.agent.placed = Body(ball(Vector3d::Zero(), 1));
  population.scene.obstacle.placed = Body(ball({1000, 0, 0}, 2));
  population.scene.agent.velocity = {100, 0, 0};
  return population;
}
constexpr double kRadius = 3;

/// The obstacle off the agent's way by independent normal numbers: the share is 1 - exp(-r^2 / (2 s^2)).
Population off_the_way(double share, double proposal) {
  const double deviation = kRadius / std::sqrt(-2 * std::log1p(-share));
  Population population = balls();
  const DistributionPtr drawn = normal(0, deviation), instead = proposal > 0 ? normal(0, proposal) : nullptr;
  population.variables = {{true, Quantity::y, drawn, instead}, {true, Quantity::z, drawn, instead}};
  return population;
}

Population uniform_directions() {
  Population population = balls();
  population.variables = {{false, Quantity::course, uniform(-kPi, kPi), nullptr},
                          {false, Quantity::climb, elevation(-kPi / 2, kPi / 2), nullptr}};
  return population;
}

double simpson(const Distribution& of, double from, double to) {
  constexpr int kSteps = 4000;
  double sum = 0;
  for (int i = 0; i <= kSteps; ++i)
    sum += std::exp(of.log_density(from + (to - from) * i / kSteps)) * (i % kSteps == 0 ? 1 : i % 2 ? 4 : 2);
  return sum * (to - from) / (3 * kSteps);
}

TEST(Populations, NumbersAreThoseOfEachGenerator) {
  using engagements::Random;
  std::vector<double> filled(100);
  for (const std::uint64_t seed : {std::uint64_t(1), ~std::uint64_t(7)})
    for (const std::uint64_t number : {0, 1, 5}) {
      Random::fill(seed, 1'000'000'000'000, number, filled);
      for (std::size_t i = 0; i < filled.size(); ++i) {
        Random one(seed, 1'000'000'000'000 + i);
        for (std::uint64_t k = 0; k < number; ++k) one.uniform();
        // The first 52 of its 53 bits, in the middle of what they leave.
        EXPECT_EQ(filled[i], (std::floor(one.uniform() * 0x1p52) + 0.5) * 0x1p-52);
      }
    }
}

TEST(Populations, NormalQuantilesAreThoseOfBoost) {
  const boost::math::normal_distribution<> standard;
  for (double p = 0x1p-53; p < 1; p = p < 0.01 ? p * 1.7 : p + 0.003) {
    const double z = quantile(standard, p);
    EXPECT_NEAR(normal_quantile(p), z, 4e-15 * std::max(1.0, std::abs(z))) << p;
    double x = 0;
    normal(10, 2)->quantiles({&p, 1}, &x);
    EXPECT_NEAR(x, 10 + 2 * z, 2e-14 * std::max(1.0, std::abs(z))) << p;
  }
}

TEST(Populations, ManyQuantilesAreThoseOfEach) {
  std::vector<double> p(5000), x(p.size());
  engagements::Random::fill(3, 0, 0, p);
  p[7] = 0x1p-53;  // far out, and its mirror image
  p[600] = 1 - 0x1p-53;
  normal(10, 2)->quantiles(p, x.data());
  for (std::size_t i = 0; i < p.size(); ++i) EXPECT_EQ(x[i], 10 + 2 * normal_quantile(p[i])) << p[i];
}

TEST(Populations, QuantilesAreThoseOfTheDensity) {
  const std::vector<std::pair<DistributionPtr, double>> all{
      {uniform(-1, 3), -1},           {normal(2, 0.5), 2 - 4.5},  {elevation(-0.3, 1.2), -0.3},
      {von_mises(0.5, 0), 0.5 - kPi}, {von_mises(1, 3), 1 - kPi}, {von_mises(3, 50), 3 - 1.6},
      {von_mises(3, 1e6), 3 - 0.01},  {von_mises(3, 18), 3 - kPi}};
  for (const auto& [of, from] : all)
    for (const double u : {1e-3, 0.02, 0.3, 0.5, 0.6, 0.999}) {
      double x = 0;
      of->quantiles({&u, 1}, &x);
      EXPECT_NEAR(simpson(*of, from, x), u, 5e-6) << u << " of " << &of - &all[0].first;
    }
  // Exactly, of a histogram.
  const DistributionPtr histogram = table({0, 1, 2, 4, 5}, {1, 0, 2, 1});
  const double u[] = {0.125, 0.25 + 1e-9, 0.5, 0.75, 0.875};
  double x[5];
  histogram->quantiles(u, x);
  EXPECT_NEAR(x[0], 0.5, 1e-15);
  EXPECT_NEAR(x[1], 2, 1e-8);
  EXPECT_NEAR(x[2], 3, 1e-15);
  EXPECT_NEAR(x[3], 4, 1e-15);
  EXPECT_NEAR(x[4], 4.5, 1e-15);
  EXPECT_NEAR(std::exp(histogram->log_density(3)), 0.25, 1e-15);
  EXPECT_EQ(std::exp(histogram->log_density(1.5)), 0);
  EXPECT_EQ(std::exp(histogram->log_density(6)), 0);
}

void expect_share(const Population& population, double share, std::uint64_t count) {
  const Estimate found = estimate_of(Sampler(population).tally(1, 0, count), population);
  EXPECT_NEAR(found.share, share, 4 * std::sqrt(share * (1 - share) / double(count)));
  EXPECT_LT(found.low, found.share);
  EXPECT_GT(found.high, found.share);
  EXPECT_LT(found.high - found.low, 6 * std::sqrt(share / double(count)));
}

/// A scene in the plane, as its file gives it.
Population flat(const std::string& agent, const std::string& obstacle) {
  Population population;
  population.scene = scenes::scene_of_text(
      "agent: " + agent + "\nobstacle: " + obstacle + "\nagent_velocity: [10, 0]\n", "flat.yaml");
  return population;
}

TEST(Populations, SharesInThePlaneAreThoseOfClosedForms) {
  const boost::math::normal_distribution<> standard;
  // Off the way by a normal number: within the sum of the half widths.
  const double share = 2 * cdf(standard, 2.5 / 4) - 1;
  for (const char* obstacle :
       {"{center: [50, 0], semi_axes: [2, 1.5]}", "{polygon: [[50, -1.5], [53, 1], [51, 1.5]]}"}) {
    Population off = flat("{center: [0, 0], semi_axes: [3, 1]}", obstacle);
    off.variables = {{true, Quantity::y, normal(0, 4), nullptr}};
    expect_share(off, share, 20'000);
  }
  // A disc that flies anywhere: within the half angle asin((1 + 2) / 50) of the line of centres; turned, that
  // is no other.
  Population anywhere = flat("{center: [0, 0], semi_axes: [1, 1]}", "{center: [30, 40], semi_axes: [2, 2]}");
  anywhere.variables = {{false, Quantity::course, uniform(-kPi, kPi), nullptr}};
  expect_share(anywhere, std::asin(0.06) / kPi, 1'000'000);
  anywhere.variables.push_back({true, Quantity::yaw, uniform(-kPi, kPi), nullptr});
  expect_share(anywhere, std::asin(0.06) / kPi, 20'000);
  // A needle's half width seen along the way, by its heading: the mean over headings of a numerical integral.
  Population needle = flat("{center: [0, 0], semi_axes: [1, 1]}", "{center: [50, 0], semi_axes: [6, 0.5]}");
  needle.variables = {{true, Quantity::yaw, uniform(0, kPi), nullptr},
                      {true, Quantity::y, uniform(-10, 10), nullptr}};
  double mean = 0;
  constexpr int kSteps = 1000;
  for (int i = 0; i < kSteps; ++i)
    mean += std::hypot(6 * std::sin(kPi * (i + 0.5) / kSteps), 0.5 * std::cos(kPi * (i + 0.5) / kSteps));
  expect_share(needle, (1 + mean / kSteps) / 10, 20'000);
  // What would lift a body out of the plane, or make it longer than it is high, is refused by its name.
  for (const Quantity what :
       {Quantity::z, Quantity::pitch, Quantity::roll, Quantity::a, Quantity::vz, Quantity::climb}) {
    Population wrong = needle;
    wrong.variables[0].what = what;
    try {
      (void)Sampler(wrong);
      ADD_FAILURE() << to_string(what);
    } catch (const InputError& e) {
      EXPECT_EQ(e.field(), std::string("drawn.obstacle.") + to_string(what));
    }
  }
}

TEST(Populations, SharesAreThoseOfClosedForms) {
  // Directions within the cone of half-angle asin(r / d).
  expect_share(uniform_directions(), 0.5 * (1 - std::sqrt(1 - 9e-6)), 10'000'000);
  expect_share(off_the_way(0.1, 0), 0.1, 100'000);
  // A heading about x, in the plane.
  Population heading = balls();
  heading.variables = {{false, Quantity::course, von_mises(0, 2000), nullptr}};
  const double half = std::asin(0.003);
  double all = 0, within = 0;
  constexpr int kSteps = 20'000;
  for (int i = 0; i < kSteps; ++i) {
    const double x = 0.5 * (i + 0.5) / kSteps, density = std::exp(2000 * (std::cos(x) - 1));
    all += density;
    within += density * (x < half);
  }
  expect_share(heading, within / all, 300'000);
  // Within a time: the nearest of the two balls' distance, 997 m, is flown in 9.97 s at 100 m/s.
  Population in_time = balls();
  in_time.variables = {{false, Quantity::speed, uniform(50, 150), nullptr}};
  in_time.within = 9.97;
  expect_share(in_time, 0.5, 20'000);
  // Semi-axes: the obstacle's third one reaches down to the way.
  Population grown = balls();
  grown.scene.obstacle.placed = Body(Ellipsoid::from_axes({1000, 0, 11}, {2, 2, 2}));
  grown.variables = {{true, Quantity::c, uniform(5, 15), nullptr}};
  expect_share(grown, 0.5, 20'000);
  // Turned: a long body 11 m beside the way reaches it where it points to it, |sin(yaw)| 20 > 10 or so.
  Population turned = balls();
  turned.scene.obstacle.placed = Body(Ellipsoid::from_axes({1000, 11, 0}, {20, 1e-3, 1e-3}));
  turned.variables = {{true, Quantity::yaw, uniform(-kPi, kPi), nullptr}};
  expect_share(turned, 2 * (kPi / 2 - std::asin(0.5)) / kPi, 20'000);
}

TEST(Populations, BatchesAreTheVerdictsOfEachEncounter) {
  Population placed = off_the_way(0.2, 20), fixed = uniform_directions(), hulls = off_the_way(0.3, 0);
  fixed.scene.obstacle.placed = Body(Ellipsoid::from_axes({6, 1, 0}, {4, 2, 3}));
  hulls.scene.obstacle.placed =
      Placed(Body(HullBody({{2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {-2, -2, -2}})), {{1000, 0, 0}});
  fixed.scene.obstacle.velocity = {1, -2, 0.5};
  for (const Population& population : {placed, fixed, hulls}) {
    const Sampler sampler(population);
    constexpr std::uint64_t kCount = 1500, kFirst = 777;
    std::uint64_t in = 0;
    double weight = 0;
    for (std::uint64_t i = kFirst; i < kFirst + kCount; ++i) {
      const Encounter one = sampler.encounter(3, i);
      const bool meets =
          Pair(one.agent, one.obstacle).verdict(one.agent_velocity, one.obstacle_velocity) == Verdict::in;
      in += meets;
      if (meets) weight += one.weight;
    }
    const Tally all = sampler.tally(3, kFirst, kCount);
    EXPECT_EQ(all.in, in);
    EXPECT_EQ(all.sure.sum, weight);
    EXPECT_GT(in, 20U);
    Tally parts = sampler.tally(3, kFirst, 600);
    add(sampler.tally(3, kFirst + 600, 900), parts);
    EXPECT_EQ(parts.in, all.in);
    EXPECT_EQ(parts.encounters, all.encounters);
    EXPECT_NEAR(parts.weight, all.weight, 1e-9 * all.weight);
  }
}

/// Of `seeds` campaigns, how many intervals hold the share that need to have seen what collides; and of those
/// that do not.
std::pair<int, int> held(const Population& population, double share, std::uint64_t count, int seeds) {
  const Sampler sampler(population);
  std::pair<int, int> held{0, 0};
  for (int seed = 1; seed <= seeds; ++seed) {
    const Estimate found = estimate_of(sampler.tally(std::uint64_t(seed), 0, count), population);
    held.first += found.covered.low <= share && share <= found.covered.high;
    held.second += found.low <= share && share <= found.high;
    EXPECT_NEAR(found.mean_weight, 1, 5 * found.mean_weight_error + 1e-12);
  }
  return held;
}

/// No fewer than 95 % less three standard deviations.
int enough(int seeds) { return int(std::floor(0.95 * seeds - 3 * std::sqrt(0.05 * 0.95 * seeds))); }

TEST(Populations, IntervalsOfRareCollisionsHold) {
  // One in a million, from 10^4 encounters with weights: the interval is also short.
  const Population rare = off_the_way(1e-6, kRadius);
  const auto [interval, wide] = held(rare, 1e-6, 10'000, 100);
  EXPECT_GE(interval, enough(100));
  EXPECT_EQ(wide, 100);
  const Estimate one = estimate_of(Sampler(rare).tally(1, 0, 10'000), rare);
  EXPECT_LT(one.covered.high - one.covered.low, 0.12e-6);
  EXPECT_GT(one.low, 0.8e-6);
  EXPECT_LE(one.high, 0.005);
  // One in 10^9.
  EXPECT_GE(held(off_the_way(1e-9, kRadius), 1e-9, 10'000, 100).first, enough(100));
}

TEST(Populations, IntervalsOfFewCollisionsHold) {
  // Without weights, 0 to 5 collisions.
  EXPECT_GE(held(off_the_way(1e-3, 0), 1e-3, 2000, 400).first, enough(400));
  // With unequal weights, of some 2 and some 20 that collide.
  const double far = 30 * kRadius;
  EXPECT_GE(held(off_the_way(1e-4, far), 1e-4, 3000, 400).first, enough(400));
  EXPECT_GE(held(off_the_way(1e-4, 3 * kRadius), 1e-4, 300, 400).first, enough(400));
  EXPECT_GE(held(off_the_way(1e-4, 0.7 * kRadius), 1e-4, 300, 400).first, enough(400));
}

TEST(Populations, IntervalsOfManyVelocitiesOfFewPlacesHold) {
  // The place decides nearly all, so 100 velocities say little more than one.
  Population population = off_the_way(0.05, 0);
  population.variables.push_back({false, Quantity::vy, normal(0, 1e-3), nullptr});
  population.velocities = 100;
  const Tally tally = Sampler(population).tally(1, 0, 200);
  EXPECT_EQ(tally.verdicts, 20'000U);
  EXPECT_EQ(tally.encounters, 200U);
  EXPECT_GE(held(population, 0.05, 200, 200).first, enough(200));
}

TEST(Populations, AProposalThatMissesIsNoticed) {
  // It draws heights above the way alone: half of what collides is left to what is drawn as it is.
  const auto above = [](double share) {
    Population population = off_the_way(share, kRadius);
    population.variables[1].proposal = uniform(0, kRadius);
    return population;
  };
  // Too rare to be among the 1000 of 10^4 that are: nobody can notice it, and the interval holds all the
  // same.
  const auto [covered, whatever] = held(above(1e-5), 1e-5, 10'000, 100);
  EXPECT_LT(covered, 10);
  EXPECT_EQ(whatever, 100);
  // Among them: it is counted.
  EXPECT_EQ(Sampler(off_the_way(0.02, kRadius)).tally(1, 0, 10'000).uncovered, 0U);
  const Tally seen = Sampler(above(0.02)).tally(1, 0, 10'000);
  EXPECT_GT(seen.uncovered, 0U);
  EXPECT_NEAR(double(seen.uncovered), 0.5 * 0.02 * 1000, 4 * std::sqrt(10.0));
  EXPECT_GE(held(above(0.02), 0.02, 2000, 100).second, enough(100));
}

TEST(Populations, BetsAreThoseOfEachObservation) {
  // Few observations of many sizes, without sums: the product of the bets is no less, so the limits hold.
  const std::vector<double> seen{0, 0, 0.3, 0, 10, 0, 2, 0, 0, 0, 1e-3, 0, 0, 5, 0, 0, 0, 0, 0.1, 0};
  Moments moments;
  for (const double x : seen)
    if (x > 0) moments.add(x);
  for (int times : {1, 5, 200}) {
    const Moments many{times * moments.sum, times * moments.squares, moments.largest};
    const Bounds found = betting_bounds(many, std::uint64_t(times) * seen.size(), 10);
    const double mean = many.sum / (times * double(seen.size()));
    EXPECT_LT(found.low, mean);
    EXPECT_GT(found.high, mean);
    const auto won = [&](double m, double scale, double side) {
      double all = 0;
      for (int j = 0; j < 40; ++j) {
        double log = -std::log((j + 1.0) * (j + 2));
        for (const double x : seen) log += times * std::log1p(side * std::ldexp(0.9, -j) / scale * (x - m));
        all += std::exp(std::min(log, 100.0));
      }
      return all;
    };
    if (found.high < 10) EXPECT_GE(won(found.high, 10, -1), 40 * (1 - 1e-9));
    if (found.low > 0) EXPECT_GE(won(found.low, found.low, 1), 40 * (1 - 1e-9));
  }
  // Of nothing seen, by the first bet alone: (1 + 0.9 m / 10)^n / 2 = 40, but for its square.
  const Bounds none = betting_bounds({}, 1'000'000, 10);
  EXPECT_EQ(none.low, 0);
  EXPECT_NEAR(none.high, 10 * std::log(80) / 0.9e6, 1e-9);
}

TEST(Populations, StrataHaveTheSharesOfTheirPopulation) {
  // Heights near the way, of which the population has few, are a third of all encounters.
  Population population = off_the_way(1e-3, 0);
  Population plain = population;
  const double deviation = kRadius / std::sqrt(-2 * std::log1p(-1e-3));
  const auto below = [&](double z) { return 0.5 * std::erfc(-z / deviation / std::numbers::sqrt2); };
  population.strata = Strata{1, {0, below(-kRadius), below(kRadius), 1}};
  EXPECT_NEAR(population.largest_weight(), 3 * below(-kRadius), 1e-12);
  const auto [covered, whatever] = held(population, 1e-3, 3000, 200);
  EXPECT_GE(covered, enough(200));
  EXPECT_GE(whatever, enough(200));
  const Tally tally = Sampler(population).tally(1, 0, 3000);
  EXPECT_NEAR(tally.weight, 3000, 1e-9);
  // 1000 encounters that may collide, where the population has 3000 below(...) = 110.
  EXPECT_GT(tally.in, 4 * Sampler(plain).tally(1, 0, 3000).in);
}

TEST(Populations, GammaBoundsOfEqualObservationsAreThoseOfAPoissonCount) {
  // Garwood (1936): of 3 events 0.6187 to 8.7673, of none 0 to 3.6889.
  const Bounds three = gamma_bounds({3 * 0.5, 3 * 0.25, 0.5}, 1, 7);
  EXPECT_NEAR(three.low, 0.5 * 0.618672, 1e-6);
  EXPECT_NEAR(three.high, 0.5 * 8.767273, 1e-6);
  const Bounds none = gamma_bounds({}, 100, 10);
  EXPECT_EQ(none.low, 0);
  EXPECT_NEAR(none.high, 10 * 3.688879 / 100, 1e-6);
}

TEST(Populations, CorrelationsAreThoseGiven) {
  Population population = balls();
  population.variables = {{true, Quantity::y, normal(5, 2), nullptr},
                          {true, Quantity::z, uniform(-1, 1), nullptr},
                          {false, Quantity::vy, normal(0, 3), nullptr}};
  population.correlated = {{{0, 2}, {{1, 0}, {-0.8, 0.6}}}};
  const Sampler sampler(population);
  constexpr int kCount = 40'000;
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (int i = 0; i < kCount; ++i) {
    const Encounter one = sampler.encounter(1, std::uint64_t(i));
    const Vector3d at = one.obstacle.middle();
    const Vector3d x((at.y() - 5) / 2, at.z() * std::sqrt(3.0), one.agent_velocity.y() / 3);
    moments += x * x.transpose() / kCount;
  }
  Eigen::Matrix3d expected = Eigen::Matrix3d::Identity();
  expected(0, 2) = expected(2, 0) = -0.8;
  EXPECT_LT((moments - expected).cwiseAbs().maxCoeff(), 4 * 1.5 / std::sqrt(double(kCount)));
}

TEST(Populations, FilesSayTheSame) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("vericone-population-" + std::to_string(getpid()) + ".yaml");
  std::ofstream(file) << "agent: {center: [0, 0, 0], semi_axes: [1, 1, 1]}\n"
                         "obstacle: {center: [1 km, 0, 0], semi_axes: [2, 2, 2]}\n"
                         "agent_velocity: [100, 0, 0]\n"
                         "drawn: {obstacle: {y: {normal: [0, 2121.318]}, z: {normal: [0, 2121.318]}}}\n"
                         "proposal: {obstacle: {y: {normal: [0, 3]}, z: {normal: [0, 300 cm]}}}\n";
  const Population read = read_population(file);
  std::filesystem::remove(file);
  const Tally of_file = Sampler(read).tally(5, 0, 2000),
              built = Sampler(off_the_way(1e-6, kRadius)).tally(5, 0, 2000);
  EXPECT_EQ(of_file.in, built.in);
  EXPECT_NEAR(of_file.sure.sum, built.sure.sum, 1e-5 * built.sure.sum);
}

}  // namespace
}  // namespace vericone::populations_test
