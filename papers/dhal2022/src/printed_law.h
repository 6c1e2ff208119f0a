// SPDX-License-Identifier: BSD-3-Clause
//
// The cooperative law (6.19), flown as it is printed: the library has the corrected one only.
#pragma once

#include <vericone/simulation/proof.h>
#include <vericone/simulation/scenario.h>

namespace vericone::dhal2022 {

enum class Print { as_printed, corrected };

/// A and B of a scenario (its first and second body) fly with (6.19) until `duration`, on the plane of the
/// largest psi of slices, ceasing at y >= 0; the gains are the caller's, the limit, mu and the step the
/// scenario's. Returns what is proved of the two.
simulation::PairProof fly_6_19(const simulation::Scenario& scenario, Print print, double gain,
                               double reference, double duration);

}  // namespace vericone::dhal2022
