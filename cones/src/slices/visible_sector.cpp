// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/slices/visible_cone.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/slices/visible_sector.h>
#include <vericone/internal/geometry/lengths.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "answers/elementary.h"
#include "planar/sector_parts.h"

namespace vericone {
namespace {

using Eigen::Vector2d;

constexpr double kOnLine = 1e-13;  // radians, seen from the contact

/// A line through a point of the agent and one of the obstacle. Positive side: the left of the way there.
struct SightLine {
  Vector2d on_a, on_b, direction;
  std::size_t point = 0;  // index of on_b

  SightLine(const Vector2d& a, const Vector2d& b, std::size_t index)
      : on_a(a), on_b(b), direction(b - a), point(index) {
    if (const double length = detail::length(direction); length > 0) direction /= length;
  }

  /// 1 left, -1 right, 0 on the line, for a point seen from `from`.
  int side(const Vector2d& x, const Vector2d& from) const {
    const Vector2d way = x - from;
    const double s = cross(direction, way);
    return std::abs(s) <= kOnLine * detail::length(way) ? 0 : s > 0 ? 1 : -1;
  }
};

/// An agent's tangents through a point: the agent on the left of the first, on the right of the second, seen
/// from the agent to the point.
using Tangents = std::optional<std::array<SightLine, 2>>;

class EllipticAgent {
 public:
  explicit EllipticAgent(const Ellipse& body) : body_(body), inverse_(scaled_inverse<2>(body.factor())) {}

  Vector2d center() const { return body_.center(); }
  bool contains(const Vector2d& p) const { return (inverse_ * (p - body_.center())).squaredNorm() <= 1; }

  Tangents tangents(const Vector2d& p, std::size_t index) const {
    // With v = F^{-1}(p - centre), |v| > 1, they touch at u = (v -+ root turned(v)) / |v|^2.
    const Vector2d v = inverse_ * (p - body_.center());
    const double square = v.squaredNorm();
    if (!(square > 1)) return std::nullopt;
    const double root = std::sqrt(square - 1) * (body_.factor().determinant() > 0 ? 1 : -1);
    const Vector2d turned(-v.y(), v.x());
    const auto at = [&](double turn) -> Vector2d {
      return body_.center() + body_.factor() * ((v + turn * root * turned) / square);
    };
    return std::array{SightLine(at(-1), p, index), SightLine(at(1), p, index)};
  }

 private:
  const Ellipse& body_;
  Eigen::Matrix2d inverse_;
};

/// Convex hull, counter-clockwise, of indices (Andrew's monotone chain).
std::vector<std::size_t> hull(std::span<const Vector2d> points) {
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return points[i].x() != points[j].x() ? points[i].x() < points[j].x() : points[i].y() < points[j].y();
  });
  std::vector<std::size_t> corners;
  const auto add_half = [&](auto first, auto last) {
    const std::size_t start = corners.size();
    for (; first != last; ++first) {
      while (corners.size() >= start + 2) {
        const Vector2d& p = points[corners[corners.size() - 2]];
        if (cross(points[corners.back()] - p, points[*first] - p) > 0) break;
        corners.pop_back();
      }
      corners.push_back(*first);
    }
    if (corners.size() > start + 1) corners.pop_back();
  };
  add_half(order.begin(), order.end());
  add_half(order.rbegin(), order.rend());
  return corners;
}

class PointAgent {
 public:
  explicit PointAgent(std::span<const Vector2d> points) {
    for (const std::size_t i : hull(points)) corners_.push_back(points[i]);
    center_ = Vector2d::Zero();
    for (const Vector2d& p : points) center_ += p / double(points.size());
  }

  const Vector2d& center() const { return center_; }
  const std::vector<Vector2d>& corners() const { return corners_; }
  static bool contains(const Vector2d&) { return false; }  // its hull may well

