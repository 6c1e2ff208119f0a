// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/geometry/body.h>
#include <algorithm>
#include <optional>

namespace vericone::guidance::banding {

/// One convex piece of an assembly, where the body is.
inline Placed piece_of(const Placed& body, std::size_t i) {
  const Assembly& pieces = *body.body.assembly();
  if (pieces.kind() == PieceKind::convex) return {pieces.convex_piece(i), body.pose};
  HullBody points = pieces.piece(i);
  if (!(pieces.radius() > 0)) return Placed(std::move(points), body.pose);
  const Eigen::Vector3d radii = Eigen::Vector3d::Constant(pieces.radius());
  return Placed(Ellipsoid::from_axes(points.points().front(), radii), body.pose);
}

/// Convex bodies that together are the body, or contain it. use(part, the body that it contains where it is
/// more than that: with its delimiters).
template <typename Use>
void for_each_part(const Placed& body, const Use& use) {
  const auto quadric = [&](const CombinedEllipsoid& part) {
    use(Placed(part.ellipsoid(), body.pose),
        part.is_ellipsoid() ? std::nullopt : std::optional(Placed(part, body.pose)));
  };
  if (const auto* one = body.body.quadric()) return quadric(*one);
  if (body.body.hull() || body.body.convex()) return use(body, std::nullopt);
  if (const auto* all = body.body.quadrics()) {
    std::for_each(all->begin(), all->end(), quadric);
    return;
  }
  for (std::size_t i = 0; i < body.body.assembly()->size(); ++i) use(piece_of(body, i), std::nullopt);
}

}  // namespace vericone::guidance::banding
