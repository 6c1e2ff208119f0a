// SPDX-License-Identifier: GPL-3.0-or-later
//
// The same program built with other options: equal answers and equal IEEE arithmetic; equal rungs too where
// searches for certificates round alike.
#include <gtest/gtest.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace vericone::verify::options_test {
namespace {

/// Lines of one program by their first word.
using Lines = std::map<std::string, std::vector<std::string>>;

Lines output_of(const std::string& program) {
  Lines lines;
  FILE* pipe = popen((program + " " VERICONE_CORPUS).c_str(), "r");
  if (!pipe) return lines;
  std::string all;
  char buffer[1 << 16];
  for (std::size_t n = 0; (n = fread(buffer, 1, sizeof(buffer), pipe)) > 0;) all.append(buffer, n);
  EXPECT_EQ(pclose(pipe), 0) << program;
  std::istringstream in(all);
  for (std::string line; std::getline(in, line);) lines[line.substr(0, line.find(' '))].push_back(line);
  return lines;
}

const Lines& reference() {
  static const Lines lines = output_of(VERICONE_OPTIONS_PROBE);
  return lines;
}

std::vector<double> numbers(const std::string& line) {
  std::vector<double> values;
  std::istringstream in(line.substr(line.find('|') + 1));
  for (std::string word; in >> word;) values.push_back(std::strtod(word.c_str(), nullptr));
  return values;
}

/// Whether two lines of answers say the same, each rung for itself: where a search for a certificate was
/// rounded otherwise a lower rung may say nothing ("-"), and another rung then decides (the last word). What
/// is said has to be equal.
bool same_answers(const std::string& x, const std::string& y) {
  std::istringstream in_x(x), in_y(y);
  std::vector<std::string> words_x, words_y;
  for (std::string word; in_x >> word;) words_x.push_back(word);
  for (std::string word; in_y >> word;) words_y.push_back(word);
  if (words_x.size() != words_y.size() || words_x.size() < 3) return false;
  for (std::size_t i = 0; i + 1 < words_x.size(); ++i)
    if (words_x[i] != words_y[i] && words_x[i] != "-" && words_y[i] != "-") return false;
  return true;
}

/// Number of lines that differ; the first few are failures when they must not.
std::size_t differences(const Lines& lines, const std::string& what, bool must_agree) {
  const auto &expected = reference().at(what), &got = lines.at(what);
  EXPECT_EQ(expected.size(), got.size());
  std::size_t differing = 0;
  for (std::size_t i = 0; i < std::min(expected.size(), got.size()); ++i) {
    if (expected[i] == got[i]) continue;
    if (++differing <= 3 && must_agree) ADD_FAILURE() << expected[i] << "\n  became " << got[i];
  }
  if (must_agree) {
    EXPECT_EQ(differing, 0U) << what;
  }
  return differing;
}

double worst_difference(const Lines& lines, const std::string& what) {
  double worst = 0;
  for (std::size_t i = 0; i < lines.at(what).size(); ++i) {
    const auto x = numbers(reference().at(what)[i]), y = numbers(lines.at(what)[i]);
    for (std::size_t k = 0; k < x.size(); ++k) worst = std::max(worst, std::abs(x[k] - y[k]));
  }
  return worst;
}

class OptionsProbe : public ::testing::TestWithParam<const char*> {};

TEST_P(OptionsProbe, AnswersAndArithmeticAreEqual) {
  const Lines lines = output_of(GetParam());
  ASSERT_GE(reference().at("answer").size(), 2500U);
  const bool same_vectors = std::string(GetParam()).find("native") == std::string::npos;
  differences(lines, "arithmetic", true);
  ASSERT_EQ(reference().at("random").size(), 64U);  // every two kinds
  differences(lines, "random", true);
  const std::size_t other_rungs = differences(lines, "answer", same_vectors);
  for (std::size_t i = 0; i < lines.at("answer").size(); ++i)
    EXPECT_TRUE(same_answers(reference().at("answer")[i], lines.at("answer")[i]))
        << reference().at("answer")[i] << "\n  became " << lines.at("answer")[i];
  EXPECT_LT(other_rungs, lines.at("answer").size() / 100);
  std::cout << "answers: decided by another rung " << other_rungs << " times\n";
  // Eigen sums in the order of the processor's vectors, so -march changes roundings there; the optimiser
  // alone changes nothing. A sample of the boundary is another point of it when its normal is rounded
  // otherwise.
  for (const char* what : {"direction", "angles"}) {
    const std::size_t differing = differences(lines, what, same_vectors);
    std::cout << what << ": " << differing << " of " << lines.at(what).size() << " differ, by "
              << worst_difference(lines, what) << '\n';
  }
  EXPECT_LT(worst_difference(lines, "angles"), 1e-13);
}

INSTANTIATE_TEST_SUITE_P(Builds, OptionsProbe, ::testing::Values(VERICONE_OPTIONS_PROBES));

TEST(ThisBuild, KeepsIeeeArithmetic) {
  static_assert(std::numeric_limits<double>::is_iec559);
  static_assert(FLT_EVAL_METHOD == 0);
  volatile double one = 1, tiny = 0x1p-60, large = 0x1p60, least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ((one + tiny) - one, 0) << "excess precision";
  EXPECT_EQ((tiny + large) - large, 0) << "reassociation";
  EXPECT_EQ(one + 0x1p-53, 1) << "rounding to nearest, ties to even";
  EXPECT_GT(one + 0x1.8p-53, 1) << "rounding to nearest";
  EXPECT_GT(least, 0) << "subnormal numbers flushed to zero";
  EXPECT_GT(least + least, least) << "subnormal numbers flushed to zero";
  volatile double zero = 0;
  EXPECT_TRUE(std::isnan(zero / zero)) << "NaN assumed away";
  EXPECT_TRUE(std::isinf(one / zero)) << "infinities assumed away";
  EXPECT_TRUE(std::signbit(-zero)) << "signs of zero assumed away";
}

}  // namespace
}  // namespace vericone::verify::options_test
