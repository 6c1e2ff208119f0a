// SPDX-License-Identifier: BSD-3-Clause
//
// CPA and TCPA, and what the rules call an encounter, against closed forms with 50 digits and angles.
#include <gtest/gtest.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/random_engagement.h>
#include <vericone/ships/ships.h>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <numbers>

namespace vericone::ships::encounter_test {

using Eigen::Vector2d;
using engagements::Random;
using Real = boost::multiprecision::cpp_bin_float_50;

constexpr double kPi = std::numbers::pi;

Vector2d along(double degrees) { return {std::cos(degrees * kPi / 180), std::sin(degrees * kPi / 180)}; }

/// Ahead along her velocity.
Sighting under_way(const Vector2d& position, const Vector2d& velocity) {
  return {position, velocity, velocity};
}

/// Degrees from ahead, to port positive, with 50 digits.
Real bearing(const Vector2d& ahead, const Vector2d& from, const Vector2d& to) {
  const Real x = Real(to.x()) - Real(from.x()), y = Real(to.y()) - Real(from.y());
  const Real p = Real(ahead.x()) * x + Real(ahead.y()) * y, q = Real(ahead.x()) * y - Real(ahead.y()) * x;
  return atan2(q, p) * 180 / boost::math::constants::pi<Real>();
}

/// The rules in angles.
Encounter by_angles(const Sighting& a, const Sighting& b) {
  const Real closing =
      (Real(b.position.x()) - Real(a.position.x())) * (Real(a.velocity.x()) - Real(b.velocity.x())) +
      (Real(b.position.y()) - Real(a.position.y())) * (Real(a.velocity.y()) - Real(b.velocity.y()));
  if (closing <= 0) return Encounter::none;
  const Real of_b = bearing(a.ahead, a.position, b.position), of_a = bearing(b.ahead, b.position, a.position);
  const bool astern_of_a = abs(of_b) > 112.5, astern_of_b = abs(of_a) > 112.5;
  if (astern_of_a && astern_of_b) return Encounter::doubtful;
  if (astern_of_a) return Encounter::overtaken;
  if (astern_of_b) return Encounter::overtaking;
  if (abs(of_b) < 11.25 && abs(of_a) < 11.25) return Encounter::head_on;
  if (of_b.sign() == of_a.sign()) return Encounter::doubtful;
  return of_b.sign() < of_a.sign() ? Encounter::crossing_give_way : Encounter::crossing_stand_on;
}

Encounter seen_from_the_other(Encounter encounter) {
  switch (encounter) {
    case Encounter::overtaking:
      return Encounter::overtaken;
    case Encounter::overtaken:
      return Encounter::overtaking;
    case Encounter::crossing_give_way:
      return Encounter::crossing_stand_on;
    case Encounter::crossing_stand_on:
      return Encounter::crossing_give_way;
    default:
      return encounter;
  }
}

TEST(Encounters, OfTextbooks) {
  // To the north at 6 m/s; the other one on a collision course from a bearing, clockwise from north.
  const Sighting own = under_way({0, 0}, {0, 6});
  const auto from = [](double degrees) -> Vector2d { return 1e4 * along(90 - degrees); };
  EXPECT_EQ(classify(own, under_way(from(0), {0, -6})), Encounter::head_on);
  EXPECT_EQ(classify(own, under_way(from(45), {-6, 0})), Encounter::crossing_give_way);
  EXPECT_EQ(classify(own, under_way(from(-45), {6, 0})), Encounter::crossing_stand_on);
  EXPECT_EQ(classify(own, under_way(from(0), {0, 4})), Encounter::overtaking);
  EXPECT_EQ(classify(own, under_way(from(180), {0, 8})), Encounter::overtaken);
  EXPECT_EQ(classify(own, under_way(from(160), {-3, 9})), Encounter::overtaken);
  EXPECT_EQ(classify(own, under_way(from(90), {-2, 6})), Encounter::crossing_give_way);
  EXPECT_EQ(classify(own, under_way(from(0), {0, 7})), Encounter::none);
  // Starboard to starboard, nearly reciprocal: who turns to starboard crosses the other's bow.
  EXPECT_EQ(classify(own, under_way({500, 2000}, {0, -6})), Encounter::doubtful);
  // Made fast, with her bow to the north: seen from astern she is overtaken.
  EXPECT_EQ(classify(own, {from(0), {0, 0}, {0, 1}}), Encounter::overtaking);
}

TEST(Encounters, AreThoseOfAnglesWithFiftyDigits) {
  Random random(1, 0);
  std::array<int, 7> counts{};
  for (int i = 0; i < 1500; ++i) {
    const Vector2d at(random.uniform(-1e4, 1e4), random.uniform(-1e4, 1e4));
    Sighting a = under_way({random.uniform(-1e4, 1e4), random.uniform(-1e4, 1e4)},
                           random.uniform(1, 10) * along(random.uniform(0, 360)));
    Sighting b = under_way(at, random.uniform(1, 10) * along(random.uniform(0, 360)));
    if (i % 2 == 0) {  // the other one ahead or astern, within rounding of a sector's edge
      const double edge = i % 4 == 0 ? 112.5 : 11.25, side = random.uniform() < 0.5 ? -1 : 1;
      b.position = Vector2d::Zero();
      a.position = 1e3 * along(side * edge);
      b.ahead = Vector2d::UnitX();
      b.velocity = Vector2d(random.uniform(1, 5), 0);
    }
    const Encounter seen = classify(a, b);
    ASSERT_EQ(seen, by_angles(a, b)) << i;
    ASSERT_EQ(classify(b, a), seen_from_the_other(seen)) << i;
    ++counts[static_cast<std::size_t>(seen)];
  }
  for (const int count : counts) EXPECT_GT(count, 10);
}

TEST(Encounters, WhereRoundingCannotDecide) {
  // Pell's numbers: P(k-1) / P(k) is below and above tan 22.5 degrees in turns, and P(k-1)^2 + 2 P(k-1) P(k)
  // - P(k)^2 is 1 or -1.
  double before = 1, now = 2;
  for (int k = 2; k <= 40; ++k) {
    // The bow to the north; the other one `before` astern of the beam and `now` to port.
    const Sighting own = under_way({0, 0}, {0, 1}), other = under_way({-now, -before}, {3, 3});
    ASSERT_EQ(classify(own, other) == Encounter::overtaken, k % 2 == 0) << k;
    ASSERT_EQ(classify(other, own) == Encounter::overtaking, k % 2 == 0) << k;
    const double next = before + 2 * now;
    before = now;
    now = next;
  }
  EXPECT_GT(now, 1e15);
}

TEST(Encounters, EffortsOfAPair) {
  using enum Encounter;
  for (const Encounter encounter : {overtaking, overtaken, crossing_give_way, crossing_stand_on})
    EXPECT_EQ(share_of_effort(encounter) + share_of_effort(seen_from_the_other(encounter)), 1);
  EXPECT_EQ(share_of_effort(head_on), 1);
  EXPECT_EQ(share_of_effort(doubtful), 1);
  EXPECT_EQ(share_of_effort(none), 0);
}

TEST(ClosestApproaches, OfTables) {
  // Own ship to the north at 6 m/s.
  const Sighting own = under_way({0, 0}, {0, 6});
  const struct {
    Sighting other;
    double time, distance;
  } rows[] = {
      {under_way({0, 12000}, {0, -6}), 1000, 0},   {under_way({300, 12000}, {0, -6}), 1000, 300},
      {under_way({6000, 6000}, {-6, 0}), 1000, 0}, {under_way({6000, 0}, {-6, 0}), 500, 3000 * std::sqrt(2)},
      {under_way({0, -1000}, {0, 8}), 500, 0},     {under_way({400, -1000}, {0, 4}), -500, 400},
      {under_way({300, 400}, {0, 6}), 0, 500},
  };
  for (const auto& row : rows) {
    const ClosestApproach found = closest_approach(own, row.other);
    EXPECT_NEAR(found.time, row.time, 1e-12 * std::abs(row.time));
    EXPECT_NEAR(found.distance, row.distance, 1e-12 * row.distance);
  }
}

TEST(ClosestApproaches, OfAnySpeed) {
  const Sighting other = under_way({300, 400}, {0, 0});
  for (const double speed : {1e-170, 1e-155, 1.0, 1e160}) {
    const ClosestApproach found = closest_approach(under_way({0, 0}, {speed, 0}), other);
    EXPECT_NEAR(found.time * speed, 300, 1e-11);
    EXPECT_NEAR(found.distance, 400, 1e-11);
  }
}

TEST(ClosestApproaches, ToRounding) {
  Random random(2, 0);
  for (int i = 0; i < 2000; ++i) {
    Sighting a, b;
    b.position = Vector2d(random.uniform(-1e4, 1e4), random.uniform(-1e4, 1e4));
    // Half of them all but on a collision course, where the products cancel.
    a.velocity = i % 2 == 0 ? Vector2d(b.position * random.uniform(1e-4, 1e-3))
                            : Vector2d(random.uniform(-9, 9), random.uniform(-9, 9));
    const Real x = b.position.x(), y = b.position.y(), u = a.velocity.x(), v = a.velocity.y();
    const Real time = (x * u + y * v) / (u * u + v * v), distance = abs(x * v - y * u) / sqrt(u * u + v * v);
    const ClosestApproach found = closest_approach(a, b);
    ASSERT_LE(abs(Real(found.time) - time), 1e-15 * abs(time)) << i;
    ASSERT_LE(abs(Real(found.distance) - distance), 1e-15 * distance) << i;
    // The exact comparison on either side of the distance.
    const double near = static_cast<double>(distance);
    for (const double d : {std::nextafter(near, 0.0), near, std::nextafter(near, 1e9)})
      ASSERT_EQ(static_cast<int>(compare_approach(a, b, d)), Real(distance - d).sign()) << i;
  }
}

TEST(ClosestApproaches, TouchExactly) {
  const Sighting own = under_way({1e7, 3}, {3, 4});
  const Sighting other = under_way({1e7 + 4, 0}, {0, 0});  // 5 m abeam, in binary numbers
  EXPECT_EQ(compare_approach(own, {other.position, other.velocity, {1, 0}}, 5), Sign::zero);
  EXPECT_EQ(compare_approach(own, {other.position, own.velocity, {1, 0}}, 5), Sign::zero);
  EXPECT_EQ(compare_approach(own, {other.position, own.velocity, {1, 0}}, std::nextafter(5, 0)),
            Sign::positive);
}

TEST(Encounters, RefuseWhatIsNone) {
  const Sighting own = under_way({0, 0}, {0, 6});
  const auto refused = [&](const Sighting& other, const std::string& field) {
    try {
      classify(own, other);
      ADD_FAILURE() << field;
    } catch (const InputError& error) {
      EXPECT_EQ(error.field(), field);
    }
  };
  refused({{1, 1}, {0, 0}, {0, 0}}, "b.ahead");
  refused({{1, NAN}, {0, 0}, {1, 0}}, "b.position");
  refused({{1, 1}, {INFINITY, 0}, {1, 0}}, "b.velocity");
  EXPECT_THROW(compare_approach(own, own, -1), InputError);
}

}  // namespace vericone::ships::encounter_test
