// SPDX-License-Identifier: BSD-3-Clause
//
// How a ship moves, against small steps of the differential equations, and her tracks against that.
#include "motion.h"

#include <gtest/gtest.h>
#include <vericone/internal/cones/random_engagement.h>
#include <cmath>
#include <numbers>

namespace vericone::ships::motion_test {

using Eigen::Vector2d;
using engagements::Random;

/// x' = u cos psi, y' = u sin psi, psi' = u k, k' = u (r - k) / lag, u' = a, by Runge and Kutta's rule.
State by_small_steps(const Handling& handling, const Piece& piece, double seconds) {
  using Vector = Eigen::Matrix<double, 5, 1>;
  const auto rate = [&](const Vector& x) -> Vector {
    Vector v;
    v << x(4) * std::cos(x(2)), x(4) * std::sin(x(2)), x(4) * x(3),
        x(4) * (piece.command.curvature - x(3)) / handling.lag, piece.command.acceleration;
    return v;
  };
  Vector x;
  x << piece.start.position, piece.start.heading, piece.start.curvature, piece.start.speed;
  constexpr int kSteps = 400;
  const double h = seconds / kSteps;
  for (int k = 0; k < kSteps; ++k) {
    const Vector a = rate(x), b = rate(x + 0.5 * h * a), c = rate(x + 0.5 * h * b), d = rate(x + h * c);
    x += h / 6 * (a + 2 * b + 2 * c + d);
  }
  return {x.head<2>(), x(2), x(4), x(3)};
}

Piece some_piece(const Handling& handling, Random& random) {
  const double most = 1 / handling.radius;
  State start{{random.uniform(-1e4, 1e4), random.uniform(-1e4, 1e4)},
              random.uniform(-3, 3),
              random.uniform(2, 10),
              random.uniform(-most, most)};
  return {start, {random.uniform(-most, most), random.uniform(-0.02, 0.01)}, random.uniform(1, 10)};
}

TEST(ShipMotion, IsThatOfSmallSteps) {
  Random random(5, 0);
  const Handling handling;
  for (int i = 0; i < 50; ++i) {
    const Piece piece = some_piece(handling, random);
    const State found = after(handling, piece, piece.seconds),
                truth = by_small_steps(handling, piece, piece.seconds);
    EXPECT_LT((found.position - truth.position).norm(), 1e-8);
    EXPECT_NEAR(found.heading, truth.heading, 1e-10);
    EXPECT_NEAR(found.curvature, truth.curvature, 1e-12);
    EXPECT_NEAR(found.speed, truth.speed, 1e-12);
  }
}

TEST(ShipMotion, TurnsInHerCircleAndStopsInHerLength) {
  const Handling handling;
  State at{{0, 0}, 0, 6, 0};
  for (int k = 0; k < 200; ++k) at = after(handling, {at, {1 / handling.radius, 0}, 10}, 10);
  const Vector2d middle = at.position + handling.radius * Vector2d(-at.ahead().y(), at.ahead().x());
  for (int k = 0; k < 50; ++k) {
    at = after(handling, {at, {1 / handling.radius, 0}, 10}, 10);
    EXPECT_NEAR((at.position - middle).norm(), handling.radius, 1e-6);
  }
  const std::vector<Piece> stop = stop_from(handling, at);
  EXPECT_NEAR(length_of(stop), 0.5 * 36 / handling.slower, 1e-9);
  EXPECT_NEAR(seconds_of(stop), 6 / handling.slower, 1e-9);
  EXPECT_EQ(after(handling, stop.back(), stop.back().seconds).speed, 0);
}

TEST(ShipMotion, TracksAreWithinTheirErrorOfIt) {
  Random random(6, 0);
  Ship ship;
  double largest = 0;
  for (int i = 0; i < 50; ++i) {
    const Piece piece = some_piece(ship.handling, random);
    const Vector2d current(random.uniform(-1, 1), random.uniform(-1, 1));
    const Sailed both = sailed(ship, {piece}, current, 5, 5 + piece.seconds);
    EXPECT_LT(both.error, 2e-2);
    for (int k = 0; k <= 20; ++k) {
      const double s = piece.seconds * k / 20, t = 5 + s;
      const simulation::Motion hull = both.hull.motion(t), domain = both.domain.motion(t);
      const State truth = by_small_steps(ship.handling, piece, s);
      // Hermite's quintics of a turning ship: her own way is theirs, to half a millimetre.
      EXPECT_LT((hull.position.head<2>() - t * current - truth.position).norm(), 5e-4);
      const Vector2d arm = hull.rotation.topLeftCorner<2, 2>() * ship.domain.center;
      const double off = (domain.position.head<2>() - hull.position.head<2>() - arm).norm();
      EXPECT_LE(off, both.error + 1e-9);
      largest = std::max(largest, off / (both.error + 1e-9));
      EXPECT_LT((domain.rotation - hull.rotation).norm(), 1e-12);
    }
  }
  EXPECT_GT(largest, 0.05);  // the bound is of the size of what it bounds
}

// Speeds whose stop is a whole number of pieces, but for rounding.
TEST(ShipMotion, AStopHasNoPieceThatIsARounding) {
  const Handling handling;
  for (int k = 1; k <= 200; ++k) {
    const std::vector<Piece> stop = stop_from(handling, {{0, 0}, 0, 0.1 * k, 0});
    for (const Piece& piece : stop) EXPECT_GT(piece.seconds, 1e-3) << 0.1 * k;
    EXPECT_NEAR(seconds_of(stop), 0.1 * k / handling.slower, 1e-9);
  }
}

TEST(ShipMotion, AStopIsLeftAsItWasPlanned) {
  Random random(7, 0);
  const Handling handling;
  for (int i = 0; i < 20; ++i) {
    const std::vector<Piece> plan = plan_of(handling, some_piece(handling, random));
    const State end = after(handling, plan.back(), plan.back().seconds);
    State at = plan[1].start;
    at = after(handling, {at, {0, -handling.slower}, 10}, 10);  // a step of the stop, then the stop again
    const std::vector<Piece> again = stop_from(handling, at);
    const State rest = after(handling, again.back(), again.back().seconds);
    EXPECT_LT((rest.position - end.position).norm(), 1e-9);
    EXPECT_NEAR(rest.heading, end.heading, 1e-12);
  }
}

}  // namespace vericone::ships::motion_test
