// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/cone.h>
#include <vericone/internal/cones/map/cell.h>

#include <vericone/cones/ellipsoids/true_cone.h>
#include <vericone/cones/map/cone_map.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/assembly/convex_reach.h>
#include <vericone/internal/cones/combined/cone.h>
#include <vericone/internal/cones/map/classifiers.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "pairs/cones.h"

namespace vericone {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

constexpr double kMargin = 1e-12;  // radians, beyond all rounding of what follows

/// Where w lies with regard to a polygon that is star-shaped about its axis: +1 inside, -1 outside, 0 within
/// the margin. The polygon's azimuths about the axis never decrease.
int side_of_star(const Vector3d& axis, const DirectionLoop& loop, const Vector3d& w) {
  const Vector3d u = w.normalized();
  bool inside = true, outside = true, found = false;
  const std::size_t n = loop.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector3d &first = loop[i], &next = loop[(i + 1) % n];
    // In the wedge of half-planes from `first` to `next`, edges included a little.
    const Vector3d from = axis.cross(first), to = next.cross(axis);
    if (from.dot(u) < -kMargin * from.norm() || to.dot(u) < -kMargin * to.norm()) continue;
    // A radial step, or a wedge so narrow that those beside it hold all of it too.
    if (from.dot(next) <= 0.5 * kMargin * from.norm() * to.norm()) continue;
    found = true;
    const Vector3d edge = first.cross(next);
    const double height = edge.dot(u), margin = kMargin * edge.norm() + 4e-16;
    inside = inside && height > margin;
    outside = outside && height < -margin;
  }
  if (!found) return 0;
  return inside ? 1 : outside ? -1 : 0;
}

Cone polyhedral(const Vector3d& axis, PolyhedralCone inner, PolyhedralCone outer, const char* method) {
  Cone cone;
  cone.relation = Relation::disjoint;
  cone.axis = axis;
  cone.method = method;
  cone.solid_angle = Interval::between(inner.solid_angle * (1 - 1e-12), outer.solid_angle * (1 + 1e-12));
  if (std::isfinite(outer.cross_section_area))
    cone.section =
        Interval::between(inner.cross_section_area * (1 - 1e-12), outer.cross_section_area * (1 + 1e-12));
  if (!inner.directions.empty()) cone.inner.push_back(inner.directions);
  if (!outer.directions.empty()) cone.outer.push_back(outer.directions);
  cone.star_inner = std::move(inner);
  cone.star_outer = std::move(outer);
  return cone;
}

Cone not_apart(std::optional<Relation> relation, const char* method) {
  Cone cone;
  cone.relation = relation;
  cone.method = method;
  cone.solid_angle = relation ? Interval(4 * pi) : Interval::between(0, 4 * pi);
  return cone;
}

}  // namespace

