// SPDX-License-Identifier: BSD-3-Clause
#include "proof/rim.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "proof/least_point.h"

namespace vericone::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector3d in_space(const Vector2d& x) { return {x.x(), x.y(), 0}; }

/// Part of a rim, in the hull of a few points: an arc in the triangle of its ends and their tangents, edges
/// in their bounds, one edge as it is.
struct Part {
  std::array<Vector3d, 4> corners;
  int count = 0;
  // Of an ellipse: the middle angle and half the width, rad. Of a polygon: edges first .. last - 1.
  double angle = 0, half = 0;
  std::size_t first = 0, last = 0;
  double excess = 0;  // no corner is farther from the rim, metres; infinite: not known
  double bound = -std::numeric_limits<double>::infinity();  // it is at least this far from the body
  Vector3d normal = Vector3d::Zero();

  double least(const Vector3d& n) const {
    double low = n.dot(corners[0]);
    for (int i = 1; i < count; ++i) low = std::min(low, n.dot(corners[static_cast<std::size_t>(i)]));
    return low;
  }
  Vector3d farthest(const Vector3d& n) const {
    int best = 0;
    for (int i = 1; i < count; ++i)
      if (n.dot(corners[static_cast<std::size_t>(i)]) > n.dot(corners[static_cast<std::size_t>(best)]))
        best = i;
    return corners[static_cast<std::size_t>(best)];
  }
  Vector3d middle() const {
    Vector3d sum = Vector3d::Zero();
    for (int i = 0; i < count; ++i) sum += corners[static_cast<std::size_t>(i)];
    return sum / count;
  }
};

Vector3d on_ellipse(const Vector2d& axes, double angle) {
  return {axes.x() * std::cos(angle), axes.y() * std::sin(angle), 0};
}

Part arc(const Vector2d& axes, double angle, double half) {
  Part part;
  part.angle = angle;
  part.half = half;
  const Vector3d middle = on_ellipse(axes, angle), out = middle / std::cos(half);
  part.corners = {on_ellipse(axes, angle - half), on_ellipse(axes, angle + half), out, out};
  part.count = 3;
  part.excess = (out - middle).norm();
  return part;
}

Part edges(const std::vector<Vector2d>& vertices, std::size_t first, std::size_t last) {
  Part part;
  part.first = first;
  part.last = last;
  const auto vertex = [&](std::size_t i) { return vertices[i % vertices.size()]; };
  if (last - first == 1) {
    part.corners[0] = in_space(vertex(first));
    part.corners[1] = in_space(vertex(last));
    part.count = 2;
    return part;
  }
  Vector2d low = vertex(first), high = low;
  for (std::size_t i = first + 1; i <= last; ++i) {
    low = low.cwiseMin(vertex(i));
    high = high.cwiseMax(vertex(i));
  }
  part.corners = {in_space(low), in_space(high), Vector3d(low.x(), high.y(), 0),
                  Vector3d(high.x(), low.y(), 0)};
  part.count = 4;
  part.excess = std::numeric_limits<double>::infinity();
  return part;
}

/// Branch and bound over parts of the rim.
class Nearest {
 public:
  Nearest(const Chords& body, const Opening& opening, double enough, double hopeless)
      : body_(body), opening_(opening), enough_(enough), hopeless_(hopeless) {}

  RimDistance search() {
    start();
    const double least_excess = 1e-12 * opening_.reach();
    while (true) {
      std::pop_heap(parts_.begin(), parts_.end(), farther);
      const Part part = parts_.back();
      parts_.pop_back();
      found_.least = part.bound;
      const bool decided = part.bound > enough_ || found_.most <= hopeless_;
      if (decided || part.bound >= 0.995 * found_.most || !(part.excess > least_excess)) return found_;
      if (opening_.polygonal()) {
        const std::size_t half = part.first + (part.last - part.first) / 2;
        add(edges(opening_.vertices(), part.first, half), part);
        add(edges(opening_.vertices(), half, part.last), part);
      } else {
        const double half = 0.5 * part.half;
        add(arc(opening_.semi_axes(), part.angle - half, half), part);
        add(arc(opening_.semi_axes(), part.angle + half, half), part);
      }
    }
  }

 private:
  static bool farther(const Part& x, const Part& y) { return x.bound > y.bound; }

