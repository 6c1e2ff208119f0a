// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/geometry/body.h>
#include <vericone/geometry/error.h>
#include <algorithm>
#include <optional>
#include <string>

namespace vericone::guidance::banding {

/// Of cylinders and other bodies of flat, round and straight parts no question is asked here yet.
inline void refuse_round_parts(const Body& body, const std::string& field = "body") {
  const Assembly* pieces = body.assembly();
  if (body.convex() || (pieces && pieces->kind() == PieceKind::convex))
    throw InputError(field, "one with round parts beside others, or a margin",
                     "an ellipsoid, a hull, or a union of them");
}

/// One convex piece of an assembly, where the body is.
inline Placed piece_of(const Placed& body, std::size_t i) {
  const Assembly& pieces = *body.body.assembly();
  HullBody points = pieces.piece(i);
  if (!(pieces.radius() > 0)) return Placed(std::move(points), body.pose);
  const Eigen::Vector3d radii = Eigen::Vector3d::Constant(pieces.radius());
  return Placed(Ellipsoid::from_axes(points.points().front(), radii), body.pose);
}

/// Convex bodies that together are the body, or contain it. use(part, the body that it contains where it is
/// more than that: with its delimiters).
template <typename Use>
void for_each_part(const Placed& body, const Use& use) {
  refuse_round_parts(body.body);
  const auto quadric = [&](const CombinedEllipsoid& part) {
    use(Placed(part.ellipsoid(), body.pose),
        part.is_ellipsoid() ? std::nullopt : std::optional(Placed(part, body.pose)));
  };
  if (const auto* one = body.body.quadric()) return quadric(*one);
  if (body.body.hull()) return use(body, std::nullopt);
  if (const auto* all = body.body.quadrics()) {
    std::for_each(all->begin(), all->end(), quadric);
    return;
  }
  for (std::size_t i = 0; i < body.body.assembly()->size(); ++i) use(piece_of(body, i), std::nullopt);
}

}  // namespace vericone::guidance::banding
