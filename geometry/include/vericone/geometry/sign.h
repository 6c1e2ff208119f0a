// SPDX-License-Identifier: BSD-3-Clause
//
// Signs, and the ladder of rungs by which every exact predicate finds its answer.
#pragma once

#include <cstdint>
#include <optional>

namespace vericone {

enum class Sign : std::int8_t { negative = -1, zero = 0, positive = 1 };

/// What a rung below the last knows about a sign. `uncertain` is a value of its own, never zero: arithmetic
/// with an error bound does not tell a zero from a small number.
enum class FilteredSign : std::int8_t { negative = -1, positive = 1, uncertain = 2 };

/// The rungs, cheapest first.
enum class Rung : std::uint8_t {
  triage,    // doubles with a bound fixed by the formula: tens of nanoseconds
  interval,  // doubles with the bound of each operation carried along (interval.h)
  exact,     // integers: always an answer
};

[[nodiscard]] const char* to_string(Sign sign);
[[nodiscard]] const char* to_string(Rung rung);

/// Counts of decisions by rung. Kept for each predicate that climbs a ladder when the library is compiled
/// with VERICONE_COUNT_RUNGS; otherwise all zero, at no cost.
struct RungCounts {
  std::uint64_t triage = 0, interval = 0, exact = 0;
};

namespace detail {
/// One counter set for each predicate, named by a tag type.
template <typename Predicate>
RungCounts& rung_counts() {
  static thread_local RungCounts counts;
  return counts;
}
}  // namespace detail

/// Counts of this thread for a predicate; see the headers of predicates for the tags.
template <typename Predicate>
[[nodiscard]] RungCounts rung_counts() {
  return detail::rung_counts<Predicate>();
}

/// Decisions of `Predicate` by a rung: written to `*rung` unless null, and counted.
template <typename Predicate>
void decided_by(Rung by, Rung* rung, [[maybe_unused]] std::uint64_t count = 1) {
  if (rung) *rung = by;
#ifdef VERICONE_COUNT_RUNGS
  RungCounts& counts = detail::rung_counts<Predicate>();
  (by == Rung::triage ? counts.triage : by == Rung::interval ? counts.interval : counts.exact) += count;
#endif
}

/// The ladder: `triage` and `interval` return optionals, `exact` an answer. The rung that decided is written
/// to `*rung` unless null.
template <typename Predicate, typename Triage, typename Interval, typename Exact>
[[nodiscard]] auto climb(Rung* rung, const Triage& triage, const Interval& interval, const Exact& exact)
    -> decltype(exact()) {
  if (const auto answer = triage()) {
    decided_by<Predicate>(Rung::triage, rung);
    return *answer;
  }
  if (const auto answer = interval()) {
    decided_by<Predicate>(Rung::interval, rung);
    return *answer;
  }
  decided_by<Predicate>(Rung::exact, rung);
  return exact();
}

}  // namespace vericone
