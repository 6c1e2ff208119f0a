// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/fitting/fit.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/mesh/surface.h>
#include <vericone/internal/fitting/canonical.h>
#include <vericone/internal/fitting/signed_distance.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>

#include "distance/body_distance.h"
#include "distance/distance_sum.h"
#include "distance/scan_distance.h"

namespace vericone::fitting {
namespace {

using Eigen::Vector3d;
using LongVector = Eigen::Matrix<long double, 3, 1>;

void require_pieces(const std::vector<Piece>& pieces) {
  if (pieces.empty()) throw InputError("pieces", "none", "at least one");
}

std::vector<std::uint32_t> require_points(const Sample& sample) {
  if (sample.points.empty()) throw InputError("points", "none", "at least one");
  return used_points(sample);
}

/// Triangles of the pieces' surfaces, with the area up to and including each.
struct Boundary {
  struct Part {
    std::array<Vector3d, 3> corners;
    std::size_t piece;
  };
  std::vector<Part> parts;
  std::vector<double> area;

  explicit Boundary(const std::vector<Piece>& pieces) {
    double sum = 0;
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      const CombinedSurface s = surface(pieces[p].body, 0.06);
      for (const auto& t : s.triangles) {
        Part part{.corners = {}, .piece = p};
        for (std::size_t k = 0; k < 3; ++k)
          part.corners[k] = s.vertices[static_cast<std::size_t>(t.vertices[k])];
        const auto& [a, b, c] = part.corners;
        sum += 0.5 * (b - a).cross(c - a).norm();
        parts.push_back(part);
        area.push_back(sum);
      }
    }
  }
};

double fractional_part(double x) { return x - std::floor(x); }

}  // namespace

DistanceStatistics scan_to_hull(const std::vector<Piece>& pieces, const Sample& sample) {
  require_pieces(pieces);
  std::vector<BodyDistance> bodies;
  for (const Piece& p : pieces)
    if (!p.footprint) bodies.emplace_back(p.body);
  DistanceSum all;
  for (const std::uint32_t i : require_points(sample)) {
    checkpoint();
    const Vector3d& x = sample.points[i];
    double least = std::numeric_limits<double>::infinity();
    for (const BodyDistance& d : bodies) least = std::min(least, d(x));
    for (const Piece& p : pieces)
      if (p.footprint) least = std::min(least, signed_distance(*p.footprint, Eigen::Vector2d(x.head<2>())));
    all.add(std::abs(least));
  }
  return all.result();
}

std::optional<DistanceStatistics> hull_to_scan(const std::vector<Piece>& pieces, const Sample& sample,
                                               int samples) {
  require_pieces(pieces);
  require_points(sample);
  if (samples < 1) throw InputError("samples", std::to_string(samples), "at least 1");
  if (std::any_of(pieces.begin(), pieces.end(), [](const Piece& p) { return p.footprint.has_value(); }))
    return std::nullopt;
  const ScanDistance distance(sample);
  std::vector<BodyDistance> bodies;
  for (const Piece& p : pieces) bodies.emplace_back(p.body, BodyDistance::Rims::when_needed);

  // Equal steps of area, and within a triangle a sequence that fills it evenly (multiples of the powers of
  // the root of x^3 = x + 1).
  const Boundary boundary(pieces);
  DistanceSum all;
  std::size_t at = 0;
  for (int k = 0; k < samples; ++k) {
    checkpoint();
    const double target = (k + 0.5) / samples * boundary.area.back();
    while (at + 1 < boundary.area.size() && boundary.area[at] < target) ++at;
    const auto& [corners, of] = boundary.parts[at];
    const auto piece = of;  // a lambda cannot have the other
    double u = fractional_part(0.5 + k * 0.7548776662466927),
           v = fractional_part(0.5 + k * 0.5698402909980532);
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const Vector3d flat = corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0]);
    const Vector3d x = bodies[piece].on_boundary(flat);
    const auto covers = [&](std::size_t other) {
      const CombinedEllipsoid& body = pieces[other].body;
      return other != piece && body.gauge(x - body.center()) < 1 - 1e-12;
    };
    bool inside = false;
    for (std::size_t other = 0; other < pieces.size() && !inside; ++other) inside = covers(other);
    if (!inside) all.add(distance(x));
  }
  return all.result();
}

std::optional<double> enclosed_volume(const Sample& mesh) {
  if (!mesh.is_mesh()) return std::nullopt;
  const std::vector<std::uint32_t> used = require_points(mesh);
  // Equal points become one: the first of them.
  const std::size_t count = mesh.points.size();
  const auto less = [&](std::uint32_t i, std::uint32_t j) {
    const Vector3d &a = mesh.points[i], &b = mesh.points[j];
    for (int k = 0; k < 3; ++k)
      if (a(k) != b(k)) return a(k) < b(k);
    return i < j;
  };
  std::vector<std::uint32_t> order(count), same(count);
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), less);
  for (std::size_t k = 0; k < count; ++k) {
    const bool repeated = k > 0 && mesh.points[order[k]] == mesh.points[order[k - 1]];
    same[order[k]] = repeated ? same[order[k - 1]] : order[k];
  }

  // Closed and oriented: each edge is run through one way as often as the other way.
  struct Edge {
    std::uint32_t low, high;
    int way;
  };
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = same[t[k]], b = same[t[(k + 1) % 3]];
      if (a != b) edges.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
    }
  std::sort(edges.begin(), edges.end(),
            [](const Edge& a, const Edge& b) { return a.low != b.low ? a.low < b.low : a.high < b.high; });
  for (std::size_t k = 0; k < edges.size();) {
    const Edge& first = edges[k];
    int balance = 0;
    for (; k < edges.size() && edges[k].low == first.low && edges[k].high == first.high; ++k)
      balance += edges[k].way;
    if (balance != 0) return std::nullopt;
  }

  // About the middle of the points: far from the origin the products would cancel.
  LongVector middle = LongVector::Zero();
  for (const std::uint32_t i : used) middle += mesh.points[i].cast<long double>();
  middle /= static_cast<long double>(used.size());
  long double sum = 0, parts = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const LongVector p = mesh.points[a].cast<long double>() - middle;
    const LongVector q = mesh.points[b].cast<long double>() - middle;
    const LongVector r = mesh.points[c].cast<long double>() - middle;
    const long double part = p.dot(q.cross(r));
    sum += part;
    parts += std::abs(part);
  }
  // A sheet and its back: the coordinates' own rounding leaves more.
  constexpr long double kNothing = 1e-16L;
  if (!(std::abs(sum) > kNothing * parts)) return std::nullopt;
  return static_cast<double>(std::abs(sum) / 6);
}

}  // namespace vericone::fitting
