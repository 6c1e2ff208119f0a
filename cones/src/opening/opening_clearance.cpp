// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/opening/opening.h>

#include <vericone/cones/cone_geometry.h>
#include <vericone/geometry/error.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "opening/outline.h"

namespace vericone {
namespace {

using Eigen::Matrix2d, Eigen::Vector2d, Eigen::Vector3d;
using AcrossFrame = Eigen::Matrix<double, 3, 2>;

/// A quarter turn counterclockwise.
Vector2d turned_left(const Vector2d& n) { return {-n.y(), n.x()}; }

// Shadows of agents on the plane perpendicular to w, about that of a point in their middle.

class EllipsoidShadow {
 public:
  static constexpr bool kSmooth = true;
  EllipsoidShadow(const Ellipsoid& agent, const AcrossFrame& frame) : agent_(agent) {
    // A square factor with the same shape, by Gram-Schmidt on the rows.
    const Eigen::Matrix<double, 2, 3> f = frame.transpose() * agent.factor();
    const double l11 = f.row(0).norm(), l21 = f.row(1).dot(f.row(0)) / l11;
    factor_ << l11, 0, l21, (f.row(1) - (l21 / l11) * f.row(0)).norm();
  }
  [[nodiscard]] const Vector3d& middle() const { return agent_.center(); }
  [[nodiscard]] Vector2d farthest(const Vector2d& n) const {
    const Vector2d u = factor_.transpose() * n;
    return factor_ * (u / u.norm());
  }
  [[nodiscard]] Vector3d in_space(const Vector3d& n) const { return agent_.support_point(n); }
  /// Of the direction in which it is thin.
  [[nodiscard]] double thin_angle() const {
    const Matrix2d s = factor_ * factor_.transpose();
    return 0.5 * (std::atan2(2 * s(0, 1), s(0, 0) - s(1, 1)) + std::numbers::pi);
  }
  /// The unit n with the largest n.x - h(n).
  [[nodiscard]] Vector2d towards(const Vector2d& x) const {
    const Matrix2d s = factor_ * factor_.transpose();
    const double angle = 0.5 * std::atan2(2 * s(0, 1), s(0, 0) - s(1, 1));
    Matrix2d turn;
    turn << std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle);
    const Vector2d axes = (turn * factor_).rowwise().norm();
    const Vector2d near = nearest_on_ellipse(axes, turn * x);
    return (turn.transpose() * near.cwiseQuotient(axes.cwiseAbs2())).normalized();
  }

 private:
  const Ellipsoid& agent_;
  Matrix2d factor_;
};

class HullShadow {
 public:
  static constexpr bool kSmooth = false;
  HullShadow(const WorldBody& agent, const AcrossFrame& frame) : agent_(agent), frame_(frame) {
    Vector3d low, high;
    for (int i = 0; i < 3; ++i) {
      high(i) = in_space(Vector3d::Unit(i))(i);
      low(i) = in_space(-Vector3d::Unit(i))(i);
    }
    middle_ = 0.5 * low + 0.5 * high;
  }
  [[nodiscard]] const Vector3d& middle() const { return middle_; }
  [[nodiscard]] Vector2d farthest(const Vector2d& n) const {
    return frame_.transpose() * (in_space(frame_ * n) - middle_);
  }
  [[nodiscard]] Vector3d in_space(const Vector3d& n) const { return *agent_.support_point(n); }
  /// The largest of n.x - h(n) has its slope fall through zero: from a grid, then by halving.
  [[nodiscard]] Vector2d towards(const Vector2d& x) const {
    constexpr int kGrid = 32;
    Vector2d best(1, 0);
    double most = -std::numeric_limits<double>::infinity();
    const auto value = [&](const Vector2d& n) { return n.dot(x - farthest(n)); };
    const auto at = [](double t) { return Vector2d(std::cos(t), std::sin(t)); };
    double angle = 0;
    for (int i = 0; i < kGrid; ++i) {
      const double t = 2 * std::numbers::pi * i / kGrid;
      if (const double v = value(at(t)); v > most) {
        most = v;
        angle = t;
      }
    }
    double low = angle - 2 * std::numbers::pi / kGrid, high = angle + 2 * std::numbers::pi / kGrid;
    for (int i = 0; i < 50; ++i) {
      const double t = 0.5 * (low + high);
      best = at(t);
      (turned_left(best).dot(x - farthest(best)) > 0 ? low : high) = t;
    }
    return best;
  }

