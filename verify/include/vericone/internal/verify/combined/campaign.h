// SPDX-License-Identifier: GPL-3.0-or-later
//
// The certified cones of combined quadrics held against exact polyhedra and against brute force.
#pragma once

#include <vericone/internal/verify/combined/families.h>
#include <vericone/verify/spatial/campaign.h>

#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace vericone::verify {

struct CombinedOptions {
  std::uint64_t cases = 50;
  std::uint64_t seed = 1;
  int directions = 10;                 // of each kind
  int samples = 150;                   // of each boundary
  std::uint64_t fine_every = 8;        // one pair in so many with finer polyhedra
  std::uint64_t bodies_every = 4;      // one pair in so many with chords, planes and times
  double tolerance = 0.05;             // of combined_cone, and a quarter of it for every fourth pair
  std::uint64_t most_boxes = 200'000;  // of combined_cone
  double oracle_tolerance = 1e-6;      // of CombinedOracle
  /// Asked after every pair with the number of pairs done; false ends the run.
  std::function<bool(std::uint64_t)> go_on;
};

/// One family, pairs with indices 0 .. cases - 1. A statement fails where a polyhedron or an exact contact
/// proves the contrary.
struct CombinedFamilyReport {
  CombinedFamily family = CombinedFamily::biconcave;
  std::uint64_t seed = 0, cases = 0;
  std::uint64_t disjoint = 0, overlapping = 0, undecided = 0;
  /// Pairs without two outer polyhedra that are apart: nothing is proved to be out.
  std::uint64_t no_outer = 0;
  /// What the polyhedra said of all directions.
  std::uint64_t proved_in = 0, proved_out = 0, unproved = 0;

  Check relation;    // not the contrary of the polyhedra, of sampled overlap, of where the bodies were put
  Check membership;  // not the contrary of the polyhedra; in where a contact was found
  Check mirrored;    // A and B exchanged and w turned round: not the contrary
  Check inner;       // directions on and within the inner polygon: not out
  Check outer;       // directions beyond the outer polygon: not in
  Check nested;      // inner within outer, star-shaped, areas and bounds consistent
  Check edges;       // not out where a contact is found while closing in on an edge
  Check chords;      // all_in, all_out
  Check planes;      // plane_intervals covers the turn; its intervals' directions
  Check times;       // no contact before time_to_contact, one at its end
  /// Not failures: `in` without a contact found by samples and search, however many, and `undecided`.
  Check confirmed, decided;

  WorstFigure gap;    // (outer - inner) / outer solid angle of combined_cone
  WorstFigure delay;  // contact found after the end of time_to_contact, relative to the time
  double microseconds_membership = 0, milliseconds_cone = 0;  // means of the library's own time
  std::string first_failure;

  [[nodiscard]] std::uint64_t failures() const;
};

/// About 20 ms a pair.
[[nodiscard]] CombinedFamilyReport run_combined_family(CombinedFamily family, const CombinedOptions& options);

/// Two Markdown tables: checks as failed/tried, with the first pair that failed after a #, and figures.
[[nodiscard]] std::string to_markdown(std::span<const CombinedFamilyReport> reports);

}  // namespace vericone::verify
