// SPDX-License-Identifier: BSD-3-Clause
#include "round/exact.h"

#include <vericone/internal/geometry/requires.h>

#include "round/normals.h"
#include "round/silhouette.h"

namespace vericone::round {
namespace {

LatticePiece on_lattice(const ExactPiece& piece) {
  LatticePiece r{piece.center, piece.shape, false};
  for (const auto& row : piece.shape)
    for (const Integer& x : row) r.round = r.round || x != 0;
  return r;
}

LatticeDifference difference(const ExactBody& agent, const ExactBody& obstacle, const Integer& margin) {
  VERICONE_REQUIRES(!agent.pieces.empty() && !obstacle.pieces.empty() && margin >= 0);
  LatticeDifference k;
  for (const ExactPiece& piece : obstacle.pieces) k.obstacle.push_back(on_lattice(piece));
  for (const ExactPiece& piece : agent.pieces) {
    k.agent.push_back(on_lattice(piece));
    for (Integer& x : k.agent.back().p) x = -x;
  }
  k.squared_margin = margin * margin;
  return k;
}

Membership line_meets(const LatticeDifference& k, const IntegerVector<3>& w) {
  const Plane plane(w);
  switch (least_support_sign(k, plane.u, plane.v)) {
    case 1:
      return Membership::in;
    case 0:
      return Membership::on;
    default:
      return Membership::out;
  }
}

}  // namespace

bool separates(const ExactBody& agent, const ExactBody& obstacle, const Integer& margin,
               const IntegerVector<3>& n) {
  return support_sign(difference(agent, obstacle, margin), {-n[0], -n[1], -n[2]}) < 0;
}

Membership line_meets(const ExactBody& agent, const ExactBody& obstacle, const Integer& margin,
                      const IntegerVector<3>& w) {
  return line_meets(difference(agent, obstacle, margin), w);
}

std::optional<Membership> exact_membership(const ExactBody& agent, const ExactBody& obstacle,
                                           const Integer& margin, const IntegerVector<3>& w) {
  const auto k = difference(agent, obstacle, margin);
  const Membership line = line_meets(k, w);
  if (line == Membership::out) return line;
  const Place place = place_of_origin(k);
  if (place.relation != Relation::disjoint) return std::nullopt;
  // n.x < 0 on all of K.
  const IntegerVector<3>& n = place.normal;
  return Integer(n[0] * w[0] + n[1] * w[1] + n[2] * w[2]) < 0 ? line : Membership::out;
}

std::optional<Relation> exact_relation(const ExactBody& agent, const ExactBody& obstacle,
                                       const Integer& margin) {
  return place_of_origin(difference(agent, obstacle, margin)).relation;
}

}  // namespace vericone::round
