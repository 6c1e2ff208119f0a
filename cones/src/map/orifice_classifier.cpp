// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/cones/map/classifiers.h>

#include <vericone/geometry/interval.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "answers/interval_vector.h"
#include "opening/outline.h"

namespace vericone {
namespace {

using Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;

IntervalVector3 intervals(const Vector3d& x) { return {x.x(), x.y(), x.z()}; }
IntervalVector3 difference(const Vector3d& x, const Vector3d& y) {
  return {Interval(x.x()) - y.x(), Interval(x.y()) - y.y(), Interval(x.z()) - y.z()};
}

/// Perpendicular to the wall.
IntervalVector3 wall_normal(const OrificeOracle& oracle) {
  if (oracle.orifice()) return intervals(oracle.orifice()->normal);
  const auto& axes = oracle.placed()->axes;
  return cross(intervals(axes.col(0)), intervals(axes.col(1)));
}

/// A little inside: the point as rounded is one of the agent.
Vector3d farthest_point(const Ellipsoid& agent, const Vector3d& n) {
  const Vector3d u = (agent.factor().transpose() * n).normalized() * (1 - 1e-13);
  return agent.center() + agent.factor() * u;
}

/// Whether a point of the agent, as seen in the wall along the middle of the cell, is outside the opening,
/// and which: the one that looks best.
struct Landing {
  Vector3d point;
  Vector2d outside = Vector2d::Zero();  // of circles and ellipses: towards it, in units of the semi-axes
  Vector2d place = Vector2d::Zero();    // in the opening's plane
  double depth = 0;                     // there; of polygons
};

/// In the opening's own plane the point p lands at x = G (p - center).
Landing best_landing(const OrificeOracle& oracle, const Vector3d& w) {
  const PlacedOpening& placed = *oracle.placed();
  const Opening& opening = placed.opening;
  const Ellipsoid& agent = oracle.agent();
  const Vector3d u = placed.axes.col(0), v = placed.axes.col(1);
  Eigen::Matrix<double, 2, 3> g;
  g.row(0) = v.cross(w) / u.dot(v.cross(w));
  g.row(1) = w.cross(u) / v.dot(w.cross(u));
  if (!opening.polygonal()) g = opening.semi_axes().cwiseInverse().asDiagonal() * g;
  const auto land = [&](const Vector3d& p) -> Vector2d { return g * (p - placed.center); };
  const auto farthest = [&](const Vector2d& out) { return farthest_point(agent, g.transpose() * out); };

  Landing best{agent.center()};
  if (!opening.polygonal()) {
    // Away from the centre of the unit disc, from some starts.
    double most = 0;
    const Vector2d centre = land(agent.center());
    for (Vector2d out : {centre.norm() > 0 ? centre : Vector2d(1, 0), Vector2d(1, 0), Vector2d(0, 1),
                         Vector2d(-1, 0), Vector2d(0, -1)}) {
      for (int step = 0; step < 8; ++step) {
        const Vector3d point = farthest(out);
        out = land(point);
        if (out.norm() > most) {
          most = out.norm();
          best.outside = out / most;
          best.point = point;
        }
      }
    }
    return best;
  }
  // Outwards from edges and from vertices.
  best.place = land(best.point);
  best.depth = opening.depth(best.place);
  const std::vector<Vector2d>& p = opening.vertices();
  const auto outwards = [&](std::size_t i) {
    const Vector2d edge = (p[(i + 1) % p.size()] - p[i]).normalized();
    return Vector2d(edge.y(), -edge.x());
  };
  const auto look = [&](const Vector2d& out) {
    if (!(out.squaredNorm() > 0)) return;
    const Vector3d point = farthest(out);
    const Vector2d place = land(point);
    if (const double depth = opening.depth(place); depth < best.depth)
      best = {point, Vector2d::Zero(), place, depth};
  };
  Vector2d before = outwards(p.size() - 1);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vector2d out = outwards(i);
    look(out);
    look(before + out);
    before = out;
  }
  return best;
}

}  // namespace

