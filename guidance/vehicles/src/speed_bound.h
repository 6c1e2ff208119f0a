// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/vehicles/fish.h>

namespace vericone::vehicles {

/// Horizontal speed through the water, m/s, that no fish exceeds whatever its tail is told, if it starts with
/// the speed `start` or less and without turning, in water without shear: docs/explanation/fish.md, Limits.
double most_swimming_speed(const FishParameters& fish, double start);

}  // namespace vericone::vehicles
