// SPDX-License-Identifier: BSD-3-Clause
#include "pairs/sectors.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

#include "pairs/family.h"

namespace vericone::pairs {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

constexpr double kEdge = 1e-9;    // rad, to which edges of exact pairs are looked for
constexpr int kMostCells = 4000;  // a half-plane; what is left then is not known to miss
constexpr int kParts = 8;         // of a half-plane: cells are less than a right angle wide

/// A sliver beside an arc, which its first two corners bound. The third one comes nearer by a quarter as the
/// arc is halved, so that the parts of a cell lie in it.
struct Arc {
  DirectionCell cell;
  double from, to;  // rad
  Frontier known;

  /// `angle_of`: of a direction; that of the middle corner is not quite half way.
  template <typename Angle>
  Arc part(bool outer, const Angle& angle_of) const {
    const Vector3d middle = 0.5 * (cell[0] + cell[1]);
    const double at = angle_of(middle);
    if (outer) return {{middle, cell[1], 0.25 * (2 * middle + cell[1] + cell[2])}, at, to, known};
    return {{cell[0], middle, 0.25 * (cell[0] + 2 * middle + cell[2])}, from, at, known};
  }
};

HalfPlaneReach reach_of(const Family& family, const DirectionClassifier& cells, const Vector3d& u,
                        const Vector3d& side) {
  const Vector3d p = u.cross(side);
  // A certified pair leaves about its tolerance undecided, and what it can prove there costs more and more.
  const double edge = std::max(kEdge, 0.1 * family.guarantee().tolerance);
  const auto direction = [&](double angle) -> Vector3d {
    return std::cos(angle) * u + std::sin(angle) * side;
  };
  const auto angle_of = [&](const Vector3d& d) { return std::atan2(d.dot(side), d.dot(u)); };
  HalfPlaneReach reach;
  const auto collides = [&](double angle) {
    const Verdict verdict = family.verdict(direction(angle), Vector3d::Zero());
    return verdict == Verdict::in || verdict == Verdict::on;
  };
  std::vector<Arc> arcs;
  for (int i = 0; i < kParts; ++i) {
    const double from = pi * i / kParts, to = pi * (i + 1) / kParts;
    constexpr double kLength = 0.999;
    const Vector3d beside = (direction(0.5 * (from + to)) + 1e-2 * p).normalized();
    arcs.push_back(
        {{kLength * direction(from), kLength * direction(to), kLength * beside}, from, to, cells.start()});
  }
  // From the outside inwards: the first arc that is not known to miss ends it.
  for (int count = 0; !arcs.empty(); ++count) {
    Arc arc = std::move(arcs.back());
    arcs.pop_back();
    Frontier own;
    if (count < kMostCells && cells.misses(arc.cell, arc.known, own)) continue;
    if (count >= kMostCells || arc.to - arc.from <= edge) {
      reach.high = arc.to;
      break;
    }
    arc.known = std::move(own);
    arcs.push_back(arc.part(false, angle_of));
    arcs.push_back(arc.part(true, angle_of));
  }
  // Inwards by steps that double until one collides, then back.
  double missing = reach.high;
  for (double step = edge; missing > 0 && !reach.any; step *= 2) {
    const double at = std::max(reach.high - step, 0.0);
    reach.any = collides(at);
    (reach.any ? reach.low : missing) = at;
  }
  while (reach.any && missing - reach.low > edge && missing - reach.low > 1e-3 * (reach.high - reach.low)) {
    const double at = 0.5 * (reach.low + missing);
    (collides(at) ? reach.low : missing) = at;
  }
  return reach;
}

}  // namespace

std::optional<PlaneSector> sector_by_arcs(const Family& family, const SightLine& line, const Vector3d& e) {
  const auto cells = family.directions();
  const auto reach = [&](const Vector3d& axis, const Vector3d& side) {
    return reach_of(family, *cells, axis, side);
  };
  const auto passing = [&](const Vector3d& direction) { return family.passing(direction); };
  return sector_of_half_planes(line.from, line.to, e, reach, passing);
}

PlaneSector mirror_image(PlaneSector sector) {
  sector.line_of_sight *= -1;
  sector.across *= -1;
  for (PlaneSector::Edge* edge : {&sector.left, &sector.right}) {
    std::swap(edge->on_a, edge->on_b);
    std::swap(edge->touched_a, edge->touched_b);
    edge->contact *= -1;
    edge->normal *= -1;
  }
  return sector;
}

}  // namespace vericone::pairs
