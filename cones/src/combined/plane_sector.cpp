// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/cones/combined/plane_sector.h>

#include <algorithm>

namespace vericone {

using Eigen::Vector3d;

std::optional<PlaneSector> combined_sector_on(const CombinedOracle& oracle, const Vector3d& e, double width,
                                              EdgeMemory* memory) {
  if (oracle.relation() != Relation::disjoint) return std::nullopt;
  const Vector3d c = oracle.b().center() - oracle.a().center();
  PlaneSector sector;
  sector.distance = c.norm();
  sector.line_of_sight = c.normalized();
  sector.across = e;
  const auto find = [&](GrazingEdge& edge, const Vector3d& side, std::optional<GrazingEdge>* before) {
    const bool known = before && *before;
    const EdgeBracket bracket = oracle.edge(sector.line_of_sight, side, width, known ? &**before : nullptr);
    if (before) *before = bracket.edge;
    if (bracket.edge)
      edge = *bracket.edge;
    else
      edge.angle = bracket.out;
    edge.error = std::max(bracket.out - edge.angle, edge.angle - bracket.in);
    edge.contact = c + edge.on_b - edge.on_a;
  };
  // The plane before may have been this one turned over.
  find(sector.left, e, memory ? &memory->left : nullptr);
  find(sector.right, -e, memory ? &memory->right : nullptr);
  return sector;
}

}  // namespace vericone
