// SPDX-License-Identifier: BSD-3-Clause
//
// Intervals carry an exact rational number through random chains of operations and must contain it after
// each.
#include <gtest/gtest.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/geometry/interval.h>
#include <vericone/testing/random_bodies.h>

#include <limits>

namespace vericone::interval_test {
namespace {

using exact::Rational;
using testing::RandomBodies;

/// An interval and the number that it is to contain.
struct Shadowed {
  Interval interval;
  Rational exact;
};

bool contains(const Interval& x, const Rational& exact) {
  if (!x.finite()) return true;
  return Rational(x.mid()) - Rational(x.rad()) <= exact && exact <= Rational(x.mid()) + Rational(x.rad()) &&
         Rational(x.lo()) <= exact && exact <= Rational(x.hi());
}

/// Magnitudes of every kind: ordinary, huge, tiny, subnormal, integers, zero.
double draw(RandomBodies& random) {
  const double sign = random.coin() ? 1 : -1;
  switch (random.integer(0, 6)) {
    case 0:
      return sign * random.log_uniform(1e-160, 1e160);
    case 1:
      return sign * random.integer(0, 9);
    case 2:
      return sign * std::ldexp(random.integer(1, 1 << 20), -1074);
    case 3:
      return sign * random.log_uniform(1e-308, 1e-290);
    default:
      return sign * random.uniform(0.5, 2);
  }
}

TEST(Interval, ContainsTheExactNumberThroughEveryOperation) {
  RandomBodies random(71);
  SCOPED_TRACE(random.trace());
  int divisions = 0, subnormal = 0;
  for (int chain = 0; chain < 10'000; ++chain) {
    const double first = draw(random);
    Shadowed x{first, Rational(first)};
    for (int step = 0; step < 6; ++step) {
      // The other operand is itself the result of an operation half of the time, so that it has a radius.
      double d = draw(random);
      Shadowed y{d, Rational(d)};
      if (random.coin()) {
        d = draw(random);
        y = {y.interval * Interval(d), y.exact * Rational(d)};
      }
      if (random.integer(0, 3) == 0) {  // near cancellation
        d = -x.interval.mid();
        y = {d, Rational(d)};
      }
      switch (random.integer(0, 4)) {
        case 0:
          x = {x.interval + y.interval, x.exact + y.exact};
          break;
        case 1:
          x = {x.interval - y.interval, x.exact - y.exact};
          break;
        case 2:
          if (!y.exact.is_zero()) {
            x = {x.interval / y.interval, x.exact / y.exact};
            ++divisions;
          }
          break;
        case 3:
          x = {square(x.interval), x.exact * x.exact};
          break;
        default:
          x = {x.interval * y.interval, x.exact * y.exact};
      }
      ASSERT_TRUE(contains(x.interval, x.exact)) << "chain " << chain << " step " << step;
      subnormal += std::abs(x.interval.mid()) < std::numeric_limits<double>::min();
      const int sign = x.exact.sign();
      if (x.interval.positive()) {
        ASSERT_GT(sign, 0);
      }
      if (x.interval.negative()) {
        ASSERT_LT(sign, 0);
      }
      if (!x.interval.finite() || std::abs(x.interval.mid()) > 1e170) break;  // the rational grows
    }
  }
  EXPECT_GT(divisions, 1000);
  EXPECT_GT(subnormal, 1000);
}

TEST(Interval, RadiiStayWithinAFewRoundings) {
  // Useful, not only right: one operation on exact numbers costs about one rounding.
  RandomBodies random(72);
  for (int i = 0; i < 1000; ++i) {
    const Interval x = random.uniform(1, 2), y = random.uniform(1, 2);
    for (const Interval& r : {x + y, x * y, x / y}) EXPECT_LT(r.rad(), 1.1 * 0x1p-53 * r.magnitude());
  }
}

TEST(Interval, SquareRootIsEnclosed) {
  RandomBodies random(73);
  for (int i = 0; i < 20'000; ++i) {
    const double v = std::abs(draw(random));
    const Interval r = sqrt(Interval(v));
    const Rational lo = r.lo() > 0 ? Rational(r.lo()) : Rational(0), hi = r.hi();
    ASSERT_TRUE(lo * lo <= Rational(v) && Rational(v) <= hi * hi) << v;
    if (v > 1e-300) {
      ASSERT_LT(r.hi() - r.lo(), 2e-15 * std::sqrt(v));
    }
  }
  EXPECT_TRUE(sqrt(Interval(0.0)).contains(0));
  EXPECT_FALSE(sqrt(Interval(-1.0)).finite());
  EXPECT_TRUE(sqrt(Interval(4.0)).contains(2));
}

TEST(Interval, DecidesNothingBeyondTheRangeOfDoubles) {
  const Interval huge = 1e300, beyond = huge * huge, lost = beyond - beyond;
  EXPECT_EQ(beyond.sign(), FilteredSign::uncertain);
  EXPECT_EQ(lost.sign(), FilteredSign::uncertain);
  EXPECT_EQ((Interval(1) / Interval(0.0)).sign(), FilteredSign::uncertain);
  EXPECT_EQ((Interval(1) / (Interval(1) - Interval(1))).sign(), FilteredSign::uncertain);
  EXPECT_EQ(Interval(std::numeric_limits<double>::quiet_NaN()).sign(), FilteredSign::uncertain);
}

TEST(Interval, ZeroIsNeverASign) {
  EXPECT_EQ(Interval(0.0).sign(), FilteredSign::uncertain);
  EXPECT_EQ((Interval(3) - Interval(3)).sign(), FilteredSign::uncertain);
  EXPECT_EQ(Interval(1e-300).sign(), FilteredSign::positive);
  EXPECT_EQ(Interval::between(-1, 2).sign(), FilteredSign::uncertain);
  EXPECT_EQ(hull(Interval(1), Interval(2)).sign(), FilteredSign::positive);
  EXPECT_TRUE(hull(Interval(1), Interval(2)).contains(1.5));
}

}  // namespace
}  // namespace vericone::interval_test
