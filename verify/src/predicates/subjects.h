// SPDX-License-Identifier: GPL-3.0-or-later
//
// One predicate under the campaign: how a block of cases is made and asked.
#pragma once

#include <vericone/internal/verify/predicates/campaign.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace vericone::verify {

struct Depth {
  bool exact = false, truth = false;
};

struct Block {
  std::array<PredicateCase, kCasesPerBlock> cases;
  /// Time of the ladder over all cases, and over the random ones among them.
  double nanoseconds = 0, random_nanoseconds = 0;
};

/// Code of an answer; kUnsure is the code of FilteredSign::uncertain and of an empty optional.
constexpr int kUnsure = -1;
constexpr int code(Sign sign) { return 1 + static_cast<int>(sign); }
constexpr int code(FilteredSign sign) {
  return sign == FilteredSign::uncertain ? kUnsure : 1 + static_cast<int>(sign);
}
template <typename Enum>
constexpr int code(Enum answer) {
  return static_cast<int>(answer);
}
template <typename Enum>
constexpr int code(const std::optional<Enum>& answer) {
  return answer ? code(*answer) : kUnsure;
}

class Stopwatch {
 public:
  double nanoseconds() const {
    return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Asks the ladder of every case, timed; the random ones are timed apart: `ask(i)` returns the code.
template <typename Ask>
void climb_all(Block& block, const Ask& ask) {
  for (const bool random : {true, false}) {
    const Stopwatch watch;
    int asked = 0;
    for (int i = 0; i < kCasesPerBlock; ++i) {
      PredicateCase& c = block.cases[i];
      if (c.random != random) continue;
      c.ladder = ask(i, &c.rung);
      ++asked;
    }
    if (!asked) continue;
    const double t = watch.nanoseconds();
    block.nanoseconds += t;
    if (random) block.random_nanoseconds += t;
  }
}

struct Subject {
  const char* name;
  /// Makes block `number` and asks it.
  void (*run)(std::uint64_t seed, std::uint64_t number, Depth depth, Block& block);
  /// Whether the answer is that of a degenerate case.
  bool (*degenerate)(int answer);
};

/// Subjects by file.
std::span<const Subject> pair_subjects();     // relation, cone, sector
std::span<const Subject> hull_subjects();     // hulls of points
std::span<const Subject> horizon_subjects();  // pairs within a horizon
std::span<const Subject> orifice_subjects();
std::span<const Subject> order_subjects();  // tangent directions, times to contact
std::span<const Subject> side_subjects();   // point against quadric and body

}  // namespace vericone::verify
