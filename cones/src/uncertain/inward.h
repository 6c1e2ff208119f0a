// SPDX-License-Identifier: BSD-3-Clause
//
// Errors as doubles that are surely in their set.
#pragma once

#include <span>

#include "uncertain/engagement.h"

namespace vericone::robust {

/// The mean, with these weights (of sum 1 at most), of the errors that are farthest along these normals,
/// rounded into the set. Zero, which is in every set, where that cannot be proved: of flat sets but boxes.
Vector3d inward(const ErrorSet& set, std::span<const Vector3d> normals, std::span<const double> weights);

}  // namespace vericone::robust