  void start() {
    if (opening_.polygonal()) {
      const std::size_t n = opening_.vertices().size();
      add(edges(opening_.vertices(), 0, n / 2), {});
      add(edges(opening_.vertices(), n / 2, n), {});
      return;
    }
    constexpr int kArcs = 8;
    for (int i = 0; i < kArcs; ++i)
      add(arc(opening_.semi_axes(), 2 * std::numbers::pi * i / kArcs, std::numbers::pi / kArcs), {});
  }

  void add(Part part, const Part& whole) {
    part.bound = whole.bound;
    attempt(part, whole.normal);
    if (!(part.bound > enough_)) attempt(part, towards(part.middle()));
    if (!(part.bound > enough_)) by_nearest_points(part);
    parts_.push_back(part);
    std::push_heap(parts_.begin(), parts_.end(), farther);
  }

  /// A plane perpendicular to n between body and part.
  void attempt(Part& part, const Vector3d& n) const {
    const double length = n.norm();
    if (!(length > 0)) return;
    const double bound = (part.least(n) - body_.support(n)) / length;
    if (bound > part.bound) {
      part.bound = bound;
      part.normal = n / length;
    }
  }

  /// The normal of the body's level surface through x: of an ellipsoid it separates whatever is outside.
  Vector3d towards(const Vector3d& x) const {
    const Vector3d from = x - body_.middle();
    if (body_.from.hull()) return from;
    if (shape_.isZero(0)) shape_ = inverse_shape(body_.from.factor);
    // The point of the chord that is next to x in the body's own measure.
    const Vector3d chord = body_.to.center - body_.from.center, at = x - body_.from.center;
    const double length = chord.dot(shape_ * chord);
    const double share = length > 0 ? std::clamp(chord.dot(shape_ * at) / length, 0.0, 1.0) : 0;
    return shape_ * (at - share * chord);
  }
  static Eigen::Matrix3d inverse_shape(const Eigen::Matrix3d& factor) {
    const Eigen::Matrix3d inverse = factor.inverse();
    return inverse.transpose() * inverse;
  }

  void by_nearest_points(Part& part) {
    const auto farthest = [&](const Vector3d& d) -> Vector3d {
      return part.farthest(d) - body_.support_point(-d);
    };
    const Vector3d gap = least_point(farthest, part.middle() - body_.middle());
    attempt(part, gap);
    const double most = gap.norm() + part.excess;
    if (most < found_.most) {
      found_.most = most;
      found_.nearest = part.count == 2 ? part.farthest(-gap) : on_ellipse(opening_.semi_axes(), part.angle);
    }
  }

  const Chords& body_;
  const Opening& opening_;
  double enough_, hopeless_;
  RimDistance found_;
  std::vector<Part> parts_;
  mutable Eigen::Matrix3d shape_ = Eigen::Matrix3d::Zero();
};

/// Where a function with one minimum in [lo, hi] is least.
template <typename F>
double golden(const F& f, double lo, double hi) {
  constexpr double kGolden = 0.6180339887498949;
  constexpr int kSteps = 50;
  double x = hi - kGolden * (hi - lo), y = lo + kGolden * (hi - lo), fx = f(x), fy = f(y);
  for (int step = 0; step < kSteps; ++step) {
    if (fx <= fy) {
      hi = y, y = x, fy = fx;
      x = hi - kGolden * (hi - lo), fx = f(x);
    } else {
      lo = x, x = y, fx = fy;
      y = lo + kGolden * (hi - lo), fy = f(y);
    }
  }
  return fx <= fy ? x : y;
}

/// The section of a body by the plane z = 0.
struct Section {
  std::function<double(const Vector2d&)> value;  // negative inside
  double certain = 0;                            // below this the point is in the body, whatever was rounded
  Vector2d middle = Vector2d::Zero();
};

double cross(const Vector2d& x, const Vector2d& y) { return x.x() * y.y() - x.y() * y.x(); }

