// SPDX-License-Identifier: GPL-3.0-or-later
#include <vericone/cones/planar/sector.h>
#include <vericone/internal/verify/planar/methods.h>

namespace vericone::verify {
namespace {

PlanarAnswer to_answer(const Sector& sector) {
  PlanarAnswer answer{true, PlanarRelation::overlapping, sector.theta_b, sector.psi};
  if (sector.relation == Relation::disjoint) answer.relation = PlanarRelation::separated;
  if (sector.relation == Relation::touching) answer.relation = PlanarRelation::touching;
  return answer;
}

}  // namespace

PlanarAnswer answer_by_support(const Ellipse& a, const Ellipse& b) {
  return to_answer(sector_by_support(a, b));
}

PlanarAnswer answer_by_degenerate_conics(const Ellipse& a, const Ellipse& b) {
  const std::optional<Sector> sector = sector_by_degenerate_conics(a, b);
  return sector ? to_answer(*sector) : PlanarAnswer{};
}

}  // namespace vericone::verify
