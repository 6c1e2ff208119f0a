// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/slices/slice_cone.h>

#include <vericone/geometry/error.h>
#include <vericone/internal/cones/combined/cone.h>
#include <vericone/internal/cones/combined/sector.h>
#include <cmath>
#include <limits>

#include "slices/on_planes.h"

namespace vericone {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSameEdge = 1e-9;  // rad; far above the errors of both ways

/// The slice of two sections as the source finds it; where it finds none, that of all candidates.
Slice as_source(const Slice& slice, const CombinedEllipse& a, const CombinedEllipse& b, SliceSector sectors,
                CombinedSliceCone& cone) {
  const auto choice =
      sectors == SliceSector::source_printed ? TangentChoice::printed : TangentChoice::by_sides;
  const auto source = sector_by_source(a.ellipsoid(), b, choice);
  if (!source || source->relation != Relation::disjoint) {
    ++cone.source_failures;
    return slice;
  }
  const Slice found = slice_of(slice.azimuth, *source);
  cone.source_differences +=
      !(std::abs(found.left - slice.left) <= kSameEdge && std::abs(found.right - slice.right) <= kSameEdge);
  return found;
}

}  // namespace

CombinedSliceCone combined_slice_cone(const CombinedEllipsoid& a, const CombinedEllipsoid& b, int planes,
                                      SliceSector sectors) {
  require_planes(planes);
  if (sectors != SliceSector::all_candidates) {
    if (!a.is_ellipsoid())
      throw InputError("agent", std::to_string(a.delimiters().size()) + " hyperboloids",
                       "an ellipsoid: the source draws tangents to one (6.3.2)");
    if (b.delimiters().size() > 1)
      throw InputError("obstacle", std::to_string(b.delimiters().size()) + " hyperboloids",
                       "delimited by at most one: the source knows four corners (6.3.2)");
  }
  CombinedSliceCone cone;
  cone.relation = combined_relation(a, b);
  cone.axis = (b.center() - a.center()).normalized();
  if (cone.relation != Relation::disjoint) return cone;
  const AxisFrame frame(b.center() - a.center());
  const double distance = (b.center() - a.center()).norm();
  cone.slices.reserve(planes);
  const bool apart = on_planes(frame, planes, [&](double azimuth, const Vector3d& across) {
    const CombinedEllipse flat_a = central_section(a, frame.axis, across, Vector2d::Zero()),
                          flat_b = central_section(b, frame.axis, across, Vector2d(distance, 0));
    const CombinedSector all = combined_sector(flat_a, flat_b);
    if (all.sector.relation != Relation::disjoint) return false;
    cone.hulls_overlap += all.hulls_overlap;
    const Slice slice = slice_of(azimuth, all.sector);
    cone.slices.push_back(
        sectors == SliceSector::all_candidates ? slice : as_source(slice, flat_a, flat_b, sectors, cone));
    return true;
  });
  if (apart) return cone;
  // Disjoint, but closer than the sections in doubles tell.
  CombinedSliceCone undecided;
  undecided.axis = cone.axis;
  return undecided;
}

PolyhedralCone CombinedSliceCone::polyhedral() const {
  if (relation) return SliceCone{*relation, axis, slices}.polyhedral();
  PolyhedralCone unknown;
  unknown.solid_angle = unknown.cross_section_area = std::numeric_limits<double>::quiet_NaN();
  return unknown;
}

}  // namespace vericone