 private:
  const WorldBody& agent_;
  AcrossFrame frame_;
  Vector3d middle_;
};

/// The least found so far. Of circles and ellipses n says it all; of polygons the rim point is on an edge.
struct Least {
  double distance = std::numeric_limits<double>::infinity();
  Vector2d normal = Vector2d(1, 0);
  std::size_t from = 0;  // the edge of the rim point, by the vertex it starts from
  double along = 0;      // where on that edge, 0 to 1
};

/// A direction, and the points of the two shadows that are farthest along it.
struct Pair2 {
  Vector2d n, rim, support;
  [[nodiscard]] double g() const { return n.dot(rim - support); }
  [[nodiscard]] double slope() const { return turned_left(n).dot(rim - support); }
};

/// Where the slope of g rises through zero between two directions less than half a turn apart, by false
/// position (Illinois).
template <typename At>
Pair2 least_between(const Pair2& low, const Pair2& high, const At& at) {
  double a = 0, b = 1, at_low = low.slope(), at_high = high.slope();
  int side = 0;
  const Vector2d way = high.n - low.n;
  const double size = (low.rim - low.support).norm();
  Pair2 pair = low;
  for (int i = 0; i < 60; ++i) {
    double t = a - at_low * (b - a) / (at_high - at_low);
    if (!(t > a && t < b)) t = 0.5 * (a + b);
    pair = at((low.n + t * way).normalized());
    const double s = pair.slope();
    if (std::abs(s) <= 1e-13 * size || t - a < 1e-16 || b - t < 1e-16) break;
    if (s < 0) {
      a = t;
      at_low = s;
      if (side == -1) at_high *= 0.5;
      side = -1;
    } else {
      b = t;
      at_high = s;
      if (side == 1) at_low *= 0.5;
      side = 1;
    }
  }
  return pair;
}

/// No n between two directions has less n.(x - y) than this, for any x and the corner y of their tangents to
/// the agent: so much of the agent is within the wedge of those.
double bound_between(const Pair2& low, const Pair2& high) {
  const double sine = low.n.x() * high.n.y() - low.n.y() * high.n.x(), a = low.n.dot(low.support),
               b = high.n.dot(high.support);
  const Vector2d corner(Vector2d(a * high.n.y() - b * low.n.y(), b * low.n.x() - a * high.n.x()) / sine);
  double most = -std::numeric_limits<double>::infinity();
  for (const Vector2d& x : {low.rim, high.rim}) {
    const Vector2d d = x - corner;
    // The least of n.d is at -d / |d| if that is between them.
    const bool within =
        low.n.x() * -d.y() - low.n.y() * -d.x() >= 0 && -d.x() * high.n.y() + d.y() * high.n.x() >= 0;
    most = std::max(most, within ? -d.norm() : std::min(low.n.dot(d), high.n.dot(d)));
  }
  return most;
}

/// The least g between two directions, if it is less than the best. Of smooth agents one minimum at most is
/// looked for; of others as many as there are corners: arcs in which the agent's point changes are halved.
template <typename At>
void look_between(const Pair2& low, const Pair2& high, const At& at, bool smooth, Pair2& best,
                  int depth = 0) {
  if (smooth || low.support == high.support || depth > 40) {
    if (!(low.slope() <= 0 && high.slope() >= 0)) return;
    // Between them g falls by less than its slopes would take it over the whole way.
    const double way = (high.n - low.n).norm() * 1.1;
    if (std::min(low.g(), high.g()) - way * std::max(-low.slope(), high.slope()) > best.g()) return;
    if (const Pair2 pair = least_between(low, high, at); pair.g() < best.g()) best = pair;
    return;
  }
  if (bound_between(low, high) >= best.g()) return;
  const Pair2 middle = at((low.n + high.n).normalized());
  if (middle.g() < best.g()) best = middle;
  look_between(low, middle, at, smooth, best, depth + 1);
  look_between(middle, high, at, smooth, best, depth + 1);
}

/// The disc of a circle or an ellipse: the points center + P u, |u| <= 1, about the agent's middle.
template <typename Shadow>
Least in_disc(const Shadow& agent, const Vector2d& center, const Matrix2d& p) {
  const auto at = [&](const Vector2d& n) {
    const Vector2d u = p.transpose() * n;
    const double length = u.norm();
    return Pair2{n, center + p * (length > 0 ? Vector2d(u / length) : Vector2d(0, 0)), agent.farthest(n)};
  };
  // A grid of directions from the one in which the opening is thin. Between two of them g is to have one
  // minimum at most: the support of a thin opening bends sharply about that direction, so more of them there;
  // that of a thin agent bends the other way, so one where it does.
  const Matrix2d s = p * p.transpose();
  const double angle = 0.5 * std::atan2(2 * s(0, 1), s(0, 0) - s(1, 1)), across = s.trace();
  const Vector2d thin(-std::sin(angle), std::cos(angle)), along = turned_left(thin);
  constexpr int kGrid = 24, kMore = 60;
  constexpr double kStep = 2 * std::numbers::pi / kGrid;
  static const std::array<Vector2d, kGrid> kTurns = [] {
    std::array<Vector2d, kGrid> turns;
    for (int i = 0; i < kGrid; ++i) turns[i] = {std::cos(i * kStep), std::sin(i * kStep)};
    return turns;
  }();
  std::array<double, kMore> more;
  int extra = 0;
  const auto add = [&](double turn) {
    more[extra++] = turn - 2 * std::numbers::pi * std::floor(turn / (2 * std::numbers::pi));
  };
  for (double w = std::max(std::abs(p.determinant()) / across, 1e-8);
       w < 0.5 * kStep && extra + 4 <= kMore - 2; w *= 4)
    for (const double turn : {w, -w, std::numbers::pi + w, std::numbers::pi - w}) add(turn);
  if constexpr (Shadow::kSmooth) {
    const double turn = agent.thin_angle() - angle - 0.5 * std::numbers::pi;
    add(turn);
    add(turn + std::numbers::pi);
  }
  std::sort(more.begin(), more.begin() + extra);

  std::array<Pair2, kGrid + kMore + 1> nodes;
  int count = 0, next = 0, first = 0;
  const auto node = [&](double c, double sine) {
    nodes[count] = at(c * thin + sine * along);
    if (nodes[count].g() < nodes[first].g()) first = count;
    ++count;
  };
  for (int i = 0; i < kGrid; ++i) {
    node(kTurns[i].x(), kTurns[i].y());
    for (; next < extra && more[next] < (i + 1) * kStep; ++next)
      if (more[next] > i * kStep) node(std::cos(more[next]), std::sin(more[next]));
  }
  nodes[count] = nodes[0];
  Pair2 best = nodes[first];
  for (int i = 0; i < count; ++i) look_between(nodes[i], nodes[i + 1], at, Shadow::kSmooth, best);
  return {best.g(), best.n};
}

/// A convex polygon, counterclockwise. Where the agent is within its edges' lines, g is least at the normal
/// of an edge; else it may be where the agent overhangs a vertex, between the normals of two.
template <typename Shadow>
Least in_convex_polygon(const Shadow& agent, const std::vector<Vector2d>& p) {
  Least best;
  const std::size_t count = p.size();
  const auto outwards = [&](std::size_t i) -> Vector2d {
    return -turned_left((p[(i + 1) % count] - p[i]).normalized());
  };
  Vector2d before = outwards(count - 1), support = agent.farthest(before);
  for (std::size_t i = 0; i < count; ++i) {
    const Vector2d after = outwards(i);
    const Pair2 low{before, p[i], support};
    support = agent.farthest(after);
    const Pair2 high{after, p[i], support};
    if (high.g() < best.distance) {
      const Vector2d edge = p[(i + 1) % count] - p[i];
      best = {high.g(), after, i, std::clamp(edge.dot(support - p[i]) / edge.squaredNorm(), 0.0, 1.0)};
    }
    if (low.g() < 0 || high.g() < 0) {
      const auto at = [&](const Vector2d& n) { return Pair2{n, p[i], agent.farthest(n)}; };
      // As many parts as there would be on a grid.
      const double angle = std::acos(std::clamp(before.dot(after), -1.0, 1.0));
      const int parts = 1 + static_cast<int>(16 * angle / std::numbers::pi);
      Pair2 from = low, over{{1, 0}, {best.distance, 0}, {0, 0}};  // what is to be less than the best
      for (int k = 1; k <= parts; ++k) {
        const double turn = angle * k / parts;
        const Pair2 to =
            k == parts ? high : at(std::cos(turn) * before + std::sin(turn) * turned_left(before));
        look_between(from, to, at, Shadow::kSmooth, over);
        from = to;
      }
      if (over.g() < best.distance) best = {over.g(), over.n, i, 0};
    }
    before = after;
  }
  return best;
}

/// Any simple polygon, counterclockwise.
template <typename Shadow>
Least in_polygon(const Shadow& agent, const std::vector<Vector2d>& p) {
  const std::size_t count = p.size();
  // Is the agent's middle inside, and if not, where is the rim nearest?
  bool inside = false;
  double nearest = std::numeric_limits<double>::infinity();
  std::size_t at = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector2d &a = p[i], &b = p[(i + 1) % count];
    if ((a.y() > 0) != (b.y() > 0)) inside = inside != ((a.x() * b.y() - a.y() * b.x() > 0) == (b.y() > 0));
    const Vector2d x = nearest_on_segment<Vector2d>(a, b, Vector2d::Zero());
    if (x.squaredNorm() < nearest) {
      nearest = x.squaredNorm();
      at = i;
    }
  }
  // Along the normal of an edge, outwards or inwards: the rim's point is opposite to the agent's support.
  const auto across = [&](std::size_t i, bool outwards, double& along) {
    const Vector2d &a = p[i], edge = p[(i + 1) % count] - a;
    const Vector2d left = turned_left(edge.normalized()), n = outwards ? Vector2d(-left) : left;
    const Vector2d support = agent.farthest(n);
    along = edge.dot(support - a) / edge.squaredNorm();
    return Least{n.dot(a - support), n, i, std::clamp(along, 0.0, 1.0)};
  };
  double along = 0;
  if (!inside) {
    const Least beyond = across(at, true, along);
    if (along >= 0 && along <= 1) return beyond;
    // Beyond a vertex: the agent's point farthest from it.
    const std::size_t vertex = along < 0 ? at : (at + 1) % count;
    Vector2d n = -p[vertex].normalized();
    for (int i = 0; i < 100; ++i) {
      const Vector2d next = (agent.farthest(n) - p[vertex]).normalized();
      const bool settled = (next - n).squaredNorm() < 1e-30;
      n = next;
      if (settled) break;
    }
    return {n.dot(p[vertex] - agent.farthest(n)), n, vertex, 0};
  }
  // Of each edge the largest of min over the edge of n.x - h(n): across the edge, or beyond one of its ends.
  // The edge that is nearest to the middle comes first, so that most others are seen not to be nearer.
  Least best;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = (at + k) % count, j = (i + 1) % count;
    const Vector2d straight = nearest_on_segment<Vector2d>(p[i], p[j], Vector2d::Zero()).normalized();
    if (std::min(straight.dot(p[i]), straight.dot(p[j])) - straight.dot(agent.farthest(straight)) >=
        best.distance)
      continue;
    Least apart;
    apart.distance = -apart.distance;
    for (const bool outwards : {true, false})
      if (const Least one = across(i, outwards, along);
          along >= 0 && along <= 1 && one.distance > apart.distance)
        apart = one;
    for (const std::size_t end : {i, j}) {
      const Vector2d n = agent.towards(p[end]);
      if (n.dot(p[i + j - end] - p[end]) < 0) continue;
      if (const double g = n.dot(p[end] - agent.farthest(n)); g > apart.distance)
        apart = {g, n, i, end == i ? 0.0 : 1.0};
    }
    if (std::isinf(apart.distance)) {
      // Cut so that none of these is a maximum: the best of a grid, then by halving.
      const auto on_rim = [&](const Vector2d& n) { return n.dot(p[i]) <= n.dot(p[j]) ? i : j; };
      const auto to = [](double t) { return Vector2d(std::cos(t), std::sin(t)); };
      constexpr double kStep = 2 * std::numbers::pi / 32;
      double middle = 0;
      for (double t = 0; t < 2 * std::numbers::pi; t += kStep)
        if (const Vector2d n = to(t); n.dot(p[on_rim(n)] - agent.farthest(n)) > apart.distance) {
          apart.distance = n.dot(p[on_rim(n)] - agent.farthest(n));
          middle = t;
        }
      double low = middle - kStep, high = middle + kStep;
      for (int step = 0; step < 50; ++step) {
        const double t = 0.5 * (low + high);
        const Vector2d n = to(t);
        (turned_left(n).dot(p[on_rim(n)] - agent.farthest(n)) > 0 ? low : high) = t;
      }
      const Vector2d n = to(0.5 * (low + high));
      apart = {n.dot(p[on_rim(n)] - agent.farthest(n)), n, i, on_rim(n) == i ? 0.0 : 1.0};
    }
    if (apart.distance < best.distance) best = apart;
  }
  return best;
}

