// SPDX-License-Identifier: GPL-3.0-or-later
//
// A planar method held against the exact answer over the families of planar_families.h.
#pragma once

#include <vericone/verify/planar/families.h>
#include <vericone/verify/predicates/exact_tangents.h>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace vericone::verify {

/// What a method says about a pair of bodies.
struct PlanarAnswer {
  bool answered = false;  // false: the method declined; the rest is not read
  PlanarRelation relation = PlanarRelation::overlapping;
  double theta_b = 0;  // radians; this and psi are read when `relation` is separated
  double psi = 0;      // radians
};

using PlanarMethod = std::function<PlanarAnswer(const Ellipse&, const Ellipse&)>;

/// An error and the pair that has it: planar_pair(family, seed, index).
struct WorstError {
  double error = 0;
  std::uint64_t index = 0;
};

/// One family. Errors are over the pairs that are separated and were said to be; an angle that is not finite
/// counts as an infinite error.
struct PlanarFamilyReport {
  PlanarFamily family = PlanarFamily::regular;
  std::uint64_t seed = 0;
  std::uint64_t cases = 0;      // pairs with indices 0 .. cases - 1
  std::uint64_t separated = 0;  // exactly; the others touch or overlap
  std::uint64_t not_answered = 0;
  std::uint64_t wrong_relations = 0;
  std::uint64_t first_wrong_index = 0;  // of the wrong relations, when there are any
  std::uint64_t first_not_answered_index = 0;
  std::uint64_t compared = 0;  // pairs behind the errors below

  double psi_median_relative = 0;
  WorstError psi_relative;
  WorstError psi_ulps;  // in units of the spacing of doubles at the exact psi
  WorstError theta_b;   // radians, modulo 2 pi
  WorstError edge;      // radians: the worse of theta_b - psi/2 and theta_b + psi/2, taken without rounding
  WorstError edge_over_psi;  // the same as a part of the exact psi
};

/// Runs `method` on the pairs 0 .. cases - 1 of one family. Exceptions of the method pass through. About 2 ms
/// a pair plus the method. Where `stop`, asked between pairs, says so, the report is on those done.
[[nodiscard]] PlanarFamilyReport run_planar_family(const PlanarMethod& method, PlanarFamily family,
                                                   std::uint64_t cases, std::uint64_t seed,
                                                   const std::function<bool()>& stop = {});

/// All families, `cases` pairs of each.
[[nodiscard]] std::vector<PlanarFamilyReport> run_planar_campaign(const PlanarMethod& method,
                                                                  std::uint64_t cases, std::uint64_t seed);

/// A Markdown table, one row a family; the index of the pair behind each worst error stands after a #.
[[nodiscard]] std::string to_markdown(std::span<const PlanarFamilyReport> reports);

/// One JSON object a line; infinite errors are the string "inf".
[[nodiscard]] std::string to_json_lines(std::span<const PlanarFamilyReport> reports);

}  // namespace vericone::verify
