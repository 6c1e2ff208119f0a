// SPDX-License-Identifier: BSD-3-Clause
#include "fit/cone/cone_bodies.h"

#include <vericone/cones/ellipsoids/true_cone.h>
#include <vericone/cones/map/cone_map.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/assembly/convex_reach.h>
#include <vericone/internal/cones/map/classifiers.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace vericone {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

constexpr int kSamples = 512;     // of the boundary of an ellipsoid's cone
constexpr int kHalfPlanes = 360;  // of that of a convex polyhedron
constexpr int kCorners = 360;     // of the prisms in and about an elliptic cylinder
constexpr double kAngle = 1e-10;  // radians, on half-planes

BodyCone everywhere(std::string method) {
  return {.low = 4 * pi, .high = 4 * pi, .disjoint = false, .method = std::move(method), .outline = {}};
}

std::shared_ptr<const DirectionClassifier> classifier_of(const Ellipsoid& agent,
                                                         const CombinedEllipsoid& body, double tolerance) {
  if (body.is_ellipsoid()) return std::make_shared<EllipsoidClassifier>(agent, body.ellipsoid());
  return std::make_shared<CombinedClassifier>(combined_cone(agent, body, tolerance));
}

/// Over an ellipse whose boundary it goes through, or with `outer` touches from outside.
HullBody prism(const fitting::Piece& piece, bool outer) {
  const double scale = outer ? 1 / std::cos(pi / kCorners) : 1;
  std::vector<Vector3d> points;
  for (int i = 0; i < kCorners; ++i) {
    const double t = 2 * pi * i / kCorners;
    const Eigen::Vector2d x = piece.footprint->center() +
                              scale * (piece.footprint->factor() * Eigen::Vector2d(std::cos(t), std::sin(t)));
    points.emplace_back(x.x(), x.y(), piece.low);
    if (piece.low < piece.high) points.emplace_back(x.x(), x.y(), piece.high);
  }
  return HullBody(std::move(points));
}

BodyCone cone_of_cylinder(const Ellipsoid& agent, const fitting::Piece& piece) {
  const Eigen::Vector2d& c = piece.footprint->center();
  const Vector3d inside(c.x(), c.y(), 0.5 * (piece.low + piece.high));
  const BodyCone inner = cone_of_polyhedron(agent, prism(piece, false), inside);
  BodyCone cone = cone_of_polyhedron(agent, prism(piece, true), inside);
  cone.low = inner.low;
  cone.method = "prisms of 360 sides in and about the cylinder";
  return cone;
}

BodyCone cone_of_cylinders(const Ellipsoid& agent, const std::vector<fitting::Piece>& pieces,
                           const MapSettings& settings) {
  const auto by_prisms = [&](bool outer) {
    std::vector<HullBody> prisms;
    for (const fitting::Piece& piece : pieces) prisms.push_back(prism(piece, outer));
    return cone_by_map(AssemblyOracle(agent, Assembly::polyhedra(std::move(prisms))), settings);
  };
  BodyCone cone = by_prisms(true);
  cone.low = by_prisms(false).low;
  return cone;
}

}  // namespace

BodyCone cone_by_map(const DirectionClassifier& classifier, const MapSettings& settings) {
  ConeMapOptions options;
  options.resolution = settings.resolution;
  options.threads = settings.threads;
  bool stopped = false;
  if (settings.progress)
    options.progress = [&](double share) {
      stopped = stopped || !settings.progress(share);
      return !stopped;
    };
  const ConeMap map = cone_map(classifier, options);
  if (stopped) throw Interrupted{};
  BodyCone cone;
  cone.low = map.colliding;
  cone.high = map.colliding + map.undecided;
  cone.method = "cone map";
  for (const ConeMapRegion& region : regions(map)) {
    if (region.label != Certified::out) continue;
    for (const auto& loop : region.boundary) {
      auto& line = cone.outline.emplace_back();
      for (const Vector3d& d : loop) line.push_back(d.normalized());
    }
  }
  return cone;
}

BodyCone cone_of_ellipsoid(const Ellipsoid& agent, const Ellipsoid& body) {
  const char* method = "exact cone";
  const TrueCone exact = true_cone(agent, body, kSamples);
  if (exact.relation != Relation::disjoint) return everywhere(method);
  ConeBounds bounds = cone_bounds(exact, agent, body);
  BodyCone cone{.low = bounds.solid_angle - bounds.solid_angle_error,
                .high = bounds.solid_angle + bounds.solid_angle_error,
                .disjoint = true,
                .method = method,
                .outline = {}};
  cone.outline.push_back(std::move(bounds.outer.directions));
  return cone;
}

BodyCone cone_of_combined(const Ellipsoid& agent, const CombinedEllipsoid& body, double tolerance) {
  if (body.is_ellipsoid()) return cone_of_ellipsoid(agent, body.ellipsoid());
  const std::string method = "certified inner and outer cone";
  CombinedCone bounds = combined_cone(agent, body, tolerance);
  if (!bounds.relation) {
    BodyCone cone = everywhere(method + ", not decided whether the bodies touch");
    cone.low = 0;
    return cone;
  }
  if (*bounds.relation != Relation::disjoint) return everywhere(method);
  BodyCone cone{.low = bounds.inner.solid_angle,
                .high = bounds.outer.solid_angle,
                .disjoint = true,
                .method = method,
                .outline = {}};
  cone.outline.push_back(std::move(bounds.outer.directions));
  return cone;
}

BodyCone cone_of_polyhedron(const Ellipsoid& agent, const HullBody& body, const Vector3d& inside) {
  const std::string method = std::to_string(kHalfPlanes) + " half-planes of a convex cone";
  const AssemblyOracle oracle(agent, Assembly::polyhedra({body}));
  if (oracle.relation() != Relation::disjoint) return everywhere(method);
  ConvexReach reach = convex_reach(oracle, inside - agent.center(), kHalfPlanes, kAngle);
  BodyCone cone{.low = reach.inner.solid_angle,
                .high = reach.outer.solid_angle,
                .disjoint = true,
                .method = method,
                .outline = {}};
  cone.outline.push_back(std::move(reach.outer.directions));
  return cone;
}

BodyCone cone_of_pieces(const Ellipsoid& agent, const std::vector<fitting::Piece>& pieces, double tolerance,
                        const MapSettings& settings) {
  std::vector<std::shared_ptr<const DirectionClassifier>> all;
  double largest = 0, sum = 0;
  bool footprints = false;
  for (const fitting::Piece& piece : pieces) {
    footprints = piece.footprint.has_value();
    BodyCone alone =
        footprints ? cone_of_cylinder(agent, piece) : cone_of_combined(agent, piece.body, tolerance);
    if (pieces.size() == 1 || !alone.disjoint) return alone;
    largest = std::max(largest, alone.low);
    sum += alone.high;
    if (!footprints) all.push_back(classifier_of(agent, piece.body, tolerance));
  }
  BodyCone cone = footprints ? cone_of_cylinders(agent, pieces, settings)
                             : cone_by_map(AnyOfClassifier(std::move(all)), settings);
  cone.low = std::max(cone.low, largest);
  cone.high = std::min(cone.high, sum);
  cone.method += " of " + std::to_string(pieces.size()) + " pieces";
  return cone;
}

}  // namespace vericone