  Tangents tangents(const Vector2d& p, std::size_t index) const {
    Vector2d leftmost = corners_[0], rightmost = corners_[0];  // seen from p
    for (const Vector2d& a : corners_) {
      if (cross(leftmost - p, a - p) > 0) leftmost = a;
      if (cross(rightmost - p, a - p) < 0) rightmost = a;
    }
    if (leftmost == p || rightmost == p) return std::nullopt;
    // What is on the right seen from p is on the left seen to p.
    const std::array both{SightLine(leftmost, p, index), SightLine(rightmost, p, index)};
    for (const Vector2d& a : corners_)
      if (both[0].side(a, p) < 0 || both[1].side(a, p) > 0) return std::nullopt;  // p in the hull
    return both;
  }

 private:
  std::vector<Vector2d> corners_;
  Vector2d center_;
};

void require_finite(const char* field, std::span<const Vector2d> points) {
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const int k : {0, 1})
      if (!std::isfinite(points[i](k)))
        throw InputError(std::string(field) + "[" + std::to_string(i) + "][" + std::to_string(k) + "]",
                         to_text(points[i](k)), "a finite number (m)");
}

/// left = true: the obstacle on the right of the line.
bool separates(const SightLine& line, bool left, std::span<const Vector2d> chain) {
  const int wrong = left ? 1 : -1;
  return std::none_of(chain.begin(), chain.end(),
                      [&](const Vector2d& x) { return line.side(x, line.on_b) == wrong; });
}

SectorEdge edge(const SightLine& line, bool left) {
  SectorEdge e;
  e.direction = line.direction;
  e.normal = (left ? 1 : -1) * Vector2d(line.direction.y(), -line.direction.x());
  e.point_on_a = line.on_a;
  e.point_on_b = line.on_b;
  return e;
}

void set_sector(VisibleSector& result, const SightLine& left, const SightLine& right) {
  Sector sector;
  sector.relation = Relation::disjoint;
  sector.left = edge(left, true);
  sector.right = edge(right, false);
  sector.psi = std::atan2(cross(right.direction, left.direction), right.direction.dot(left.direction));
  sector.theta_b = bisector_angle(right.direction, sector.psi);
  result.left_point = left.point;
  result.right_point = right.point;
  // A point against a point leaves one direction.
  if (sector.psi >= -2 * kOnLine) {
    sector.psi = std::max(0.0, sector.psi);
    result.sector = sector;
  } else {
    result.reason = NoSector::no_tangents;
  }
}

/// 6.3.3: from the ends inwards.
template <typename Agent>
VisibleSector search(const Agent& agent, std::span<const Vector2d> all, const SearchOptions& options) {
  if (options.keep_every < 1)
    throw InputError("keep_every", std::to_string(options.keep_every), "a positive whole number");
  require_finite("chain", all);
  std::vector<Vector2d> chain;
  std::vector<std::size_t> index;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (i % options.keep_every == 0 || i + 1 == all.size()) {
      chain.push_back(all[i]);
      index.push_back(i);
    }
  VisibleSector result;
  if (chain.empty()) result.reason = NoSector::no_points;
  Vector2d center = Vector2d::Zero();
  for (const Vector2d& p : chain) {
    center += p / double(chain.size());
    if (agent.contains(p)) result.reason = NoSector::inside_agent;
  }
  if (result.reason != NoSector::none) return result;

  std::optional<SightLine> left, right;
  const auto attempt = [&](std::size_t i) {
    ++result.tried;
    const Tangents tangents = agent.tangents(chain[i], index[i]);
    if (!tangents) return;
    for (const bool is_left : {true, false}) {
      auto& found = is_left ? left : right;
      const SightLine& line = (*tangents)[is_left ? 0 : 1];
      const auto centers_apart = [&] {
        return line.side(agent.center(), line.on_b) * line.side(center, line.on_b) <= 0;
      };
      if (!found && centers_apart() && separates(line, is_left, chain)) found = line;
    }
  };
  for (std::size_t low = 0, high = chain.size() - 1; low <= high && !(left && right); ++low, --high) {
    attempt(low);
    if (high != low) attempt(high);
    if (high == 0) break;
  }
  if (left && right)
    set_sector(result, *left, *right);
  else
    result.reason = NoSector::no_tangents;
  return result;
}

}  // namespace

