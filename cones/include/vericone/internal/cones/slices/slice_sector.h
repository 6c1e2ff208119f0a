// SPDX-License-Identifier: BSD-3-Clause
//
// One slice of a cone.
#pragma once

#include <vericone/cones/slices/slice_cone.h>

namespace vericone {

/// The sector of the sections on the plane spanned by the line of centres and `across` (any vector not
/// parallel to it). Throws InputError naming "across", or "bodies" where they are not disjoint.
[[nodiscard]] Slice slice_sector(const Ellipsoid& a, const Ellipsoid& b, const Eigen::Vector3d& across);

}  // namespace vericone
