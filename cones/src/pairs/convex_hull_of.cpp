// SPDX-License-Identifier: BSD-3-Clause
#include "pairs/convex_hull_of.h"

#include <vericone/geometry/assembly.h>
#include <vericone/geometry/error.h>
#include <algorithm>
#include <string>
#include <variant>

namespace vericone {

ConvexHullOf::ConvexHullOf(const Placed& placed) {
  std::visit([&](const auto& shape) { add(shape, placed.pose); }, placed.body.shape());
}

void ConvexHullOf::add(const CombinedEllipsoid& body, const Pose& pose) {
  parts.push_back(in_world(body, pose).ellipsoid());
  convex = body.delimiters().empty();
}

void ConvexHullOf::add(const std::vector<CombinedEllipsoid>& pieces, const Pose& pose) {
  for (const CombinedEllipsoid& piece : pieces) add(piece, pose);
  convex = convex && pieces.size() == 1;
}

void ConvexHullOf::add(const HullBody& hull, const Pose& pose) {
  add_points(hull.points(), pose);
  convex = true;
}

void ConvexHullOf::add(const Assembly& body, const Pose& pose) {
  add_points(body.corners(), pose);
  radius = body.radius();
  // Every piece is, but of round parts the corners say more.
  convex = body.size() == 1 && body.kind() != PieceKind::convex;
}

/// Around ellipses and ellipsoids; what has a margin and a round part is one of the ellipsoids that hold it.
void ConvexHullOf::add(const Convex& body, const Pose& pose) {
  add_points(body.corners(), pose);
  radius = body.margin();
  convex = std::all_of(body.pieces().begin(), body.pieces().end(),
                       [](const Convex::Piece& piece) { return piece.rank == 0; });
}

void ConvexHullOf::add_points(std::span<const Eigen::Vector3d> more, const Pose& pose) {
  constexpr std::size_t kMost = 1'000'000;
  if (more.size() > kMost)
    throw InputError("body", "more than " + std::to_string(kMost) + " points", "one of fewer");
  for (const Eigen::Vector3d& x : more) points.push_back(pose.to_world(x));
}

}  // namespace vericone