template <typename Shadow>
OpeningClearance clearance_of(const Shadow& agent, const PlacedOpening& placed, const AcrossFrame& frame,
                              const Vector3d& w) {
  const Opening& opening = placed.opening;
  const Vector2d center = frame.transpose() * (placed.center - agent.middle());
  const Matrix2d axes = frame.transpose() * placed.axes;
  OpeningClearance m;
  Vector2d own = Vector2d::Zero();
  Vector2d n;
  if (!opening.polygonal()) {
    const Matrix2d p = axes * opening.semi_axes().asDiagonal();
    n = in_disc(agent, center, p).normal;
    const Vector2d u = p.transpose() * n;
    if (u.norm() > 0) own = (u / u.norm()).cwiseProduct(opening.semi_axes());
  } else {
    const std::vector<Vector2d>& vertices = opening.vertices();
    // Seen from behind the order of the vertices turns around.
    const bool behind = axes.determinant() < 0;
    thread_local std::vector<Vector2d> seen;
    seen.resize(vertices.size());
    const std::size_t last = vertices.size() - 1;
    for (std::size_t i = 0; i <= last; ++i) seen[behind ? last - i : i] = center + axes * vertices[i];
    Least least;
    if (std::abs(axes.determinant()) <= 1e-15 * axes.squaredNorm()) {
      // Along the wall: across the line that is seen of it.
      n = turned_left(axes.col(axes.col(0).norm() >= axes.col(1).norm() ? 0 : 1).normalized());
      if (n.dot(center) > 0) n = -n;
      least = {0, n, 0, 0};
    } else {
      least = opening.convex() ? in_convex_polygon(agent, seen) : in_polygon(agent, seen);
    }
    n = least.normal;
    const auto at = [&](std::size_t i) -> const Vector2d& {
      i %= last + 1;
      return vertices[behind ? last - i : i];
    };
    own = at(least.from) + least.along * (at(least.from + 1) - at(least.from));
  }
  m.normal = (frame * n).normalized();
  m.rim = placed.at(own);
  m.support = agent.in_space(m.normal);
  m.distance = m.normal.dot(m.rim - m.support);
  m.time = (m.rim - m.support).dot(w) / w.squaredNorm();
  return m;
}