/// Of a hull: the convex polygon of where segments between its points cross the plane.
std::optional<Section> section_of(const HullBody& hull, double slack) {
  std::vector<Vector2d> points;
  for (const Vector3d& above : hull.points())
    if (above.z() > 0)
      for (const Vector3d& below : hull.points())
        if (below.z() < 0)
          points.push_back((above + above.z() / (above.z() - below.z()) * (below - above)).head<2>());
  if (points.size() < 3) return std::nullopt;
  std::sort(points.begin(), points.end(), [](const Vector2d& p, const Vector2d& q) {
    return p.x() < q.x() || (p.x() == q.x() && p.y() < q.y());
  });
  std::vector<Vector2d> around;
  for (int side = 0; side < 2; ++side) {
    const std::size_t start = around.size();
    for (const Vector2d& p : points) {
      while (around.size() >= start + 2 &&
             !(cross(around.back() - around[around.size() - 2], p - around.back()) > 0))
        around.pop_back();
      around.push_back(p);
    }
    around.pop_back();
    std::reverse(points.begin(), points.end());
  }
  if (around.size() < 3) return std::nullopt;
  Section section;
  for (const Vector2d& p : around) section.middle += p / static_cast<double>(around.size());
  section.value = [around](const Vector2d& x) {
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < around.size(); ++i) {
      const Vector2d edge = around[(i + 1) % around.size()] - around[i];
      if (edge.norm() > 0) most = std::max(most, cross(x - around[i], edge) / edge.norm());
    }
    return most;
  };
  section.certain = -4 * slack;
  return section;
}

/// Of an ellipsoid, perhaps delimited: its gauge less 1.
std::optional<Section> section_of(const WorldBody& body, double slack) {
  const Ellipsoid& e = body.quadric()->ellipsoid();
  const double across = e.shape()(2, 2);
  if (!(e.center().z() * e.center().z() < across)) return std::nullopt;
  Section section;
  section.middle = (e.center() - e.shape().col(2) * (e.center().z() / across)).head<2>();
  section.value = [&body](const Vector2d& x) { return body.gauge(in_space(x)) - 1; };
  section.certain = -(4 * slack / e.semi_axes()(2) + 1e-12);
  return section;
}

/// The point of the rim that is deepest in the section, about.
Vector2d deepest(const Section& section, const Opening& opening) {
  double least = std::numeric_limits<double>::infinity();
  Vector2d best = Vector2d::Zero();
  const auto note = [&](const Vector2d& x) {
    if (const double value = section.value(x); value < least) {
      least = value;
      best = x;
    }
  };
  if (opening.polygonal()) {
    const auto& v = opening.vertices();
    for (std::size_t i = 0; i < v.size(); ++i) {
      const Vector2d from = v[i], edge = v[(i + 1) % v.size()] - from;
      const auto at = [&](double s) { return section.value(from + s * edge); };
      note(from + golden(at, 0, 1) * edge);
      note(from);
    }
    return best;
  }
  constexpr int kSamples = 96;
  constexpr double kStep = 2 * std::numbers::pi / kSamples;
  const auto point = [&](double angle) -> Vector2d {
    return on_ellipse(opening.semi_axes(), angle).head<2>();
  };
  const auto at = [&](double angle) { return section.value(point(angle)); };
  std::array<double, kSamples> values{};
  for (int i = 0; i < kSamples; ++i) values[static_cast<std::size_t>(i)] = at(i * kStep);
  for (int i = 0; i < kSamples; ++i) {
    const auto value = [&](int k) { return values[static_cast<std::size_t>((k + kSamples) % kSamples)]; };
    if (value(i) <= value(i - 1) && value(i) <= value(i + 1))
      note(point(golden(at, (i - 1) * kStep, (i + 1) * kStep)));
  }
  return best;
}

}  // namespace

double Chords::support(const Vector3d& n) const { return std::max(from.support(n), to.support(n)); }

Vector3d Chords::support_point(const Vector3d& n) const {
  const Vector3d x = from.support_point(n), y = to.support_point(n);
  return n.dot(x) >= n.dot(y) ? x : y;
}

RimDistance rim_distance(const Chords& body, const Opening& opening, double enough, double hopeless) {
  return Nearest(body, opening, enough, hopeless).search();
}

std::optional<Vector2d> common_point(const WorldBody& body, const Opening& opening, bool wall, double slack) {
  const HullBody* hull = body.hull();
  if (!hull && !body.quadric()) return std::nullopt;
  const auto section = hull ? section_of(*hull, slack) : section_of(body, slack);
  if (!section) return std::nullopt;
  const auto inside = [&](const Vector2d& x) { return section->value(x) < section->certain; };
  if (wall && inside(section->middle) && opening.depth(section->middle) < -slack) return section->middle;
  if (const Vector2d x = deepest(*section, opening); inside(x)) return x;
  return std::nullopt;
}

}  // namespace vericone::simulation
