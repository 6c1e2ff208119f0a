// SPDX-License-Identifier: BSD-3-Clause
#include "output/number_text.h"

#include <gtest/gtest.h>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

namespace vericone {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(NumberText, AsManyDigitsAsAreCertain) {
  EXPECT_EQ(number_text(1.0224322493963134), "1.02243");
  EXPECT_EQ(number_text(2.0), "2");
  EXPECT_EQ(number_text(3.28e-5, 2), "3.3e-05");
  EXPECT_EQ(number_within(1.0224322493963134, 0.00056), "1.0224");
  EXPECT_EQ(number_within(1.0224322493963134, 1e-12), "1.02243");
  EXPECT_EQ(number_within(1.0224322493963134, 5.0), "1");
  EXPECT_EQ(number_within(1.0224322493963134, 0.0), "1.02243");
}

TEST(NumberText, BoundsShareDigitsOrStandBesideEachOther) {
  EXPECT_EQ(between_text(0.0726606, 0.07266061), "0.0726606");
  EXPECT_EQ(between_text(0.07266, 0.07267), "0.0727");
  EXPECT_EQ(between_text(0.0701, 0.0799), "0.0701 to 0.0799");
  EXPECT_EQ(between_text(0.0, 0.0), "0");
  EXPECT_EQ(between_text(1.5, kInfinity), "at least 1.5");
  EXPECT_EQ(bounds_text(1.5, kInfinity), "1.5 and inf");
  EXPECT_EQ(bounds_text(1.0218720428412142, 1.0227124360638822), "1.02187 and 1.02272");
  EXPECT_EQ(bounds_text(-1.0218720428412142, 0.5), "-1.1 and 0.5");
}

TEST(NumberText, BoundsStayBounds) {
  EXPECT_EQ(at_most_text(0.0029469785, 2), "0.003");
  EXPECT_EQ(at_least_text(0.0029469785, 2), "0.0029");
  EXPECT_EQ(at_least_text(-0.0029469785, 2), "-0.003");
  EXPECT_EQ(at_least_text(1.5), "1.5");
  EXPECT_EQ(at_most_text(0.999951, 4), "1");
}

TEST(NumberText, BoundsAreRoundedOutwards) {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> mantissa(-10, 10), power(-12, 12), width(-9, 0);
  for (int i = 0; i < 20'000; ++i) {
    const double low = mantissa(engine) * std::pow(10, power(engine));
    const double high = low + std::abs(low) * std::pow(10, width(engine));
    const std::string text = bounds_text(low, high);
    const std::size_t word = text.find(" and ");
    EXPECT_LE(std::strtod(text.c_str(), nullptr), low) << text;
    EXPECT_GE(std::strtod(text.c_str() + word + 5, nullptr), high) << text;
    // What is given away is little: a tenth of the width, or the sixth digit.
    const double slack = 0.11 * (high - low) + 1.1e-5 * std::max(std::abs(low), std::abs(high));
    EXPECT_GE(std::strtod(text.c_str(), nullptr), low - slack) << text;
    EXPECT_LE(std::strtod(text.c_str() + word + 5, nullptr), high + slack) << text;
  }
}

}  // namespace
}  // namespace vericone
