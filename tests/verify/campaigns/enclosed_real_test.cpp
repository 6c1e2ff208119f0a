// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <vericone/internal/verify/spatial/enclosed_real.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace vericone::verify::enclosed_real_test {
namespace {

constexpr double kPi = std::numbers::pi;
// pi to 159 bits; the first two parts are well known, the third is theirs to complete.
const EnclosedReal kExactPi(kPi, std::nextafter(kPi, 4.0),
                            {kPi, 1.2246467991473532e-16, -2.9947698097183397e-33});

TEST(EnclosedReal, MeasuresBelowTheSpacingOfDoubles) {
  EXPECT_DOUBLE_EQ(kExactPi.error(kPi), -1.2246467991473532e-16);
  EXPECT_DOUBLE_EQ(kExactPi.ulps_off(kPi), 1.2246467991473532e-16 / 0x1p-51);
  EXPECT_DOUBLE_EQ(kExactPi.ulps_off(std::nextafter(kPi, 4.0)), 1 - 1.2246467991473532e-16 / 0x1p-51);
  EXPECT_DOUBLE_EQ(kExactPi.relative_error(kPi + 1), 1 / kPi);
  EXPECT_TRUE(kExactPi.contains(kPi));
  EXPECT_FALSE(kExactPi.contains(3.0));
}

TEST(EnclosedReal, TakesAnAnswerInTwoParts) {
  EXPECT_NEAR(kExactPi.error(kPi, 1.2246467991473532e-16), 2.9947698097183397e-33, 1e-47);
}

TEST(EnclosedReal, AnglesWrap) {
  EXPECT_DOUBLE_EQ(kExactPi.angle_error(kPi), -1.2246467991473532e-16);
  EXPECT_DOUBLE_EQ(kExactPi.angle_error(-kPi), 1.2246467991473532e-16);
  EXPECT_NEAR(kExactPi.angle_error(-3.0), kPi - 3, 1e-15);
  EXPECT_NEAR(kExactPi.angle_error(3.0), 3 - kPi, 1e-15);
}

TEST(EnclosedReal, ZeroHasNoSpacing) {
  const EnclosedReal zero;
  EXPECT_EQ(zero.ulps_off(0), 0);
  EXPECT_EQ(zero.relative_error(0), 0);
  EXPECT_EQ(zero.ulps_off(1e-300), std::numeric_limits<double>::infinity());
  EXPECT_EQ(zero.error(1e-300), 1e-300);
}

TEST(EnclosedReal, NotANumberStaysOne) {
  EXPECT_TRUE(std::isnan(kExactPi.error(std::nan(""))));
  EXPECT_TRUE(std::isnan(kExactPi.angle_error(std::nan(""))));
  EXPECT_TRUE(std::isnan(kExactPi.relative_error(std::nan(""))));
}

}  // namespace
}  // namespace vericone::verify::enclosed_real_test
