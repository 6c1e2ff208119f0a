// SPDX-License-Identifier: BSD-3-Clause
#include "pairs/convex_hull_of.h"

#include <vericone/geometry/assembly.h>
#include <vericone/geometry/error.h>
#include <string>

namespace vericone {

template <typename Points>
void ConvexHullOf::add(const Points& more, const Pose& pose) {
  constexpr std::size_t kMost = 1'000'000;
  if (points.size() + more.size() > kMost)
    throw InputError("body", "more than " + std::to_string(kMost) + " points", "one of fewer");
  for (const Eigen::Vector3d& x : more) points.push_back(pose.to_world(x));
}

ConvexHullOf::ConvexHullOf(const Placed& placed) {
  const auto& shape = placed.body.shape();
  if (const auto* one = std::get_if<CombinedEllipsoid>(&shape)) {
    parts.push_back(in_world(*one, placed.pose).ellipsoid());
    convex = one->delimiters().empty();
  } else if (const auto* hull = std::get_if<HullBody>(&shape)) {
    add(hull->points(), placed.pose);
    convex = true;
  } else if (const auto* many = std::get_if<std::vector<CombinedEllipsoid>>(&shape)) {
    for (const CombinedEllipsoid& piece : *many) parts.push_back(in_world(piece, placed.pose).ellipsoid());
    convex = many->size() == 1 && many->front().delimiters().empty();
  } else {
    const auto& assembly = std::get<Assembly>(shape);
    const Assembly::Storage& by_slot = assembly.by_slot();
    for (const auto& triangle : by_slot.triangles) add(triangle, placed.pose);
    add(by_slot.balls, placed.pose);
    for (const Box& box : by_slot.boxes) add(HullBody::box(box.low, box.high).points(), placed.pose);
    for (const HullBody& piece : by_slot.hulls) add(piece.points(), placed.pose);
    radius = assembly.radius();
    convex = assembly.size() == 1;  // every piece is
  }
}

}  // namespace vericone
