// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/cones/combined/sector.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "answers/elementary.h"
#include "combined/planar_boundary.h"
#include "combined/relation.h"
#include "planar/sector_parts.h"

namespace vericone {
namespace {

using Eigen::Vector2d;
using Corners = SmallList<PlanarBoundary::CornerPoint, 16>;

Vector2d turned_left(const Vector2d& x) { return {-x.y(), x.x()}; }

/// A line along d from a point of A to one of B; the points as offsets from the centres.
struct Candidate {
  Vector2d direction = Vector2d::Zero(), on_a = Vector2d::Zero(), on_b = Vector2d::Zero();
  Touch touch_a, touch_b;
  double rank = -3;  // increases with the signed angle from the line of centres, -2 to 2
};

/// The side of a sector that is looked for: +1 the counter-clockwise one, -1 the other.
struct SectorSide {
  double sign;
  Vector2d c;
  Candidate best;

  void offer(const Candidate& candidate) {
    const double across = sign * cross(c, candidate.direction), along = c.dot(candidate.direction);
    const double sum = std::abs(across) + std::abs(along);
    if (!(sum > 0)) return;
    double rank = across / sum;
    if (along < 0) rank = across >= 0 ? 2 - rank : -2 - rank;
    if (rank > best.rank) {
      best = candidate;
      best.rank = rank;
    }
  }
};

/// The point at which the line through the point `from` (an offset from the ellipse's centre) touches the
/// ellipse that then lies on its right for side = 1, on its left for -1, seen from the point. With
/// v = F^{-1} from, |v| > 1, it is at u = (v -+ root turned(v)) / |v|^2, and the way there is along
/// F(-root v -+ turned(v)), in which nothing cancels however near the point is. Nothing from inside.
struct PointTangent {
  Vector2d point, direction;
};
std::optional<PointTangent> tangent_from(const Vector2d& from, const PlanarBoundary::Round& round,
                                         double side) {
  const Vector2d v = round.inverse * from;
  const double square = v.squaredNorm();
  if (!(square >= 1)) return std::nullopt;
  const double root = std::sqrt(square - 1);
  const double turn = round.factor.determinant() > 0 ? side : -side;
  const Vector2d way = -root * v - turn * turned_left(v);
  return PointTangent{round.factor * ((v - turn * root * turned_left(v)) / square), round.factor * way};
}

class CombinedTangents {
 public:
  CombinedTangents(const CombinedEllipse& a, const CombinedEllipse& b, const Sector& ellipses)
      : a_(a), b_(b), c_(b.center() - a.center()), ellipses_(ellipses) {}

  const PlanarBoundary& a() const { return a_; }
  const PlanarBoundary& b() const { return b_; }

  Candidate edge(double sign) {
    if (const auto tangent = arc_to_arc(sign)) return *tangent;
    collect_corners();
    SectorSide side{sign, c_, {}};
    // On the left edge B lies locally on the right of the line and A on the left.
    for (const auto& p : corners_a_)
      for (const auto& round : b_.rounds())
        if (const auto t = tangent_from(p.offset - c_, round, sign); t && b_.on_body(t->point, round.conic))
          side.offer({t->direction, p.offset, t->point, at_corner(p), at_arc(round), 0});
    for (const auto& q : corners_b_)
      for (const auto& round : a_.rounds())
        if (const auto t = tangent_from(q.offset + c_, round, sign); t && a_.on_body(t->point, round.conic))
          side.offer({-t->direction, t->point, q.offset, at_arc(round), at_corner(q), 0});
    for (const auto& p : corners_a_)
      for (const auto& q : corners_b_)
        side.offer({c_ + (q.offset - p.offset), p.offset, q.offset, at_corner(p), at_corner(q), 0});
    return side.best;
  }

 private:
  static Touch at_corner(const PlanarBoundary::CornerPoint& p) { return {true, p.first, p.second}; }
  static Touch at_arc(const PlanarBoundary::Round& round) { return {false, round.conic, round.conic}; }

  static Vector2d support_offset(const PlanarBoundary::Round& round, const Vector2d& n) {
    return round.factor * (round.factor.transpose() * n).normalized();
  }

