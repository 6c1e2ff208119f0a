// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/slices/combined_slice_cone.h>

#include <vericone/cones/combined/cone.h>
#include <vericone/cones/combined/sector.h>
#include <vericone/geometry/error.h>
#include <cmath>
#include <limits>
#include <numbers>

namespace vericone {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSameEdge = 1e-9;  // rad; far above the errors of both ways

struct Edges {
  double left = 0, right = 0;
};

/// The line of sight is the x axis and inside the sector, each edge less than a half turn from it.
Edges edges_of(const Sector& sector) {
  return {0.5 * sector.psi + sector.theta_b, 0.5 * sector.psi - sector.theta_b};
}

/// Whether the bodies are disjoint. Their ellipsoids contain them and are asked first, which is cheap.
std::optional<Relation> relation_of(const CombinedEllipsoid& a, const CombinedEllipsoid& b) {
  const Relation ellipsoids = relation<3>(a.ellipsoid(), b.ellipsoid());
  if (ellipsoids == Relation::disjoint || (a.is_ellipsoid() && b.is_ellipsoid())) return ellipsoids;
  return CombinedOracle(a, b).relation();
}

class CombinedSlicer {
 public:
  CombinedSlicer(const CombinedEllipsoid& a, const CombinedEllipsoid& b, SliceSector sectors)
      : a_(a),
        b_(b),
        frame_(b.center() - a.center()),
        distance_((b.center() - a.center()).norm()),
        sectors_(sectors) {}

  /// False where the sections overlap or touch within rounding.
  bool add(double azimuth, CombinedSliceCone& cone) const {
    const Vector3d across = std::cos(azimuth) * frame_.e1 + std::sin(azimuth) * frame_.e2;
    const CombinedEllipse a = central_section(a_, frame_.axis, across, Vector2d::Zero()),
                          b = central_section(b_, frame_.axis, across, Vector2d(distance_, 0));
    const CombinedSector all = combined_sector(a, b);
    if (all.sector.relation != Relation::disjoint) return false;
    cone.hulls_overlap += all.hulls_overlap;
    Edges edges = edges_of(all.sector);
    if (sectors_ != SliceSector::all_candidates) {
      const auto choice =
          sectors_ == SliceSector::source_printed ? TangentChoice::printed : TangentChoice::by_sides;
      const auto source = sector_by_source(a.ellipsoid(), b, choice);
      if (source && source->relation == Relation::disjoint) {
        const Edges as_source = edges_of(*source);
        cone.source_differences += !(std::abs(as_source.left - edges.left) <= kSameEdge &&
                                     std::abs(as_source.right - edges.right) <= kSameEdge);
        edges = as_source;
      } else {
        ++cone.source_failures;
      }
    }
    cone.slices.push_back({azimuth, edges.left, edges.right});
    return true;
  }

 private:
  const CombinedEllipsoid &a_, &b_;
  AxisFrame frame_;
  double distance_;
  SliceSector sectors_;
};

}  // namespace

CombinedSliceCone combined_slice_cone(const CombinedEllipsoid& a, const CombinedEllipsoid& b, int planes,
                                      SliceSector sectors) {
  if (planes < 1 || planes > 1'000'000)
    throw InputError("planes", std::to_string(planes), "a whole number from 1 to 1000000");
  if (sectors != SliceSector::all_candidates) {
    if (!a.is_ellipsoid())
      throw InputError("agent", std::to_string(a.delimiters().size()) + " hyperboloids",
                       "an ellipsoid: the source draws tangents to one (6.3.2)");
    if (b.delimiters().size() > 1)
      throw InputError("obstacle", std::to_string(b.delimiters().size()) + " hyperboloids",
                       "delimited by at most one: the source knows four corners (6.3.2)");
  }
  CombinedSliceCone cone;
  cone.relation = relation_of(a, b);
  cone.axis = (b.center() - a.center()).normalized();
  if (cone.relation != Relation::disjoint) return cone;
  const CombinedSlicer slicer(a, b, sectors);
  cone.slices.reserve(planes);
  for (int j = 0; j < planes; ++j)
    if (!slicer.add(std::numbers::pi * j / planes, cone)) {
      // Disjoint, but closer than the sections in doubles tell.
      CombinedSliceCone undecided;
      undecided.axis = cone.axis;
      return undecided;
    }
  return cone;
}

PolyhedralCone CombinedSliceCone::polyhedral() const {
  if (relation) return SliceCone{*relation, axis, slices}.polyhedral();
  PolyhedralCone unknown;
  unknown.solid_angle = unknown.cross_section_area = std::numeric_limits<double>::quiet_NaN();
  return unknown;
}

}  // namespace vericone
