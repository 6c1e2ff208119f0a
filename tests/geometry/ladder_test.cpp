// SPDX-License-Identifier: BSD-3-Clause
//
// The ladder itself, with its counters compiled in for the predicates of this file alone.
#ifndef VERICONE_COUNT_RUNGS
#define VERICONE_COUNT_RUNGS
#endif
#include <gtest/gtest.h>
#include <vericone/geometry/sign.h>

#include <thread>

namespace vericone::ladder_test {
namespace {

struct FirstPredicate;
struct SecondPredicate;

/// Decided by the rung asked for; asking a rung after the one that decides is a failure.
template <typename Predicate>
int decide(Rung by, Rung* rung = nullptr) {
  return climb<Predicate>(
      rung, [&]() -> std::optional<int> { return by == Rung::triage ? std::optional(1) : std::nullopt; },
      [&]() -> std::optional<int> {
        EXPECT_NE(by, Rung::triage);
        return by == Rung::interval ? std::optional(2) : std::nullopt;
      },
      [&] {
        EXPECT_EQ(by, Rung::exact);
        return 3;
      });
}

TEST(Ladder, StopsAtTheFirstRungThatAnswersAndNamesIt) {
  for (const Rung by : {Rung::triage, Rung::interval, Rung::exact}) {
    Rung rung{};
    EXPECT_EQ(decide<FirstPredicate>(by, &rung), static_cast<int>(by) + 1);
    EXPECT_EQ(rung, by);
  }
  EXPECT_STREQ(to_string(Rung::interval), "interval");
  EXPECT_STREQ(to_string(Sign::zero), "zero");
}

TEST(Ladder, CountsForEachPredicateAndThread) {
  const RungCounts before = rung_counts<SecondPredicate>();
  for (int i = 0; i < 3; ++i) decide<SecondPredicate>(Rung::triage);
  decide<SecondPredicate>(Rung::exact);
  decide<FirstPredicate>(Rung::interval);
  const RungCounts after = rung_counts<SecondPredicate>();
  EXPECT_EQ(after.triage - before.triage, 3u);
  EXPECT_EQ(after.interval - before.interval, 0u);
  EXPECT_EQ(after.exact - before.exact, 1u);
  std::thread([] {
    EXPECT_EQ(rung_counts<SecondPredicate>().triage, 0u);
    decide<SecondPredicate>(Rung::interval);
    EXPECT_EQ(rung_counts<SecondPredicate>().interval, 1u);
  }).join();
  EXPECT_EQ(rung_counts<SecondPredicate>().interval, after.interval);
}

}  // namespace
}  // namespace vericone::ladder_test
