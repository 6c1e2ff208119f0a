// SPDX-License-Identifier: BSD-3-Clause
//
// Chords through the inside of a mesh.
#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "solids/solid_partition.h"

namespace vericone::fitting {
namespace {

using Eigen::Vector3d;

/// A triangle as rays ask for it.
struct Facet {
  Vector3d corner, first, second, middle;
  double radius = 0;  // of a ball about the middle, squared
};

Facet facet(const CanonicalSample& sample, const std::array<std::uint32_t, 3>& t) {
  const Vector3d &a = sample.points[t[0]], &b = sample.points[t[1]], &c = sample.points[t[2]];
  Facet f{a, b - a, c - a, (a + b + c) / 3};
  for (const Vector3d& x : {a, b, c}) f.radius = std::max(f.radius, (x - f.middle).squaredNorm());
  return f;
}

/// Where along the ray, or infinity (Moller and Trumbore).
double meets(const Facet& f, const Vector3d& from, const Vector3d& way) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const Vector3d to = f.middle - from;
  if (to.cross(way).squaredNorm() > f.radius * (1 + 1e-9)) return kNever;
  const Vector3d across = way.cross(f.second);
  const double det = f.first.dot(across);
  if (det == 0) return kNever;
  const Vector3d off = from - f.corner;
  const double u = off.dot(across) / det;
  const Vector3d turned = off.cross(f.first);
  const double v = way.dot(turned) / det;
  return u >= 0 && v >= 0 && u + v <= 1 ? f.second.dot(turned) / det : kNever;
}

}  // namespace

std::vector<std::vector<Vector3d>> chord_ends(const CanonicalSample& sample,
                                              const std::vector<std::uint32_t>& items) {
  constexpr double kBeyond = 1e-7;      // of the sample's size, which is 1
  constexpr std::size_t kFew = 10'000;  // triangles from which four chords are asked
  constexpr double kNearCorners = 0.7;
  std::vector<std::vector<Vector3d>> ends(sample.is_mesh() ? sample.triangles.size() : sample.points.size());
  if (!sample.is_mesh()) return ends;
  std::vector<Facet> facets;
  for (const auto& t : sample.triangles) facets.push_back(facet(sample, t));
  for (const std::uint32_t item : items) {
    const Facet& own = facets[item];
    const Vector3d normal = own.first.cross(own.second);
    if (!(normal.norm() > 0)) continue;
    const Vector3d way = -normal.normalized();
    std::vector<Vector3d> starts{own.middle};
    if (facets.size() <= kFew)
      for (const std::uint32_t corner : sample.triangles[item])
        starts.push_back(own.middle + kNearCorners * (sample.points[corner] - own.middle));
    for (const Vector3d& from : starts) {
      double nearest = std::numeric_limits<double>::infinity();
      bool out = false;
      for (const Facet& f : facets) {
        const double t = meets(f, from, way);
        if (!(t > kBeyond) || t >= nearest) continue;
        nearest = t;
        out = f.first.cross(f.second).dot(way) > 0;
      }
      // What the ray enters is not the other side of what it left.
      if (out) ends[item].push_back(from + nearest * way);
    }
  }
  return ends;
}

}  // namespace vericone::fitting
