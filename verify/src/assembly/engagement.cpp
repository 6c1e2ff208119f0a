// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/engagement.h"

#include <vericone/cones/cone_geometry.h>
#include <vericone/cones/map/cone_map.h>
#include <vericone/internal/verify/spatial/contact_march.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "assembly/distance.h"
#include "assembly/program.h"

namespace vericone::verify {
namespace {

using Eigen::Vector3d;

AssemblyOracle oracle_of(const AssemblyCase& c, const Assembly& assembly) {
  return std::visit([&](const auto& agent) { return AssemblyOracle(agent, assembly); }, c.agent);
}

AssemblyTruth truth_of(const AssemblyCase& c) {
  return std::visit([&](const auto& agent) { return AssemblyTruth(agent, c.pieces()); }, c.agent);
}

double largest(const AssemblyCase& c) {
  double size = 0;
  for (const auto& hull : c.pieces().hulls)
    for (const Vector3d& x : hull) size = std::max(size, x.cwiseAbs().maxCoeff());
  return size;
}

}  // namespace

AssemblyEngagement::AssemblyEngagement(const AssemblyCase& c, const AssemblyCase& told, std::uint64_t index,
                                       AssemblyReport& report)
    : case_(c),
      index_(index),
      report_(report),
      random_(970, report.seed, index),
      assembly_(told.assembly()),
      oracle_(oracle_of(told, assembly_)),
      truth_(truth_of(c)),
      size_(largest(c)) {}

void AssemblyEngagement::expect(Check& check, bool holds, const char* what, const Vector3d& w) {
  check.note(holds, index_);
  std::string& first = &check == &report_.tight ? report_.first_loose : report_.first_failure;
  if (holds || !first.empty()) return;
  char text[300];
  std::snprintf(text, sizeof text, "%s, %s pieces, seed %llu, case %llu (%s): %s, w = (%a, %a, %a)",
                to_string(report_.agent), to_string(report_.pieces),
                static_cast<unsigned long long>(report_.seed), static_cast<unsigned long long>(index_),
                to_string(case_.variation), what, w.x(), w.y(), w.z());
  first = text;
}

bool AssemblyEngagement::relation() {
  const Relation truth = truth_.relation();
  ++report_.relations[static_cast<std::size_t>(truth)];
  expect(report_.relation, oracle_.relation() == truth, "relation", Vector3d::Zero());
  if (truth == Relation::disjoint) return true;
  const Verdict expected = truth == Relation::touching ? Verdict::touching : Verdict::overlapping;
  const Vector3d w = case_.velocities.front();
  expect(report_.membership, oracle_.verdict(w, Vector3d::Zero()) == expected, "verdict", w);
  expect(report_.membership, oracle_.membership(w) == Membership::in, "membership, not disjoint", w);
  const auto now = oracle_.first_contact(w);
  expect(report_.contact, now && now->time == 0 && now->earliest == 0, "contact now", w);
  const AssemblyMiss miss = oracle_.miss_distance(w);
  expect(report_.miss, miss.least == 0 && miss.most <= 1e-9 * (size_ + case_.agent_size()), "miss now", w);
  return false;
}

void AssemblyEngagement::velocities() {
  for (const Vector3d& w : case_.velocities) {
    const Membership truth = truth_.membership(w);
    ++report_.memberships[static_cast<std::size_t>(truth)];
    expect(report_.membership, oracle_.membership(w) == truth, "membership", w);
    contact(w, truth);
    miss(w, truth);
    // w as an exact difference of velocities: w + u - u, where that does not round.
    const Vector3d u = Vector3d(3, -5, 7), v = w + u;
    if (v - u == w && v - w == u)
      expect(report_.membership, oracle_.membership(v, u) == truth, "membership of a difference", w);
  }
  const Vector3d still = Vector3d::Zero();
  expect(report_.membership, oracle_.membership(still) == Membership::out, "standing still", still);
  miss(still, Membership::out);
}

void AssemblyEngagement::contact(const Vector3d& w, Membership truth) {
  const auto found = oracle_.first_contact(w);
  expect(report_.contact, found.has_value() == (truth != Membership::out), "contact or none", w);
  if (!found || truth == Membership::out) return;
  expect(report_.contact,
         0 <= found->earliest && found->earliest <= found->time && found->time <= found->latest &&
             std::isfinite(found->time),
         "times in order", w);
  if (truth == Membership::in && std::isfinite(found->latest))
    report_.contact_width.raise((found->latest - found->earliest) / found->latest, index_);
  contact_point(w, *found);
  if (case_.kind == PieceKind::ball && report_.agent == AgentKind::ellipsoid) return march(w, *found);
  if (found->earliest > 0)
    expect(report_.contact,
           truth_.touched(Motion::until(std::nextafter(found->earliest, 0), w)) == Membership::out,
           "nothing touched before", w);
  if (std::isfinite(found->latest)) {
    // A hull without interior never overlaps a plate; that it has met one is all there is.
    const Membership then = truth_.touched(Motion::at(found->latest, w)),
                     until = truth_.touched(Motion::until(found->latest, w));
    const bool flat = report_.agent == AgentKind::hull;
    expect(report_.contact, flat ? until != Membership::out : then == Membership::in, "overlap at latest", w);
  }
  expect(report_.contact,
         found->piece < truth_.size() && truth_.touched(found->piece, Motion::ray(w)) != Membership::out,
         "the piece is one that is touched", w);
}

void AssemblyEngagement::march(const Vector3d& w, const AssemblyContact& found) {
  double first = INFINITY, head_on = 1;
  const auto& agent = std::get<Ellipsoid>(case_.agent);
  for (const Vector3d& x : case_.points) {
    if (case_.radius == 0) return;
    const auto r =
        ContactMarch(agent, Ellipsoid::from_axes(x, Vector3d::Constant(case_.radius))).first_contact(w);
    if (r.time && *r.time < first) {
      first = *r.time;
      head_on = r.closing;
    }
  }
  if (!(head_on > 1e-3)) return;
  const double slack = 1e-8 * (first + size_ / w.norm() * 1e-3) / head_on;
  expect(report_.contact, found.earliest <= first + slack && first - slack <= found.latest, "march", w);
}

void AssemblyEngagement::contact_point(const Vector3d& w, const AssemblyContact& found) {
  if (found.piece >= truth_.size()) return;
  expect(report_.contact_point, std::abs(found.normal.norm() - 1) < 1e-9, "unit normal", w);
  const auto pieces = case_.pieces();
  const double slack = 1e-9 * (size_ + case_.agent_size() + found.time * w.norm());
  const std::vector<Vector3d> point{found.point};
  expect(report_.contact_point,
         compare_reach(point, pieces.hulls[found.piece], Motion{}, {pieces.radius, slack}) >= 0,
         "point of the piece", w);
  // On the agent where it is then, as well as the time is known.
  if (!std::isfinite(found.latest)) return;
  const double moved = (found.latest - found.earliest) * w.norm();
  if (const auto* e = std::get_if<Ellipsoid>(&case_.agent)) {
    const Vector3d y = found.point - found.time * w - e->center();
    const double ratio = e->semi_axes().maxCoeff() / e->semi_axes().minCoeff();
    const double gauge = e->factor().partialPivLu().solve(y).norm();
    expect(report_.contact_point,
           std::abs(gauge - 1) < 1e-6 + (slack * ratio * 10 + moved) / e->semi_axes().minCoeff(),
           "point of the agent", w);
  } else {
    const auto& hull = std::get<HullBody>(case_.agent).points();
    const std::vector<Vector3d> back{found.point - found.time * w};
    expect(report_.contact_point, compare_reach(back, hull, Motion{}, {slack, moved}) >= 0,
           "point of the agent", w);
  }
}

void AssemblyEngagement::miss(const Vector3d& w, Membership truth) {
  const double tolerance = 1e-9;
  const AssemblyMiss found = oracle_.miss_distance(w, tolerance);
  const double lengths = found.most + case_.agent_size();
  expect(report_.miss, 0 <= found.least && found.least <= found.most && found.time >= 0, "miss: order", w);
  expect(report_.tight, found.most - found.least <= 1.0000001 * tolerance * lengths, "miss: tolerance", w);
  if (truth != Membership::out) expect(report_.miss, found.least == 0, "miss of what is met", w);
  const Motion motion = w.isZero(0) ? Motion{} : Motion::ray(w);
  if (truth_.euclidean()) {
    // Above 0 the pieces grown by it are at most touched.
    if (found.least > 0)
      expect(report_.miss, truth_.touched(motion, found.least) != Membership::in, "miss: least", w);
    expect(report_.miss, truth_.touched(motion, found.most) != Membership::out, "miss: most", w);
    return;
  }
  double low = INFINITY, high = INFINITY;
  const auto& agent = std::get<Ellipsoid>(case_.agent);
  for (const auto& hull : case_.pieces().hulls) {
    const DistanceBounds d = ellipsoid_distance(agent, hull, w);
    low = std::min(low, std::max(0.0, d.low - case_.radius));
    high = std::min(high, std::max(0.0, d.high - case_.radius));
  }
  const double slack = 1e-9 * (lengths + size_ * 1e-3);
  expect(report_.miss, found.least <= high + slack && found.most >= low - slack, "miss: bounds", w);
}

void AssemblyEngagement::extremes() {
  for (int k = 0; k < 3; ++k) {
    // Exact half-planes along the axes of coordinates.
    Vector3d axis = Vector3d::Zero(), side = Vector3d::Zero();
    const int i = random_.integer(0, 2), j = (i + random_.integer(1, 2)) % 3;
    axis(i) = random_.coin() ? 1 : -1;
    side(j) = random_.coin() ? 1 : -1;
    half_plane(axis, side);
  }
  ring();
}

void AssemblyEngagement::ring() {
  const Vector3d axis = random_.direction<3>();
  const AxisFrame frame(axis);
  const int planes = random_.integer(3, 12);
  const auto found = oracle_.extremes(axis, planes);
  // Pieces that graze exactly may fall to either side of a half-plane that is rounded.
  const bool whole = case_.variation == AssemblyVariation::regular ||
                     case_.variation == AssemblyVariation::thin ||
                     case_.variation == AssemblyVariation::enclosing;
  for (int k = 0; k < planes; ++k) {
    const double turn = 2 * std::numbers::pi * k / planes;
    const Vector3d side = std::cos(turn) * frame.e1 + std::sin(turn) * frame.e2;
    const ExtremeDirection &e = found[static_cast<std::size_t>(k)], alone = oracle_.extreme(axis, side);
    if (e.any)
      expect(report_.extreme, truth_.membership(e.direction) != Membership::out, "ring: low", e.direction);
    if (whole)
      expect(report_.extreme, e.any == alone.any && e.low <= alone.high + 1e-9 && alone.low <= e.high + 1e-9,
             "ring: as alone", side);
  }
}

void AssemblyEngagement::half_plane(const Vector3d& axis, const Vector3d& side) {
  const bool whole = case_.kind != PieceKind::ball || truth_.euclidean();  // sectors are decided
  const double tolerance = 1e-4;
  const ExtremeDirection found = oracle_.extreme(axis, side, tolerance);
  const auto at = [&](double t) { return Vector3d(std::cos(t) * axis + std::sin(t) * side); };
  const auto sector = [&](double from) {
    // Two of less than half a turn.
    const double middle = 0.5 * (from + std::numbers::pi);
    const Membership first = truth_.touched(Motion::any_of({from > 0 ? at(from) : axis, at(middle)}));
    const Membership second = truth_.touched(Motion::any_of({at(middle), Vector3d(-axis)}));
    return first == Membership::in || second == Membership::in ? Membership::in
           : first == Membership::on                           ? first
                                                               : second;
  };
  if (found.any) {
    expect(report_.extreme, found.low <= found.high, "extreme: order", side);
    expect(report_.tight, found.high - found.low <= 1.0000001 * tolerance, "extreme: tolerance", side);
    expect(report_.extreme, (found.direction - at(found.low)).norm() < 1e-12, "extreme: direction", side);
    expect(report_.extreme, truth_.membership(found.direction) != Membership::out, "extreme: low",
           found.direction);
  } else if (found.high > 0 && whole) {
    // Nothing found and something left open: only where the half-plane grazes at most.
    expect(report_.tight, sector(0) != Membership::in, "extreme: none found", side);
  }
  const double from = found.high > 0 ? found.high + 1e-15 : 0;
  if (from >= std::numbers::pi - 1e-12) return;
  if (whole) {
    expect(report_.extreme, sector(from) == Membership::out, "extreme: high", side);
  } else {
    for (int k = 0; k < 5; ++k) {
      const double t = k ? random_.uniform(from, std::numbers::pi) : from;
      expect(report_.extreme, truth_.membership(at(t)) == Membership::out, "extreme: beyond", at(t));
    }
  }
}

void AssemblyEngagement::map() {
  ConeMapOptions coarse;
  coarse.resolution = 0.3;
  const ConeMap map = cone_map(oracle_, coarse);
  const bool whole = case_.kind != PieceKind::ball || truth_.euclidean();
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const DirectionCell cell = map.cell(i);
    if (map.cells[i].label == Certified::out) {
      if (whole)
        expect(report_.map_out,
               truth_.touched(Motion::any_of({cell[0], cell[1], cell[2]})) == Membership::out, "cell out",
               cell[0]);
      else
        expect(report_.map_out, truth_.membership(cell[0]) == Membership::out, "cell out", cell[0]);
    } else if (map.cells[i].label == Certified::in) {
      Vector3d inside = Vector3d::Zero();
      for (const Vector3d& d : cell) inside += random_.uniform(0, 1) * d;
      for (const Vector3d& d : {cell[0], cell[1], cell[2]})
        expect(report_.map_in, truth_.membership(d) != Membership::out, "cell in, corner", d);
      expect(report_.map_in, truth_.membership(inside) != Membership::out, "cell in", inside);
    }
  }
}

}  // namespace vericone::verify
