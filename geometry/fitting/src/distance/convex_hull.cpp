// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/fitting/convex_hull.h>

#include <libqhull_r/qhull_ra.h>
#include <vericone/geometry/error.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace vericone::fitting {
namespace {

using Eigen::Vector3d;
using Triangle = std::array<std::uint32_t, 3>;
using LongVector = Eigen::Matrix<long double, 3, 1>;

/// Orthogonal directions and extents of the points along them. Hulls are affine: in coordinates divided by
/// the extents thin objects are as round as others, and Qhull's tolerances mean the same for all.
struct Axes {
  Vector3d origin, direction[3];
  double extent[3];
};

template <typename Function>
Vector3d farthest(const std::vector<Vector3d>& points, const Function& squared_distance) {
  const auto nearer = [&](const Vector3d& a, const Vector3d& b) {
    return squared_distance(a) < squared_distance(b);
  };
  return *std::max_element(points.begin(), points.end(), nearer);
}

Axes axes_of(const std::vector<Vector3d>& points) {
  constexpr double kFlat = 1e-13;
  double largest = 0;
  for (const Vector3d& p : points) {
    if (!p.allFinite()) throw InputError("points", "a coordinate that is not finite", "finite numbers");
    largest = std::max(largest, p.cwiseAbs().maxCoeff());
  }
  if (points.size() < 4)
    throw InputError("points", std::to_string(points.size()) + " points", "at least 4, not in one plane");

  Axes axes;
  axes.origin = points.front();
  const auto refuse = [&](const char* what) -> void {
    throw InputError("points", what, "points that are not all in one plane");
  };
  const auto check = [&](double extent, double of, const char* what) {
    if (!(extent > kFlat * of) || !(extent > 8 * std::numeric_limits<double>::epsilon() * largest))
      refuse(what);
  };
  const Vector3d first =
      farthest(points, [&](const Vector3d& p) { return (p - axes.origin).squaredNorm(); }) - axes.origin;
  axes.extent[0] = first.norm();
  check(axes.extent[0], 0, "points that are all equal");
  axes.direction[0] = first / axes.extent[0];

  const auto off_line = [&](const Vector3d& p) -> Vector3d {
    const Vector3d d = p - axes.origin;
    return d - d.dot(axes.direction[0]) * axes.direction[0];
  };
  const Vector3d second =
      off_line(farthest(points, [&](const Vector3d& p) { return off_line(p).squaredNorm(); }));
  axes.extent[1] = second.norm();
  check(axes.extent[1], axes.extent[0], "points on one line");
  // Made perpendicular once more: `second` may be short beside what was subtracted.
  axes.direction[1] = (second - second.dot(axes.direction[0]) * axes.direction[0]).normalized();

  axes.direction[2] = axes.direction[0].cross(axes.direction[1]).normalized();
  const auto height = [&](const Vector3d& p) { return std::abs((p - axes.origin).dot(axes.direction[2])); };
  axes.extent[2] = height(farthest(points, height));
  check(axes.extent[2], axes.extent[0], "points in one plane");
  return axes;
}

/// A triangle's edge from its corner k to the next.
struct Edge {
  std::uint32_t low, high, triangle;
  int corner;
};

/// Turns the triangles so that each edge is passed in both directions, once each. False where the triangles
/// are not one closed surface.
bool orient(std::vector<Triangle>& triangles) {
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(triangles[t][k], triangles[t][(k + 1) % 3]);
      edges.push_back({low, high, t, k});
    }
  std::sort(edges.begin(), edges.end(),
            [](const Edge& a, const Edge& b) { return std::pair(a.low, a.high) < std::pair(b.low, b.high); });
  // Across the edge k of a triangle: the neighbour.
  std::vector<std::array<std::uint32_t, 3>> across(triangles.size());
  for (std::size_t i = 0; i < edges.size(); i += 2) {
    const auto same = [&](std::size_t j) {
      return edges[i].low == edges[j].low && edges[i].high == edges[j].high;
    };
    if (edges[i].low == edges[i].high || i + 1 >= edges.size() || !same(i + 1)) return false;
    if (i + 2 < edges.size() && same(i + 2)) return false;
    across[edges[i].triangle][edges[i].corner] = edges[i + 1].triangle;
    across[edges[i + 1].triangle][edges[i + 1].corner] = edges[i].triangle;
  }