/// Two unit vectors perpendicular to w.
AcrossFrame perpendicular_to(const Vector3d& w) {
  if (!w.allFinite() || w.isZero(0))
    throw InputError("relative_velocity",
                     "[" + to_text(w.x()) + ", " + to_text(w.y()) + ", " + to_text(w.z()) + "]",
                     "finite and not zero");
  const AxisFrame axis(w.stableNormalized());
  AcrossFrame frame;
  frame << axis.e1, axis.e2;
  return frame;
}

}  // namespace

OpeningClearance opening_clearance(const Ellipsoid& agent, const PlacedOpening& opening, const Vector3d& w) {
  const AcrossFrame frame = perpendicular_to(w);
  return clearance_of(EllipsoidShadow(agent, frame), opening, frame, w);
}

OpeningClearance opening_clearance(const WorldBody& agent, const PlacedOpening& opening, const Vector3d& w) {
  if (agent.quadric() && agent.quadric()->is_ellipsoid())
    return opening_clearance(agent.quadric()->ellipsoid(), opening, w);
  if (const Placed* placed = agent.placed();
      placed && placed->body.quadric() && placed->body.quadric()->is_ellipsoid())
    return opening_clearance(in_world(placed->body.quadric()->ellipsoid(), placed->pose), opening, w);
  if (!agent.support_point(Vector3d::UnitX()))
    throw InputError("agent", "one that is neither an ellipsoid nor a hull",
                     "an ellipsoid or a hull of points");
  const AcrossFrame frame = perpendicular_to(w);
  return clearance_of(HullShadow(agent, frame), opening, frame, w);
}

}  // namespace vericone
