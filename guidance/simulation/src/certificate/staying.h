// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "certificate/planes.h"

namespace vericone::simulation::certified {

/// Not below the distance of any point of the solid from its origin, m, as checkers bound it: of an ellipsoid
/// that of its center and its largest semi-axis.
[[nodiscard]] double reach_of(const Solid& solid);

/// The proof, JSON, that all of question.a stays within question.b, one convex body of points with a margin,
/// which does not turn: the control points of its way, piece by piece, are near to that body's core. Nothing
/// where they are not, on pieces of a millisecond.
[[nodiscard]] std::optional<std::string> proof_of_staying(const PairQuestion& question);

}  // namespace vericone::simulation::certified
