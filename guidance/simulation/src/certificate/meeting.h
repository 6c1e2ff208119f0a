// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "certificate/planes.h"

namespace vericone::simulation::certified {

/// The proof, JSON, that at a time of [from, to] two points of them are no farther apart than `by`, whatever
/// the motions within the tubes: of bodies without dents. Found in doubles, with more room than rounding
/// takes. Nothing where none was found at the question's times, nor among some hundred others.
[[nodiscard]] std::optional<std::string> proof_of_nearness(const PairQuestion& question);

}  // namespace vericone::simulation::certified
