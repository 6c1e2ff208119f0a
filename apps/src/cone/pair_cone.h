// SPDX-License-Identifier: BSD-3-Clause
//
// `vericone cone` of two bodies that no other form of answer is for: delimited bodies against bodies of
// pieces, pieces against pieces.
#pragma once

#include <iosfwd>

#include "cone/cone.h"

namespace vericone {

/// Throws InputError naming the option that such a cone does not have.
void run_pair_cone(const ConeCommand& options, const scenes::Scene& scene, std::ostream& out);

}  // namespace vericone
