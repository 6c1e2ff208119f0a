// SPDX-License-Identifier: BSD-3-Clause
//
// Pairs of bodies as they stand in the world, and questions that are asked of two bodies once.
#include <vericone/cones/pair.h>
#include <vericone/internal/cones/combined/cone.h>
#include <vericone/internal/cones/combined/sector.h>
#include <vericone/internal/cones/hulls/hull_oracle.h>
#include <vericone/internal/cones/may_meet.h>

namespace vericone {
namespace {

std::optional<Relation> relation_in_plane(const CombinedEllipse& a, const CombinedEllipse& b,
                                          double tolerance) {
  if (a.is_ellipsoid() && b.is_ellipsoid()) return relation<2>(a.ellipsoid(), b.ellipsoid());
  // The sector is fast and right unless nearer than rounding: that they are apart is proved of the raised
  // bodies, whose relation is theirs.
  const Relation rounded = combined_sector(a, b).sector.relation;
  if (rounded != Relation::disjoint || Pair(a, b, {tolerance}).relation() == Relation::disjoint)
    return rounded;
  return std::nullopt;
}

const Ellipsoid* plain(const WorldBody& body) {
  return body.quadric() && !body.delimited() ? &body.quadric()->ellipsoid() : nullptr;
}

}  // namespace

Pair pair_of(const WorldBody& agent, const WorldBody& obstacle, const PairOptions& options) {
  if (agent.planar() && obstacle.planar()) return Pair(*agent.flat(), *obstacle.flat(), options);
  return Pair(agent.as_placed(), obstacle.as_placed(), options);
}

std::optional<Relation> relation_of(const WorldBody& a, const WorldBody& b, double tolerance) {
  if (a.planar() && b.planar()) return relation_in_plane(*a.flat(), *b.flat(), tolerance);
  if (a.quadric() && b.quadric()) return combined_relation(*a.quadric(), *b.quadric(), tolerance);
  if (a.hull() && b.hull()) return HullOracle(*a.hull(), *b.hull()).relation();
  if (plain(a) && b.hull()) return HullOracle(*plain(a), *b.hull()).relation();
  if (a.hull() && plain(b)) return HullOracle(*plain(b), *a.hull()).relation();
  return pair_of(a, b, {tolerance}).relation();
}

std::optional<bool> may_meet(const WorldBody& a, const WorldBody& b, const Eigen::Vector3d& v_a,
                             const Eigen::Vector3d& v_b) {
  const auto by = [&](const auto& pair) -> std::optional<bool> {
    if (pair.relation() != Relation::disjoint) return std::nullopt;
    return pair.verdict(v_a, v_b) != Verdict::out;
  };
  if (plain(a) && plain(b)) return by(ConeOracle(*plain(a), *plain(b)));
  if (a.quadric() && b.quadric()) return by(CombinedOracle(*a.quadric(), *b.quadric()));
  return by(pair_of(a, b));
}

}  // namespace vericone