  const auto passes = [&](std::uint32_t t, std::uint32_t from, std::uint32_t to) {
    for (int k = 0; k < 3; ++k)
      if (triangles[t][k] == from && triangles[t][(k + 1) % 3] == to) return true;
    return false;
  };
  std::vector<char> done(triangles.size(), 0);
  std::vector<std::uint32_t> open{0};
  done[0] = 1;
  std::size_t reached = 1;
  while (!open.empty()) {
    const std::uint32_t t = open.back();
    open.pop_back();
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t n = across[t][k], from = triangles[t][k], to = triangles[t][(k + 1) % 3];
      const bool opposite = passes(n, to, from);
      if (done[n]) {
        if (!opposite) return false;
        continue;
      }
      if (!opposite) {
        std::swap(triangles[n][1], triangles[n][2]);
        std::swap(across[n][0], across[n][2]);
      }
      done[n] = 1;
      ++reached;
      open.push_back(n);
    }
  }
  return reached == triangles.size();
}

/// Qhull's state for one run, and where its messages go: nowhere.
class Run {
 public:
  Run() : messages_(std::fopen("/dev/null", "w")) { qh_zero(&qh_, messages_); }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;
  ~Run() {
    qh_freeqhull(&qh_, qh_ALL);
    int current = 0, total = 0;
    qh_memfreeshort(&qh_, &current, &total);
    if (messages_) std::fclose(messages_);
  }

  /// The facets as triangles, however turned. Nothing where Qhull gives up.
  std::optional<std::vector<Triangle>> facets(std::vector<double>& coordinates, std::string options) {
    if (!messages_) return std::nullopt;
    const int count = static_cast<int>(coordinates.size() / 3);
    if (qh_new_qhull(&qh_, 3, count, coordinates.data(), False, options.data(), nullptr, messages_) != 0)
      return std::nullopt;
    std::vector<Triangle> triangles;
    for (const facetT* facet = qh_.facet_list; facet && facet->next; facet = facet->next) {
      if (qh_setsize(&qh_, facet->vertices) != 3) return std::nullopt;
      Triangle t{};
      for (int k = 0; k < 3; ++k) {
        const auto* vertex = static_cast<const vertexT*>(facet->vertices->e[k].p);
        t[static_cast<std::size_t>(k)] = static_cast<std::uint32_t>(qh_pointid(&qh_, vertex->point));
      }
      triangles.push_back(t);
    }
    return triangles;
  }

 private:
  qhT qh_;
  std::FILE* messages_;
};

/// The hull's facets as triangles, turned consistently. Nothing where Qhull gives up or where its facets are
/// not a closed surface.
std::optional<std::vector<Triangle>> facets(std::vector<double>& coordinates, const char* options) {
  std::optional<std::vector<Triangle>> triangles = Run().facets(coordinates, options);
  if (!triangles || triangles->empty() || !orient(*triangles)) return std::nullopt;
  return triangles;
}

}  // namespace

ConvexHull convex_hull(const std::vector<Vector3d>& points) {
  const Axes axes = axes_of(points);
  std::vector<double> coordinates;
  coordinates.reserve(3 * points.size());
  for (const Vector3d& p : points)
    for (int k = 0; k < 3; ++k)
      coordinates.push_back((p - axes.origin).dot(axes.direction[k]) / axes.extent[k]);

  // Merged facets cut into triangles; where these do not close, points moved by a few roundings, the same way
  // each time, so that no facet has more than three corners.
  std::optional<std::vector<Triangle>> triangles = facets(coordinates, "qhull Qt");
  if (!triangles) triangles = facets(coordinates, "qhull QJ");
  if (!triangles)
    throw InputError("points", "points of which Qhull finds no hull", "points that are not all in one plane");

  ConvexHull hull;
  hull.triangles = std::move(*triangles);
  for (const Triangle& t : hull.triangles) hull.vertices.insert(hull.vertices.end(), t.begin(), t.end());
  std::sort(hull.vertices.begin(), hull.vertices.end());
  hull.vertices.erase(std::unique(hull.vertices.begin(), hull.vertices.end()), hull.vertices.end());

  LongVector mean = LongVector::Zero();
  for (const std::uint32_t v : hull.vertices) mean += points[v].cast<long double>();
  mean /= static_cast<long double>(hull.vertices.size());
  long double sum = 0;
  for (const Triangle& t : hull.triangles) {
    LongVector corner[3];
    for (int k = 0; k < 3; ++k) corner[k] = points[t[k]].cast<long double>() - mean;
    sum += corner[0].dot(corner[1].cross(corner[2]));
  }
  if (sum < 0)
    for (Triangle& t : hull.triangles) std::swap(t[1], t[2]);
  hull.volume = static_cast<double>(std::abs(sum) / 6);
  return hull;
}

}  // namespace vericone::fitting
