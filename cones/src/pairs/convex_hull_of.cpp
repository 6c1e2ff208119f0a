// SPDX-License-Identifier: BSD-3-Clause
#include "pairs/convex_hull_of.h"

#include <vericone/geometry/assembly.h>
#include <vericone/geometry/error.h>
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
  convex = body.size() == 1;  // every piece is
}

void ConvexHullOf::add_points(std::span<const Eigen::Vector3d> more, const Pose& pose) {
  constexpr std::size_t kMost = 1'000'000;
  if (more.size() > kMost)
    throw InputError("body", "more than " + std::to_string(kMost) + " points", "one of fewer");
  for (const Eigen::Vector3d& x : more) points.push_back(pose.to_world(x));
}

}  // namespace vericone
