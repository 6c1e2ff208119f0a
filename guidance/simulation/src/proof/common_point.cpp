// SPDX-License-Identifier: BSD-3-Clause
#include "proof/common_point.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

namespace vericone::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector3d in_space(const Vector2d& x) { return {x.x(), x.y(), 0}; }

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
  // Of very many points some do: their hull is within the body.
  constexpr std::size_t kMostPoints = 800;
  const std::size_t stride = 1 + hull.size() / kMostPoints;
  std::vector<Vector3d> above, below;
  for (std::size_t k = 0; k < hull.size(); k += stride)
    (hull.points()[k].z() > 0 ? above : below).push_back(hull.points()[k]);
  std::vector<Vector2d> points;
  for (const Vector3d& a : above)
    for (const Vector3d& b : below) points.push_back((a + a.z() / (a.z() - b.z()) * (b - a)).head<2>());
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
    return opening.semi_axes().cwiseProduct(Vector2d(std::cos(angle), std::sin(angle)));
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
