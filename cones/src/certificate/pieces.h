// SPDX-License-Identifier: BSD-3-Clause
//
// What proves a verdict about two pieces.
#pragma once

#include <cstddef>
#include <optional>

#include "certificate/prove.h"

namespace vericone::certificates {

/// A piece of each body, in numbers of a grid that all of them need.
struct PairOfPieces {
  const Piece &a, &b;
  const Question& question;
  // Which, of bodies that are said by their pieces.
  std::optional<std::size_t> agent, obstacle;

  [[nodiscard]] int grid() const;
  [[nodiscard]] bool has_dents() const;
  /// Whether one has flat, round and straight parts.
  [[nodiscard]] bool has_convex() const;
};

// Each writes a proof; false where none was found.
bool prove_out(const PairOfPieces& pair, Text& proof);
bool prove_in(const PairOfPieces& pair, Text& proof);
bool prove_on(const PairOfPieces& pair, Text& proof);

/// A plane that keeps them apart.
std::optional<Plane> plane_between(const PairOfPieces& pair);

void write(Text& text, const Plane& plane);

}  // namespace vericone::certificates