const char* to_string(NoSector reason) {
  switch (reason) {
    case NoSector::none:
      return "none";
    case NoSector::no_points:
      return "no points";
    case NoSector::inside_agent:
      return "a point inside the agent";
    case NoSector::no_tangents:
      return "no common tangents";
  }
  return "?";
}

VisibleSector visible_sector(const Ellipse& agent, std::span<const Vector2d> chain,
                             const SearchOptions& options) {
  return search(EllipticAgent(agent), chain, options);
}

VisibleSector visible_sector(std::span<const Vector2d> agent, std::span<const Vector2d> chain,
                             const SearchOptions& options) {
  if (agent.empty()) throw InputError("agent", "no points", "one point at least");
  require_finite("agent", agent);
  return search(PointAgent(agent), chain, options);
}

VisibleSector sector_of_points(const Ellipse& agent, std::span<const Vector2d> points) {
  require_finite("points", points);
  const EllipticAgent a(agent);
  VisibleSector result;
  if (points.empty()) result.reason = NoSector::no_points;
  for (const Vector2d& p : points)
    if (a.contains(p)) result.reason = NoSector::inside_agent;
  if (result.reason != NoSector::none) return result;
  // While agent and points can be separated, all tangents are within half a turn of each other, and the
  // tangent through a point beyond an edge makes a larger angle.
  const auto extreme = [&](bool left) -> std::optional<SightLine> {
    std::optional<SightLine> best;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (best && !(cross(best->direction, points[i] - best->on_b) * (left ? 1 : -1) > 0)) continue;
      ++result.tried;
      const Tangents tangents = a.tangents(points[i], i);
      if (!tangents) return std::nullopt;  // beyond what doubles measure against the agent's axes
      best = (*tangents)[left ? 0 : 1];
    }
    return best;
  };
  const std::optional<SightLine> left = extreme(true), right = extreme(false);
  if (left && right && separates(*left, true, points) && separates(*right, false, points))
    set_sector(result, *left, *right);
  else
    result.reason = NoSector::no_tangents;
  return result;
}

VisibleSector sector_of_points(std::span<const Vector2d> agent, std::span<const Vector2d> points) {
  if (agent.empty()) throw InputError("agent", "no points", "one point at least");
  require_finite("agent", agent);
  require_finite("points", points);
  VisibleSector result;
  if (points.empty()) {
    result.reason = NoSector::no_points;
    return result;
  }
  const PointAgent a(agent);
  const std::vector<std::size_t> corners = hull(points);
  // Left edge: no point of the obstacle on its left, none of the agent on its right. Each step turns the line
  // to the left, so while the hulls are disjoint it ends after at most as many steps as there are corners.
  const auto extreme = [&](bool left) -> std::optional<SightLine> {
    const double turn = left ? 1 : -1;
    std::size_t on_a = 0, on_b = 0;
    for (std::size_t step = 0; step <= a.corners().size() + corners.size(); ++step) {
      const std::size_t from_a = on_a, from_b = on_b;
      for (std::size_t j = 0; j < corners.size(); ++j) {
        const Vector2d& o = a.corners()[on_a];
        if (turn * cross(points[corners[on_b]] - o, points[corners[j]] - o) > 0) on_b = j;
      }
      for (std::size_t i = 0; i < a.corners().size(); ++i) {
        const Vector2d& o = points[corners[on_b]];
        if (turn * cross(a.corners()[on_a] - o, a.corners()[i] - o) > 0) on_a = i;
      }
      ++result.tried;
      if (on_a == from_a && on_b == from_b) break;
    }
    const Vector2d &p = a.corners()[on_a], &q = points[corners[on_b]];
    if (p == q) return std::nullopt;
    const SightLine line(p, q, corners[on_b]);
    const bool agent_beside = std::none_of(a.corners().begin(), a.corners().end(), [&](const Vector2d& x) {
      return line.side(x, p) == (left ? -1 : 1);
    });
    return agent_beside && separates(line, left, points) ? std::optional(line) : std::nullopt;
  };
  const std::optional<SightLine> left = extreme(true), right = extreme(false);
  if (left && right)
    set_sector(result, *left, *right);
  else
    result.reason = NoSector::no_tangents;
  return result;
}

}  // namespace vericone