namespace pairs {

Cone cone_of_ellipsoids(const Ellipsoid& a, const Ellipsoid& b, const ConeOptions& options) {
  const char* method = "silhouette samples";
  constexpr int kMostSamples = 6144;
  for (int samples = 48;; samples *= 2) {
    const TrueCone boundary = true_cone(a, b, samples);
    if (boundary.relation != Relation::disjoint) return not_apart(boundary.relation, method);
    ConeBounds bounds = cone_bounds(boundary, a, b);
    const double width = bounds.outer.solid_angle - bounds.inner.solid_angle;
    if (width > options.tolerance * bounds.outer.solid_angle && samples < kMostSamples) continue;
    return polyhedral(boundary.axis, std::move(bounds.inner), std::move(bounds.outer), method);
  }
}

Cone cone_of_combined(const CombinedEllipsoid& a, const CombinedEllipsoid& b, const ConeOptions& options) {
  const char* method = "certified search";
  CombinedCone found = combined_cone(a, b, options.tolerance);
  if (!found.relation || *found.relation != Relation::disjoint) return not_apart(found.relation, method);
  return polyhedral(found.axis, std::move(found.inner), std::move(found.outer), method);
}

Cone cone_of_hulls(const AssemblyOracle& oracle, const Vector3d& inside, const ConeOptions& options) {
  const char* method = "half-planes of a convex cone";
  if (oracle.relation() != Relation::disjoint) return not_apart(oracle.relation(), method);
  constexpr int kMostHalfPlanes = 5760;
  for (int half_planes = 90;; half_planes *= 2) {
    ConvexReach reach = convex_reach(oracle, inside, half_planes, 1e-10);
    const double width = reach.outer.solid_angle - reach.inner.solid_angle;
    if (width > options.tolerance * reach.outer.solid_angle && half_planes < kMostHalfPlanes) continue;
    return polyhedral(reach.axis, std::move(reach.inner), std::move(reach.outer), method);
  }
}

Cone cone_by_map(const Family& family, const Vector3d& axis, const ConeOptions& options) {
  const char* method = "cone map";
  const auto relation = family.relation();
  if (!relation || *relation != Relation::disjoint) return not_apart(relation, method);
  ConeMapOptions settings;
  settings.resolution = options.resolution;
  settings.threads = options.threads;
  settings.progress = options.progress;
  auto map = std::make_shared<const ConeMap>(cone_map(*family.directions(), settings));
  Cone cone;
  cone.relation = relation;
  cone.axis = axis.isZero(0) ? axis : Vector3d(axis.normalized());
  cone.method = method;
  cone.complete = map->complete;
  cone.solid_angle =
      Interval::between(map->colliding * (1 - 1e-12), (map->colliding + map->undecided) * (1 + 1e-12));
  for (const ConeMapRegion& region : regions(*map))
    for (const DirectionLoop& boundary : region.boundary) {
      DirectionLoop loop;
      for (const Vector3d& d : boundary) loop.push_back(d.normalized());
      if (region.label == Certified::in) {
        cone.inner.push_back(std::move(loop));
      } else {  // around what is safe: the other way round about what may collide
        std::reverse(loop.begin(), loop.end());
        cone.outer.push_back(std::move(loop));
      }
    }
  cone.map = std::move(map);
  return cone;
}

Cone mirror_image(Cone cone) {
  // Through the origin: what turned counter-clockwise turns clockwise.
  const auto reflect = [](DirectionLoop& loop) {
    for (Vector3d& d : loop) d = -d;
    std::reverse(loop.begin(), loop.end());
  };
  cone.axis = -cone.axis;
  for (auto* loops : {&cone.inner, &cone.outer})
    for (DirectionLoop& loop : *loops) reflect(loop);
  for (PolyhedralCone* star : {&cone.star_inner, &cone.star_outer}) reflect(star->directions);
  if (cone.map) {
    auto map = std::make_shared<ConeMap>(*cone.map);
    for (Vector3d& d : map->corners) d = -d;
    for (ConeMapCell& cell : map->cells) std::swap(cell.corners[1], cell.corners[2]);
    cone.map = std::move(map);
  }
  return cone;
}

}  // namespace pairs

Certified Cone::contains(const Vector3d& w) const {
  if (!w.allFinite()) throw InputError("w", "not finite", "a finite velocity (m/s)");
  if (w.isZero(0)) return Certified::out;
  if (!relation) return Certified::undecided;
  if (*relation != Relation::disjoint) return Certified::in;
  if (map) return map->cells[cell_at(*map, w)].label;
  const Vector3d u = w.stableNormalized();
  if (!star_outer.directions.empty() && side_of_star(axis, star_outer.directions, u) < 0)
    return Certified::out;
  if (!star_inner.directions.empty() && side_of_star(axis, star_inner.directions, u) > 0)
    return Certified::in;
  return Certified::undecided;
}

Cone Pair::cone() const { return cone(ConeOptions{}); }

Cone Pair::cone(const ConeOptions& options) const {
  if (!(options.tolerance >= 1e-9 && options.tolerance <= 1))
    throw InputError("tolerance", to_text(options.tolerance), "between 1e-9 and 1");
  return family_->cone(options);
}

ConeMap cone_map(std::span<const Pair> pairs, const ConeMapOptions& options) {
  if (pairs.size() == 1) return cone_map(pairs.front(), options);
  std::vector<std::shared_ptr<const DirectionClassifier>> all;
  for (const Pair& pair : pairs) all.push_back(pair.directions());
  return cone_map(AnyOfClassifier(std::move(all)), options);
}

ConeMap cone_map(const Pair& pair, const ConeMapOptions& options) {
  return cone_map(*pair.directions(), options);
}

}  // namespace vericone
