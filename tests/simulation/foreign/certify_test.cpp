// SPDX-License-Identifier: BSD-3-Clause
//
// What is proved of tracks of others, against a march along them that evaluates powers of time in long double
// and asks exact predicates at each step, and against closed forms.
#include <gtest/gtest.h>
#include <vericone/cones/pair.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/simulation/shape_in_time.h>
#include <vericone/simulation/trajectory.h>
#include <array>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

#include "../moving_pairs.h"
#include "support/campaign.h"

namespace vericone::simulation::certify_test {
namespace {

using vericone::testing::campaign_size, vericone::testing::from_environment;

using Powers = std::vector<Vector3d>;

constexpr double kEnd = 2;  // s

/// A body on one polynomial, and its rotation vector another, from t = 0.
struct Flight {
  ShapeInTime shape;
  Powers position, turned;
  Matrix3d rotation = Matrix3d::Identity();
  double changes = 0;  // m/s, what no point of its surface moves more by changing its shape

  [[nodiscard]] static Vector3d value(const Powers& powers, double t) {
    Eigen::Matrix<long double, 3, 1> sum = powers.back().cast<long double>();
    for (std::size_t i = powers.size() - 1; i-- > 0;)
      sum = sum * static_cast<long double>(t) + powers[i].cast<long double>();
    return sum.cast<double>();
  }
  [[nodiscard]] static double fastest(const Powers& powers) {
    double sum = 0;
    for (std::size_t i = 1; i < powers.size(); ++i)
      sum += static_cast<double>(i) * powers[i].norm() * std::pow(kEnd, static_cast<double>(i) - 1);
    return sum;
  }
  [[nodiscard]] WorldBody at(double t) const {
    const Vector3d by = value(turned, t);
    const double angle = by.norm();
    const Matrix3d r = angle > 0 ? Matrix3d(Eigen::AngleAxisd(angle, by / angle) * rotation) : rotation;
    return shape_at(shape, t, value(position, t), r);
  }
  [[nodiscard]] double speed() const { return fastest(position) + fastest(turned) * reach(shape) + changes; }
  [[nodiscard]] TrackedBody tracked(double radius = 0) const {
    TrackedBody body;
    body.shape = shape;
    body.trajectory = Trajectory{
        piecewise_of_powers({0, kEnd}, {position}), piecewise_of_powers({0, kEnd}, {turned}), {rotation}};
    body.radius = radius;
    return body;
  }
};

/// A quintic through `there` at the time `when`.
Powers quintic_through(Random& random, const Vector3d& there, double when, double wild, bool flat) {
  Powers powers(6);
  for (int i = 1; i < 6; ++i) {
    const double size = wild / std::pow(i, 1.5) / std::pow(kEnd, i - 1);
    powers[static_cast<std::size_t>(i)] = flat ? random.flat_vector(size) : random.vector(size);
  }
  powers[0] = Vector3d::Zero();
  powers[0] = there - Flight::value(powers, when);
  return powers;
}

constexpr int kSolids = 9, kFlats = 3;

ShapeInTime solid(Random& random, int kind, double& changes) {
  const Vector3d axes(random.uniform(0.3, 1.5), random.uniform(0.3, 1.5), random.uniform(0.3, 1.5));
  std::vector<Vector3d> points;
  for (int i = 0; i < 8; ++i) points.push_back(random.vector(1.2));
  switch (kind) {
    case 0:
      return ellipsoid(axes);
    case 1:
      return RigidShape{HullBody(points)};
    case 2: {
      const Vector3d half = 0.7 * axes;
      return RigidShape{CombinedEllipsoid(
          Ellipsoid::from_axes(Vector3d::Zero(), axes),
          {{Vector3d(4 / (half.x() * half.x()), -1 / (half.y() * half.y()), -1 / (half.z() * half.z()))
                .asDiagonal(),
            1}})};
    }
    case 3:
      return RigidShape{Placed(Assembly::mesh(points, {{0, 1, 2}, {2, 3, 4}, {4, 5, 6}, {6, 7, 0}}))};
    case 4:
      return RigidShape{Placed(Assembly::cloud(points, 0.3))};
    case 5:
      return RigidShape{
          Placed(Assembly::boxes({{{-1, -1, -0.2}, {1, -0.6, 0.2}}, {{0.5, 0, 0}, {1, 1, 1}}}))};
    case 6:
      return RigidShape{Placed(vericone::Body::pieces(
          {Ellipsoid::from_axes(points[0], 0.6 * axes), Ellipsoid::from_axes(points[1], 0.4 * axes)}))};
    case 7:
      return RigidShape{
          Placed(Assembly::polyhedra({HullBody(std::vector<Vector3d>(points.begin(), points.begin() + 4)),
                                      HullBody(std::vector<Vector3d>(points.begin() + 4, points.end()))}))};
    default: {
      const double rate = random.uniform(0.5, 4);
      changes = 0.4 * rate * axes.maxCoeff() / (2 * std::sqrt(0.1));
      return DentedQuadric{axes, {0.5, 0.4, rate, random.uniform(0, 6), false}};
    }
  }
}

ShapeInTime flat(Random& random, int kind, double& changes) {
  const double a = random.uniform(0.4, 1.5), b = random.uniform(0.4, 1.5);
  switch (kind) {
    case 0:
      return RigidShape{CombinedEllipse(Ellipse::from_axes({0, 0}, {a, b}))};
    case 1:
      return DentedConic{a, b, {0.6, 0, 0, 0, false}};
    default: {
      const double rate = random.uniform(0.5, 4);
      changes = 0.4 * rate * std::max(a, b) / (2 * std::sqrt(0.1));
      return DentedConic{a, b, {0.5, 0.4, rate, random.uniform(0, 6), false}};
    }
  }
}

struct Encounter {
  Flight a, b;
};

Encounter encounter(Random& random, int i) {
  const int kinds = kSolids * kSolids + kFlats * kFlats, pair = 37 * i % kinds;  // 37 has no factor of 90
  const bool plane = pair >= kSolids * kSolids;
  const int first = plane ? (pair - kSolids * kSolids) / kFlats : pair / kSolids,
            second = plane ? (pair - kSolids * kSolids) % kFlats : pair % kSolids;
  const auto flight = [&](int kind, const Vector3d& there, double when, double wild) {
    Flight one;
    one.shape = plane ? flat(random, kind, one.changes) : solid(random, kind, one.changes);
    one.position = quintic_through(random, there, when, wild, plane);
    one.turned = quintic_through(random, Vector3d::Zero(), 0, random.uniform(0, 2), false);
    if (plane)
      for (Vector3d& x : one.turned) x = Vector3d(0, 0, x.z());
    one.rotation = plane ? random.rotation_about_z() : random.rotation();
    return one;
  };
  const double when = random.uniform(0.2, 0.9) * kEnd, miss = random.uniform(0, 7);
  Vector3d aside = plane ? random.flat_vector(1) : random.vector(1);
  aside *= miss / aside.norm();
  return {flight(first, Vector3d::Zero(), when, 6), flight(second, aside, when, 6)};
}

/// Marches from `from` to `until`: no step is longer than what closing speed allows at the distance there is,
/// nor need it be shorter than `least` s. The first time at which they meet.
std::optional<double> first_meeting(const Encounter& pair, double from, double until, double least,
                                    long& steps) {
  const double closing = pair.a.speed() + pair.b.speed();
  for (double t = from; t < until;) {
    ++steps;
    const Pair now = pair_of(pair.a.at(t), pair.b.at(t));
    const auto relation = now.relation();
    if (relation && *relation != Relation::disjoint) return t;
    const double distance = relation ? now.miss(Vector3d::Zero(), Vector3d::Zero()).least : 0;
    t += std::max(least, distance / closing);
  }
  return std::nullopt;
}

double distance(const Encounter& pair, double t) {
  return pair_of(pair.a.at(t), pair.b.at(t)).miss(Vector3d::Zero(), Vector3d::Zero()).most;
}

TEST(Certify, RandomQuinticsOfAllKindsAgainstAMarch) {
  const auto seed = static_cast<unsigned>(from_environment("VERICONE_SEED", 391));
  SCOPED_TRACE("seed " + std::to_string(seed));
  Random random(seed);
  std::array<int, 4> counts{};
  long steps = 0;
  const int count = static_cast<int>(from_environment("VERICONE_CASES", campaign_size(30u, 2000u)));
  for (int i = 0; i < count; ++i) {
    const Encounter pair = encounter(random, i);
    const CertifiedTracks found = certify({pair.a.tracked(), pair.b.tracked()});
    const PairOnTracks& it = found.pairs.at(0);
    ++counts[static_cast<std::size_t>(it.verdict)];
    if (it.verdict == TrackVerdict::apart) {
      EXPECT_FALSE(first_meeting(pair, 0, kEnd, 1e-5, steps)) << i;
      for (int j = 0; j <= 50; ++j) EXPECT_GE(distance(pair, kEnd * j / 50) + 1e-9, it.least_distance) << i;
      EXPECT_GE(distance(pair, it.least_time) + 1e-9, it.least_distance);
    } else if (it.verdict == TrackVerdict::contact) {
      EXPECT_FALSE(first_meeting(pair, 0, it.from, 1e-5, steps)) << i;
      EXPECT_LE(distance(pair, it.to), 1e-8) << i;
      EXPECT_LE(it.from, it.to);
    } else {
      EXPECT_FALSE(first_meeting(pair, 0, it.from, 1e-5, steps)) << i;
    }
  }
  std::cout << count << " pairs: " << counts[3] << " apart, " << counts[0] << " contacts, " << counts[1]
            << " nearer, " << counts[2] << " undecided; " << steps << " steps of the march\n";
  EXPECT_GT(counts[3], count / 10);
  EXPECT_GT(counts[0], count / 10);
  EXPECT_LE(counts[2], 2 + count / 100);
}

/// A ball flies by another straight, but for 1 ms, in which it is 1 mm nearer than they have room for: a
/// cubic bump in a spline, or a bump of degree 9.
TEST(Certify, ADipOfAMillimetreForAMillisecondIsFound) {
  SCOPED_TRACE("seed 392");
  Random random(392);
  int sampled = 0, found = 0;
  const int count = campaign_size(40, 200);
  constexpr double kDeep = 1e-3, kLong = 1e-3, kGap = 0.02;
  for (int i = 0; i < count; ++i) {
    const double when = random.uniform(1, 9);
    // y = 1 + gap, less (gap + deep) u^4 (1 - u)^4 256 over a window in which 1 ms is below 1.
    const double share = kGap / (kGap + kDeep), half = 0.5 * std::sqrt(1 - std::pow(share, 0.25));
    const double window = kLong / (2 * half), begin = when - 0.5 * window;
    const Vector3d across(0, kGap + kDeep, 0), far(0, 1 + kGap, 0);
    const double speed = 0.01;
    const auto along = [&](double t) { return Vector3d(speed * (t - when), 0, 0); };
    Powers bump(9, Vector3d::Zero());
    for (int k = 0; k <= 4; ++k) {
      const double of =
          (k % 2 == 0 ? 1 : -1) * std::array<int, 5>{1, 4, 6, 4, 1}[static_cast<std::size_t>(k)];
      bump[static_cast<std::size_t>(4 + k)] -= 256 * of / std::pow(window, 4 + k) * across;
    }
    bump[0] = along(begin) + far;
    bump[1] = Vector3d(speed, 0, 0);
    TrackedBody flyer, rest;
    flyer.shape = ball(0.5);
    rest.shape = ball(0.5);
    const std::vector<double> times{0, begin, begin + window, 10};
    flyer.trajectory =
        Trajectory{piecewise_of_powers(times, {{along(0) + far, Vector3d(speed, 0, 0)},
                                               bump,
                                               {along(begin + window) + far, Vector3d(speed, 0, 0)}}),
                   {}};
    const PairOnTracks pair = certify({flyer, rest}).pairs.at(0);
    found += pair.verdict == TrackVerdict::contact;
    EXPECT_EQ(pair.verdict, TrackVerdict::contact) << i;
    EXPECT_NEAR(pair.to, when - 0.5 * kLong, 1e-4) << i;
    bool seen = false;
    for (int k = 0; k <= 1000; ++k) seen |= flyer.trajectory->position.at(0.01 * k).norm() <= 1;
    sampled += seen;
    // As deep as that from a required distance.
    CertifyOptions options;
    options.required = kDeep;
    flyer.shape = ball(0.5 - kDeep);
    const PairOnTracks nearer = certify({flyer, rest}, options).pairs.at(0);
    EXPECT_EQ(nearer.verdict, TrackVerdict::nearer) << i;
    EXPECT_NEAR(nearer.to, when - 0.5 * kLong, 1e-4) << i;
  }
  std::cout << count << " dips: " << found << " found; checks at 100 Hz find " << sampled << "\n";
  EXPECT_LT(sampled, count / 2);
}

}  // namespace
}  // namespace vericone::simulation::certify_test
