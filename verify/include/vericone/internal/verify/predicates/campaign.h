// SPDX-License-Identifier: GPL-3.0-or-later
//
// The library's predicates over random, thin, distant, tiny, huge, nearly degenerate and exactly degenerate
// cases, at two depths: every rung that answers against the exact one, and the answers against
// predicate_truth.h.
#pragma once

#include <vericone/geometry/sign.h>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace vericone::verify {

/// What one predicate did. Counts depend on (predicate, seed, cases, shares) alone, not on threads.
struct PredicateReport {
  std::string predicate;
  std::uint64_t seed = 0;
  std::uint64_t cases = 0;
  std::uint64_t degenerate = 0;           // the answer is on, touching, zero, ...
  std::uint64_t compared_with_exact = 0;  // asked of every rung
  std::uint64_t checked_against_cgal = 0;
  std::uint64_t wrong = 0;                            // cases in which a rung or the ladder was wrong
  std::optional<std::uint64_t> first_wrong;           // the least index of a wrong case
  std::uint64_t naive_asked = 0, naive_wrong = 0;     // doubles without a bound
  std::uint64_t triage = 0, interval = 0, exact = 0;  // cases that each rung decided
  /// The same for the cases that are as a user's are: bodies of ordinary size, random velocities or places.
  std::uint64_t random_cases = 0, random_triage = 0, random_interval = 0;
  double nanoseconds = 0, random_nanoseconds = 0;  // a case, up the ladder; mean
};

struct PredicateOptions {
  /// Rounded up to whole blocks of kCasesPerBlock. The order of times to contact, whose last rung takes
  /// milliseconds, gets a 400th, and the oracle more often.
  std::uint64_t cases = 1'000'000;
  std::uint64_t seed = 1;
  unsigned threads = 0;  // 0: one per processor
  /// One in so many blocks is asked of the exact rung, and against CGAL; 0: none.
  std::uint64_t exact_every = 8;
  std::uint64_t truth_every = 4096;
  /// Asked between blocks; true ends the run early, with a report on what was done.
  std::function<bool()> stop;
  /// Called after every few blocks with the cases done so far; by one thread at a time.
  std::function<void(const std::string& predicate, std::uint64_t done, std::uint64_t total)> progress;
  /// What a broken library would say instead of `answer` (a code of the predicate's enumeration), by rung.
  /// For tests of this campaign.
  std::function<int(Rung rung, int answer)> distort;
};

inline constexpr int kCasesPerBlock = 16;

/// Names of all predicates, in the order of the reports.
[[nodiscard]] std::vector<std::string> predicate_names();

/// Throws std::invalid_argument for a name that is not among predicate_names().
[[nodiscard]] PredicateReport run_predicate(const std::string& predicate, const PredicateOptions& options);

/// All predicates; `options.cases` of each.
[[nodiscard]] std::vector<PredicateReport> run_predicate_campaign(const PredicateOptions& options);

/// What the rungs, the ladder, naive doubles and the oracle say about one case; for those who look into a
/// wrong one. Codes as in PredicateReport's enumeration order; -1: no answer.
struct PredicateCase {
  int ladder = -1, triage = -1, interval = -1, exact = -1, naive = -1, truth = -1;
  Rung rung = Rung::exact;
  bool random = false;
};
[[nodiscard]] PredicateCase replay_predicate(const std::string& predicate, std::uint64_t seed,
                                             std::uint64_t index);

/// A Markdown table, one row a predicate.
[[nodiscard]] std::string to_markdown(std::span<const PredicateReport> reports);

/// A JSON list of objects with the keys predicate, cases, degenerate, compared_with_exact,
/// checked_against_cgal, wrong, first_wrong (where there is one), naive_wrong (null where there is no naive
/// method), triage, interval, exact (shares of the cases), random_triage, nanoseconds, random_nanoseconds.
[[nodiscard]] std::string to_json(std::span<const PredicateReport> reports);

}  // namespace vericone::verify