Certified OrificeClassifier::classify(const DirectionCell& cell, const Frontier&, Frontier&) const {
  if (oracle_.side() == WallSide::cut) return Certified::undecided;
  const double toward = oracle_.normal().dot(oracle_.center() - oracle_.agent().center()) > 0 ? 1 : -1;
  const IntervalVector3 normal = wall_normal(oracle_);
  int leaving = 0, passing = 0;
  for (const Vector3d& d : cell) {
    leaving += (dot(normal, intervals(d)) * Interval(toward)).hi() <= 0;
    passing += oracle_.transit(d) == Transit::passes;
  }
  if (leaving == 3) return Certified::out;
  if (oracle_.convex()) {
    if (passing == 3) return Certified::out;
  } else if (leaving == 0 && (passing == 3 || passing == 0) && misses_rim(cell)) {
    return passing == 3 ? Certified::out : Certified::in;
  }
  return passing == 0 && leaving == 0 && hits_wall(cell) ? Certified::in : Certified::undecided;
}

bool OrificeClassifier::misses_rim(const DirectionCell& cell) const {
  const PlacedOpening& placed = *oracle_.placed();
  const Ellipsoid& agent = oracle_.agent();
  const Vector3d w = (cell[0] + cell[1] + cell[2]).normalized();
  const AxisFrame seen(w);
  Eigen::Matrix<double, 2, 3> flat;
  flat << seen.e1.transpose(), seen.e2.transpose();
  const Eigen::Matrix<double, 2, 3> f = flat * agent.factor();
  const Eigen::Matrix2d s = f * f.transpose();
  const double l11 = std::sqrt(s(0, 0)), l21 = s(0, 1) / l11, l22 = std::sqrt(s(1, 1) - l21 * l21);
  Eigen::Matrix2d to_disc;
  to_disc << 1 / l11, 0, -l21 / (l11 * l22), 1 / l22;
  const Eigen::Matrix<double, 2, 3> map = to_disc * flat;  // the agent's shadow is the unit disc

  const auto corner = [&](const Vector2d& x) {
    IntervalVector3 at;
    for (int i = 0; i < 3; ++i)
      at[i] = (Interval(placed.center(i)) - agent.center()(i)) + Interval(placed.axes(i, 0)) * x.x() +
              Interval(placed.axes(i, 1)) * x.y();
    return at;
  };
  const auto middle = [&](const IntervalVector3& x) -> Vector2d {
    return map * Vector3d(x[0].mid(), x[1].mid(), x[2].mid());
  };
  IntervalVector3 from = corner(placed.opening.vertices().back());
  for (const Vector2d& x : placed.opening.vertices()) {
    const IntervalVector3 to = corner(x);
    const Vector2d nearest =
        nearest_on_segment<Vector2d>(middle(from), middle(to), Vector2d::Zero()).normalized();
    // Agent and edge are parted by n as long as n.w <= 0: tilted until that holds all over the cell.
    Vector3d n = map.transpose() * nearest;
    double tilt = 0;
    for (const Vector3d& d : cell) tilt = std::max(tilt, n.dot(d) / w.dot(d));
    n -= (tilt * (1 + 1e-12) + 1e-15 * n.norm()) * w;
    const IntervalVector3 plane = intervals(n);
    Interval radius2(0);
    for (int i = 0; i < 3; ++i)
      if (agent.defined_by_factor())
        radius2 = radius2 + square(dot(intervals(agent.factor().col(i)), plane));
      else
        radius2 = radius2 + plane[i] * dot(intervals(agent.shape().col(i)), plane);
    const Interval radius = sqrt(radius2);
    if (!(dot(plane, from) - radius).positive() || !(dot(plane, to) - radius).positive()) return false;
    for (const Vector3d& d : cell)
      if (dot(plane, intervals(d)).hi() > 0) return false;
    from = to;
  }
  return true;
}

