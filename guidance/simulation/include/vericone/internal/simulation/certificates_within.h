// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/simulation/certificate.h>
#include <functional>
#include <vector>

namespace vericone::simulation {

/// certificates() of a run whose bodies' points are known within a radius each, m, beside the scenario's
/// padding; none: it is not. Proofs (run.proofs) hold for the radii already.
[[nodiscard]] RunCertificates certificates_within(const Scenario& scenario, const Run& run,
                                                  const std::vector<double>& radii,
                                                  const std::function<bool(double)>& goes_on);

}  // namespace vericone::simulation