  void collect_corners() {
    if (collected_) return;
    corners_a_ = a_.corners();
    corners_b_ = b_.corners();
    collected_ = true;
  }

  /// The inner tangent of two round conics where both touching points are on the bodies. The cone of two
  /// round conics contains that of the bodies, so the first one found is the edge.
  std::optional<Candidate> arc_to_arc(double sign) const {
    const auto take = [&](const Sector& sector, const PlanarBoundary::Round& on_a,
                          const PlanarBoundary::Round& on_b) -> std::optional<Candidate> {
      if (sector.relation == Relation::overlapping) return std::nullopt;
      const SectorEdge& edge = sign > 0 ? sector.left : sector.right;
      // Not from the edge's points, which are rounded where the bodies are far from the origin.
      const Vector2d p = support_offset(on_a, edge.normal), q = support_offset(on_b, -edge.normal);
      if (!a_.on_body(p, on_a.conic) || !b_.on_body(q, on_b.conic)) return std::nullopt;
      return Candidate{edge.direction, p, q, at_arc(on_a), at_arc(on_b), 0};
    };
    for (const auto& on_a : a_.rounds())
      for (const auto& on_b : b_.rounds()) {
        const bool first = on_a.conic == 0 && on_b.conic == 0;
        const auto found =
            take(first ? ellipses_ : sector_by_support(round_ellipse(a_, on_a), round_ellipse(b_, on_b)),
                 on_a, on_b);
        if (found) return found;
      }
    return std::nullopt;
  }

  PlanarBoundary a_, b_;
  Vector2d c_;
  const Sector& ellipses_;
  Corners corners_a_, corners_b_;
  bool collected_ = false;
};

SectorEdge edge_of(const Candidate& found, const CombinedEllipse& a, const CombinedEllipse& b, double sign) {
  SectorEdge edge;
  edge.direction = found.direction.normalized();
  edge.normal = -sign * turned_left(edge.direction);
  edge.point_on_a = a.center() + found.on_a;
  edge.point_on_b = b.center() + found.on_b;
  return edge;
}

/// From the line of centres to the edge: |c| sin = -n.(q - p) with n the inner normal and q, p the touching
/// points from their centres, which keeps the digits of small angles.
double angle_of(const Candidate& found, const SectorEdge& edge, const Vector2d& c) {
  return std::atan2(edge.normal.dot(found.on_a - found.on_b), c.dot(edge.direction));
}

}  // namespace

CombinedSector combined_sector(const CombinedEllipse& a, const CombinedEllipse& b) {
  CombinedSector result;
  const Sector ellipses = sector_by_support(a.ellipsoid(), b.ellipsoid());
  if (a.is_ellipsoid() && b.is_ellipsoid()) {
    result.sector = ellipses;
    return result;
  }
  CombinedTangents tangents(a, b, ellipses);
  if (ellipses.relation != Relation::disjoint && bodies_meet(tangents.a(), tangents.b())) {
    result.sector = overlapping_sector(a.ellipsoid(), b.ellipsoid());
    return result;
  }
  const Candidate left = tangents.edge(1), right = tangents.edge(-1);
  result.left_a = left.touch_a, result.left_b = left.touch_b;
  result.right_a = right.touch_a, result.right_b = right.touch_b;

  Sector& sector = result.sector;
  sector.relation = Relation::disjoint;
  sector.left = edge_of(left, a, b, 1);
  sector.right = edge_of(right, a, b, -1);
  const Vector2d c = b.center() - a.center();
  const double to_left = angle_of(left, sector.left, c), to_right = angle_of(right, sector.right, c);
  sector.psi = to_left + to_right;
  // 0 is in the hull of K iff no half-plane contains K, iff the sector is more than half a turn.
  result.hulls_overlap = sector.psi > std::numbers::pi;
  sector.theta_b =
      std::remainder(std::atan2(c.y(), c.x()) + 0.5 * (to_left - to_right), 2 * std::numbers::pi);
  if (sector.theta_b == -std::numbers::pi) sector.theta_b = std::numbers::pi;
  if (!std::isfinite(c.squaredNorm())) sector.psi = sector.theta_b = std::numeric_limits<double>::quiet_NaN();
  return result;
}

}  // namespace vericone
