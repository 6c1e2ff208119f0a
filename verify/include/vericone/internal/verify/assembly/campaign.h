// SPDX-License-Identifier: GPL-3.0-or-later
//
// AssemblyOracle and cone maps held against exact answers of every piece.
#pragma once

#include <vericone/internal/verify/assembly/families.h>
#include <vericone/verify/spatial/campaign.h>

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace vericone::verify {

struct AssemblyOptions {
  std::uint64_t cases = 100;
  std::uint64_t seed = 1;
  std::uint64_t extremes_every = 2;  // one case in so many with half-planes
  std::uint64_t maps_every = 16;     // one case in so many with a cone map
  bool without_last_piece = false;   // a broken library: what it is told lacks a piece
  std::function<bool()> stop;  // asked between cases; true ends the run early, with a report on those done
};

/// One kind of agent and of pieces, cases with indices 0 .. cases - 1.
struct AssemblyReport {
  AgentKind agent = AgentKind::ball;
  PieceKind pieces = PieceKind::triangle;
  std::uint64_t seed = 0, cases = 0;
  std::array<std::uint64_t, 3> relations{};    // disjoint, touching, overlapping
  std::array<std::uint64_t, 3> memberships{};  // in, on, out
  std::uint64_t exact = 0;                     // pieces that the oracle here decided in exact arithmetic

  Check relation;
  Check membership;  // and verdict, of w and of differences of velocities
  /// An answer iff the agent meets; nothing touched before `earliest`, overlap at `latest`, in exact
  /// arithmetic (an ellipsoid and balls: against a march, to 1e-9); the time between; the piece touched.
  Check contact;
  Check contact_point;  // within 1e-9 of the lengths involved of the piece and of the agent
  /// least <= true distance <= most in exact arithmetic, for ball and hull agents; for other ellipsoids
  /// against bounds in doubles, to 1e-9.
  Check miss;
  /// A direction met at `low`; nothing between `high` (1e-15 rad beyond) and the half-plane's end.
  Check extreme;
  /// Not a failure: widths of miss_distance and extreme beyond the tolerance asked for, half-planes with
  /// neither a hit nor a proof.
  Check tight;
  /// Cells: out proved of the whole cell in exact arithmetic; in at its corners and random places.
  Check map_out, map_in;
  WorstFigure contact_width;               // (latest - earliest) / latest of contacts that do not graze
  std::string first_failure, first_loose;  // of `tight`

  [[nodiscard]] std::uint64_t failures() const;
};

[[nodiscard]] AssemblyReport run_assembly_family(AgentKind agent, PieceKind pieces,
                                                 const AssemblyOptions& options);

/// Markdown: checks as failed/tried, with the first case that failed after a #, and figures.
[[nodiscard]] std::string to_markdown(std::span<const AssemblyReport> reports);

}  // namespace vericone::verify
