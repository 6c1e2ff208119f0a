// SPDX-License-Identifier: BSD-3-Clause
//
// The first rung's arithmetic against rationals: a value is never farther from the exact one than its
// rounding count says, and the constant that turns counts into bounds is right for every count in use.
#include <gtest/gtest.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/internal/geometry/exact/integer.h>
#include <vericone/internal/geometry/tracked.h>
#include <vericone/testing/random_bodies.h>

namespace vericone::tracked_test {
namespace {

using exact::Integer, exact::Rational;
using testing::RandomBodies;

TEST(RoundingCount, CountsTheLongestPath) {
  constexpr RoundingCount x{0}, y{3};
  static_assert((x + y).roundings == 4);
  static_assert((x * y).roundings == 4);
  static_assert((y * y - x).roundings == 8);
  static_assert((-y).roundings == 3);
  static_assert((y * 4).roundings == 3, "powers of two are exact");
  static_assert((y * 18).roundings == 4);
}

/// bound() >= ((1 + u)^K - 1) / (1 - u)^K with two roundings to spare for the comparison itself, in
/// rationals.
TEST(RoundingCount, BoundCoversSecondOrderTermsUpToAThousandRoundings) {
  const Rational u(0x1p-53), up = 1 + u, down = 1 - u;
  Rational grown = 1, shrunk = 1;
  for (int k = 1; k <= 1000; ++k) {
    // Rounded upwards and downwards to 200 bits, or the numbers would fill the memory.
    const auto trim = [](const Rational& x, int add) {
      const Integer scale = Integer(1) << 200;
      return Rational(numerator(x) * scale / denominator(x) + add) / Rational(scale);
    };
    grown = trim(grown * up, 1);
    shrunk = trim(shrunk * down, 0);
    ASSERT_GE(Rational(RoundingCount{k}.bound()) * down * down * shrunk, grown - 1) << k;
  }
}

/// One number in the three ways.
struct Shadowed {
  Tracked tracked;
  RoundingCount count;
  Rational exact, magnitude;
};

TEST(Tracked, ValueIsWithinTheBoundThroughRandomPolynomials) {
  RandomBodies random(81);
  SCOPED_TRACE(random.trace());
  double closest = 0;
  for (int polynomial = 0; polynomial < 30'000; ++polynomial) {
    std::array<Shadowed, 4> x;
    for (auto& v : x) {
      const double d = random.uniform(-1, 1);
      v = {Tracked::of(d), {0}, Rational(d), abs(Rational(d))};
    }
    for (int step = 0; step < 6; ++step) {
      Shadowed &to = x[random.integer(0, 3)], &from = x[random.integer(0, 3)];
      switch (random.integer(0, 3)) {
        case 0:
          to = {to.tracked + from.tracked, to.count + from.count, to.exact + from.exact,
                to.magnitude + from.magnitude};
          break;
        case 1:
          to = {to.tracked - from.tracked, to.count - from.count, to.exact - from.exact,
                to.magnitude + from.magnitude};
          break;
        case 2:
          to = {to.tracked * 27, to.count * 27, to.exact * 27, to.magnitude * 27};
          break;
        default:
          to = {to.tracked * from.tracked, to.count * from.count, to.exact * from.exact,
                to.magnitude * from.magnitude};
      }
      const Rational error = abs(Rational(to.tracked.value()) - to.exact);
      const Rational bound = Rational(to.count.bound()) * Rational(to.tracked.magnitude());
      ASSERT_LE(error, bound + Rational(0x1p-1000)) << "polynomial " << polynomial << " step " << step;
      if (bound > 0) closest = std::max(closest, static_cast<double>(Rational(error / bound)));
      const int certain = to.tracked.certain(to.count, 0x1p-1000);
      if (certain != 0) {
        ASSERT_EQ(certain, to.exact.sign());
      }
      if (to.count.roundings > 200) break;
    }
  }
  EXPECT_GT(closest, 0.5);  // the bound is attained to a factor: it is not empty
}

}  // namespace
}  // namespace vericone::tracked_test
