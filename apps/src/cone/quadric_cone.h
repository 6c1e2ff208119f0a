// SPDX-License-Identifier: BSD-3-Clause
//
// The cone of two quadrics in space, by each method of `vericone cone`.
#pragma once

#include <vericone/cones/combined/cone.h>
#include <vericone/cones/ellipsoids/true_cone.h>
#include <vericone/cones/slices/combined_slice_cone.h>
#include <vericone/cones/slices/slice_cone.h>
#include <vericone/scenes/scene.h>
#include <iosfwd>
#include <optional>
#include <variant>
#include <vector>

#include "json/json_forward.h"

namespace vericone {

struct ExactCone {
  int samples = 0;
  TrueCone cone;
  std::optional<ConeBounds> bounds;  // of disjoint bodies
  double seconds = 0;
};

/// Inner and outer cone to a tolerance.
struct CertifiedCone {
  double tolerance = 0;
  CombinedCone cone;
  double seconds = 0;
};

/// By slices: of two ellipsoids (SliceCone), or of bodies with dents.
struct SlicedCone {
  int planes = 0;
  SliceSector sectors = SliceSector::all_candidates;
  std::optional<Relation> relation;
  Eigen::Vector3d axis;
  std::vector<Slice> slices;
  PolyhedralCone polyhedral;
  std::optional<CombinedSliceCone> combined;  // what it says besides, where it was asked
  double seconds = 0;
};

using QuadricCone = std::variant<ExactCone, CertifiedCone, SlicedCone>;

bool ellipsoids(const scenes::Scene& scene);

ExactCone exact_cone(const Ellipsoid& a, const Ellipsoid& b, int samples);
CertifiedCone certified_cone(const CombinedEllipsoid& a, const CombinedEllipsoid& b, double tolerance);
SlicedCone sliced_cone(const scenes::Scene& scene, int planes, SliceSector sectors);

std::optional<Relation> relation_of(const QuadricCone& cone);

/// As docs/reference/formats.md says, without the map.
Json to_json(const QuadricCone& cone, const scenes::Scene& scene);
/// The verdict first.
void print_text(const QuadricCone& cone, const scenes::Scene& scene, std::ostream& out);
/// After the rest.
void print_time(const QuadricCone& cone, std::ostream& out);

}  // namespace vericone