bool OrificeClassifier::lands_outside(const DirectionCell& cell) const {
  const PlacedOpening& placed = *oracle_.placed();
  const Opening& opening = placed.opening;
  const Landing landing = best_landing(oracle_, (cell[0] + cell[1] + cell[2]).normalized());
  if (opening.polygonal() ? !(landing.depth < 0) : landing.outside.isZero(0)) return false;
  const IntervalVector3 u = intervals(placed.axes.col(0)), v = intervals(placed.axes.col(1)), n = cross(u, v),
                        p = difference(landing.point, placed.center);
  double spread = 0;
  for (const Vector3d& x : cell) {
    const IntervalVector3 d = intervals(x);
    const Interval along = dot(n, d);
    // On the near side, so it hits the wall.
    if (!((-dot(n, p) / along).lo() >= 0)) return false;
    const Interval a = dot(cross(v, d), p) / along, b = dot(cross(d, u), p) / along;
    if (opening.polygonal()) {
      // The cell's places are in a disc about that of its middle.
      spread = std::max(spread,
                        std::hypot((a - landing.place.x()).magnitude(), (b - landing.place.y()).magnitude()));
    } else {
      // The cell's places are beyond one tangent of the outline.
      const Interval beyond = Interval(landing.outside.x()) * a / opening.semi_axes().x() +
                              Interval(landing.outside.y()) * b / opening.semi_axes().y();
      if (!(beyond.lo() >= landing.outside.norm() * (1 + 1e-15))) return false;
    }
  }
  const double rounding = 1e-13 * (opening.reach() + landing.place.norm());
  return !opening.polygonal() || -landing.depth > spread * (1 + 1e-14) + rounding;
}

bool OrificeClassifier::hits_wall(const DirectionCell& cell) const {
  if (oracle_.placed()) return lands_outside(cell);
  const Ellipsoid& agent = oracle_.agent();
  const Vector3d &o = oracle_.orifice()->center, &normal = oracle_.orifice()->normal;
  const Vector3d w = (cell[0] + cell[1] + cell[2]).normalized(), n = normal.normalized();
  // The shadow of the agent on the wall along w: its point farthest from the opening's centre, in the
  // direction `out`, from some starts. A line n.x = const of the wall and w span a plane; the agent's point
  // farthest along its normal is the one whose shadow is farthest along `out`.
  const auto shadow = [&](const Vector3d& x) -> Vector3d { return x - o - (n.dot(x - o) / n.dot(w)) * w; };
  const auto farthest = [&](const Vector3d& out) -> Vector3d {
    const Vector3d plane = out - (out.dot(w) / n.dot(w)) * n;
    return farthest_point(agent, plane);
  };
  Vector3d best_point = agent.center(), best_out = n.unitOrthogonal();
  double most = 0;
  const Vector3d first = n.unitOrthogonal(), second = n.cross(first);
  const Vector3d centre = shadow(agent.center());
  for (Vector3d out :
       {Vector3d(centre.norm() > 0 ? centre : first), first, second, Vector3d(-first), Vector3d(-second)}) {
    for (int step = 0; step < 8; ++step) {
      const Vector3d point = farthest(out.normalized());
      out = shadow(point);
      if (out.norm() > most) {
        most = out.norm();
        best_out = out / most;
        best_point = point;
      }
    }
  }
  if (!(most >= oracle_.orifice()->radius)) return false;
  // The point is on the near side of the wall, so it hits it at p + t d, t = n.(o - p) / n.d >= 0; beyond the
  // tangent of the rim that is normal to m iff m.(p + t d - o) >= r |m - (m.n) n / n.n|; m as rounded need
  // not be normal to n, and t is eliminated without division.
  Interval p[3], d[3];
  const auto dot3 = [](const Vector3d& a, const Interval(&b)[3]) {
    return Interval(a.x()) * b[0] + Interval(a.y()) * b[1] + Interval(a.z()) * b[2];
  };
  for (int i = 0; i < 3; ++i) p[i] = Interval(o(i)) - Interval(best_point(i));
  const Interval height = dot3(normal, p), beyond = dot3(best_out, p);
  const Interval nn = dot(intervals(normal), intervals(normal)),
                 mn = dot(intervals(best_out), intervals(normal));
  const Interval rim = Interval(oracle_.orifice()->radius) *
                       sqrt(dot(intervals(best_out), intervals(best_out)) - mn * mn / nn);
  return std::all_of(cell.begin(), cell.end(), [&](const Vector3d& x) {
    for (int i = 0; i < 3; ++i) d[i] = Interval(x(i));
    const Interval nd = dot3(normal, d);
    const Interval past = height * dot3(best_out, d) / nd - beyond - rim;
    return (height / nd).lo() >= 0 && past.lo() >= 0;
  });
}

}  // namespace vericone
