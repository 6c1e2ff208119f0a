// SPDX-License-Identifier: BSD-3-Clause
//
// Quadrics in doubles near given ones. Far from the origin the last entry, of the size |A| |p|^2, holds the
// constant of a body about p to a step of eps |A| |p|^2 only: 0.004 for a body of 1 m at 5e6 m. Its roundings
// are therefore chosen together.
#pragma once

#include <vericone/geometry/exact/rational.h>
#include <vericone/geometry/quadric.h>
#include "proof/rational_quadric.h"

namespace vericone::fitting {

/// Near (x - center)^T A (x - center) + constant. `reach`: how far the body extends from the centre along
/// each coordinate axis.
Quadric rounded_quadric(const exact::RationalMatrix<3>& a, const exact::RationalVector<3>& center,
                        double constant, const Eigen::Vector3d& reach);

/// (z - low)(z - high), scaled to -1 half way.
Quadric slab(double low, double high);

}  // namespace vericone::fitting
