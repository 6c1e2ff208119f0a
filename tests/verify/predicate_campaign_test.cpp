// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every predicate over its cases, and the campaign itself: what a broken library would say must be noticed.
// VERICONE_CASES and VERICONE_SEED replace the number of cases and the seed.
#include <gtest/gtest.h>
#include <vericone/internal/verify/predicates/campaign.h>

#include <atomic>
#include <cctype>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/campaign.h"

namespace vericone::verify::predicate_campaign_test {
namespace {

using testing::campaign_size, testing::from_environment;

/// How often the exact rung can be afforded: one block in so many. It costs a microsecond for points and
/// planar sectors, ten for cones and hulls, up to a millisecond for the others.
std::uint64_t exact_every(const std::string& predicate) {
  const auto starts = [&](const char* text) { return predicate.rfind(text, 0) == 0; };
  return starts("point") || starts("velocity, sector") ? 1
         : starts("velocity, orifice")                 ? 64
         : starts("velocity, opening")                 ? 64
         : starts("velocity")                          ? 4
                                                       : 64;
}

bool is_within_horizon(const std::string& predicate) { return predicate.starts_with("horizon"); }

PredicateOptions options(const std::string& predicate) {
  PredicateOptions o;
  constexpr std::uint64_t kCampaign = 100'000'000;  // of all predicates
  // Every case within a horizon is asked of two ways of deciding it.
  const std::uint64_t usual = is_within_horizon(predicate) ? 50'000 : 200'000;
  o.cases = from_environment("VERICONE_CASES",
                             campaign_size<std::uint64_t>(usual, kCampaign / predicate_names().size() + 1));
  o.seed = from_environment("VERICONE_SEED", campaign_size(1, 2));
  o.exact_every = campaign_size(1, 16) * exact_every(predicate);
  o.truth_every = campaign_size(128, 8192);
  return o;
}

std::string trace(const PredicateReport& r) {
  return "VERICONE_SEED=" + std::to_string(r.seed) + "\n" + to_markdown({&r, 1});
}

class EveryPredicate : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryPredicate, IsNeverWrong) {
  const PredicateOptions o = options(GetParam());
  const PredicateReport r = run_predicate(GetParam(), o);
  SCOPED_TRACE(trace(r));
  std::printf("%s\n", to_markdown({&r, 1}).c_str());
  EXPECT_EQ(r.wrong, 0) << "first at " << r.first_wrong.value_or(0);
  EXPECT_GE(r.cases, o.cases);
  EXPECT_EQ(r.triage + r.interval + r.exact, r.cases);
  // The cases are what they are meant to be: degenerate ones, ordinary ones, and all depths.
  EXPECT_GT(r.degenerate, r.cases / 2000);
  EXPECT_GT(r.random_cases, r.cases / 20);
  EXPECT_GT(r.compared_with_exact, r.cases / o.exact_every / 2);
  EXPECT_GT(r.checked_against_cgal, r.cases / o.truth_every / 2);
  EXPECT_GT(r.exact, r.cases / 200);
  // Ordinary cases hardly ever need more than the first rung; doubles alone fail on the hard ones. Within a
  // horizon the first rung knows only what never meets.
  const std::uint64_t cheap =
      is_within_horizon(GetParam()) ? r.random_triage + r.random_interval : r.random_triage;
  EXPECT_GT(cheap, 0.999 * static_cast<double>(r.random_cases));
  if (r.naive_asked) {
    EXPECT_GT(r.naive_wrong, r.naive_asked / 1000);
  }
}

std::string as_identifier(const ::testing::TestParamInfo<std::string>& info) {
  std::string s = info.param;
  for (char& c : s)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return s;
}
INSTANTIATE_TEST_SUITE_P(Campaign, EveryPredicate, ::testing::ValuesIn(predicate_names()), as_identifier);

PredicateOptions few(const std::string& predicate = {}) {
  PredicateOptions o;
  o.cases = is_within_horizon(predicate) ? 1000 : 3000;
  o.seed = from_environment("VERICONE_SEED", 5);
  o.exact_every = 1;
  o.truth_every = 0;
  return o;
}

class BrokenLibrary : public ::testing::TestWithParam<std::string> {};

TEST_P(BrokenLibrary, OneRungThatIsWrongIsFoundWithoutCgal) {
  for (const Rung broken : {Rung::triage, Rung::exact}) {
    PredicateOptions o = few(GetParam());
    o.distort = [&](Rung rung, int answer) { return rung == broken ? answer + 1 : answer; };
    EXPECT_GT(run_predicate(GetParam(), o).wrong, 100) << to_string(broken);
  }
}

TEST_P(BrokenLibrary, ALibraryWrongThroughoutIsFoundByCgalAlone) {
  PredicateOptions o = few(GetParam());
  o.cases = 600;
  o.distort = [](Rung, int answer) { return answer + 1; };
  EXPECT_EQ(run_predicate(GetParam(), o).wrong, 0) << "the rungs agree with each other";
  o.truth_every = 1;
  EXPECT_GT(run_predicate(GetParam(), o).wrong, 300);
}

TEST_P(BrokenLibrary, ABoundaryCalledInsideIsFoundByCgal) {
  // The code of on, touching and zero is 1 for all predicates; 0 is in, disjoint or negative. Positions touch
  // from inside as well, 4 and 6, and are equal, 7.
  PredicateOptions o = few(GetParam());
  o.distort = [](Rung, int answer) {
    const bool degenerate = answer == 1 || answer == 4 || answer == 6 || answer == 7;
    return degenerate ? answer - 1 : answer;
  };
  EXPECT_EQ(run_predicate(GetParam(), o).wrong, 0);
  o.truth_every = 1;
  const PredicateReport r = run_predicate(GetParam(), o);
  SCOPED_TRACE(trace(r));
  EXPECT_GT(r.wrong, 2);
}

TEST_P(BrokenLibrary, AnAnswerChangedOnceIsFoundAndReplayed) {
  PredicateOptions o = few(GetParam());
  o.threads = 1;
  int asked = 0;
  o.distort = [&](Rung rung, int answer) {
    return rung == Rung::exact && ++asked == 700 ? (answer + 1) % 3 : answer;
  };
  const PredicateReport r = run_predicate(GetParam(), o);
  EXPECT_EQ(r.wrong, 1);
  ASSERT_TRUE(r.first_wrong);
  const PredicateCase c = replay_predicate(GetParam(), o.seed, *r.first_wrong);
  EXPECT_EQ(c.ladder, c.truth);
  EXPECT_EQ(c.exact, c.truth);
}

TEST_P(BrokenLibrary, CountsDoNotDependOnThreads) {
  PredicateOptions o = few(GetParam());
  o.cases = 20'000;
  o.exact_every = is_within_horizon(GetParam()) ? 64 : 4;
  o.truth_every = 100;
  o.threads = 1;
  const PredicateReport one = run_predicate(GetParam(), o);
  o.threads = 3;
  const PredicateReport three = run_predicate(GetParam(), o);
  EXPECT_EQ(one.cases, three.cases);
  EXPECT_EQ(one.degenerate, three.degenerate);
  EXPECT_EQ(one.compared_with_exact, three.compared_with_exact);
  EXPECT_EQ(one.checked_against_cgal, three.checked_against_cgal);
  EXPECT_EQ(one.naive_wrong, three.naive_wrong);
  EXPECT_EQ(one.triage, three.triage);
  EXPECT_EQ(one.interval, three.interval);
  EXPECT_EQ(one.exact, three.exact);
}

INSTANTIATE_TEST_SUITE_P(Campaign, BrokenLibrary, ::testing::ValuesIn(predicate_names()), as_identifier);

TEST(PredicateCampaign, StopsWhenAsked) {
  PredicateOptions o = few();
  o.cases = 1'000'000'000;
  o.threads = 2;
  std::atomic<std::uint64_t> done = 0;
  o.progress = [&](const std::string&, std::uint64_t so_far, std::uint64_t) { done = so_far; };
  o.stop = [&] { return done > 3000; };
  const PredicateReport r = run_predicate(predicate_names().back(), o);
  EXPECT_GT(r.cases, 3000);
  EXPECT_LT(r.cases, 100'000);
}

TEST(PredicateCampaign, UnknownPredicate) {
  EXPECT_THROW((void)run_predicate("no such", few()), std::invalid_argument);
}

TEST(PredicateCampaign, JsonHasTheKeys) {
  const PredicateReport r = run_predicate(predicate_names().front(), few());
  const std::string json = to_json({&r, 1});
  for (const char* key : {"predicate", "cases", "degenerate", "checked_against_cgal", "wrong", "naive_wrong",
                          "triage", "interval", "exact", "nanoseconds"})
    EXPECT_NE(json.find("\"" + std::string(key) + "\": "), std::string::npos) << key;
  for (const char* bad : {": nan", ": -nan", ": inf"}) EXPECT_EQ(json.find(bad), std::string::npos);
}

}  // namespace
}  // namespace vericone::verify::predicate_campaign_test
