// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "planar/planar_frame.h"

namespace vericone {

/// Normals of the inner common tangents in the planar frame, B on the positive side, the one with the larger
/// y first.
struct InnerTangents {
  std::array<Eigen::Vector2d, 2> normals;
};

/// Source, 5.2.1 and Algorithm 3, for two disjoint ellipses. Nothing when they are so close that the contact
/// function does not exceed one by more than a few roundings.
std::optional<InnerTangents> inner_tangents_by_degenerate_conics(const PlanarFrame& frame,
                                                                 const ContactFrame<2>& contact);

}  // namespace vericone
