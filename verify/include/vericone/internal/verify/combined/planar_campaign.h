// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sectors of planar combined quadrics held against the exact truth.
#pragma once

#include <vericone/internal/verify/combined/planar_families.h>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace vericone::verify {

/// What sector_by_source() made of the pairs it is meant for: disjoint, A an ellipse, at most one delimiter.
struct SourceCount {
  std::uint64_t asked = 0;
  std::uint64_t none = 0;       // no answer
  std::uint64_t wrong = 0;      // an edge off by more than 1e-6 rad: the truth says so for that very edge
  std::uint64_t too_small = 0;  // of these: a colliding direction next to an edge is called safe
  std::uint64_t first_wrong = 0;
};

struct CombinedPlanarReport {
  CombinedPlanarFamily family = CombinedPlanarFamily::one_hyperbola;
  std::uint64_t seed = 0, cases = 0;
  std::uint64_t disjoint = 0;       // exactly
  std::uint64_t hulls_overlap = 0;  // of these
  std::uint64_t undecided = 0;      // relations that the truth did not decide
  std::uint64_t wrong_relation = 0;
  /// Pairs of which an edge, turned inwards by the tolerance, is not in the cone, or turned outwards not
  /// outside of it.
  static constexpr double kTolerances[] = {1e-10, 1e-12, 1e-14};
  std::uint64_t wrong_edge[3] = {0, 0, 0};
  /// The second and third are asked of one disjoint pair in so many.
  static constexpr std::uint64_t kNarrowEvery = 16;
  std::uint64_t narrow = 0;
  std::uint64_t wrong_direction = 0;  // pairs of which one of four random directions is told wrongly
  std::uint64_t first_wrong = 0;  // index of the first pair with a wrong relation, edge (1e-10) or direction
  std::uint64_t exact_answers = 0;  // questions that no interval could decide
  SourceCount printed, keep_both, by_sides;

  [[nodiscard]] std::uint64_t wrong() const { return wrong_relation + wrong_edge[0] + wrong_direction; }
};

/// Pairs 0 .. cases - 1 of a family. About 0.1 ms a pair.
[[nodiscard]] CombinedPlanarReport run_combined_planar(CombinedPlanarFamily family, std::uint64_t cases,
                                                       std::uint64_t seed);

/// Markdown tables: answers, and the source's choices.
[[nodiscard]] std::string to_markdown(std::span<const CombinedPlanarReport> reports);

}  // namespace vericone::verify
