// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "combined/planar_boundary.h"

namespace vericone {

/// Whether two planar bodies have a common point; asked where their ellipses are not disjoint. True is proved
/// by a point; false is right unless the bodies come nearer than rounding.
bool bodies_meet(const PlanarBoundary& a, const PlanarBoundary& b);

}  // namespace vericone
