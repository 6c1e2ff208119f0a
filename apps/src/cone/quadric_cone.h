// SPDX-License-Identifier: BSD-3-Clause
//
// The cone of two quadrics in space, by each method of `vericone cone`.
#pragma once

#include <vericone/cones/ellipsoids/true_cone.h>
#include <vericone/cones/slices/slice_cone.h>
#include <vericone/internal/cones/combined/cone.h>
#include <vericone/scenes/scene.h>
#include <iosfwd>
#include <optional>
#include <utility>
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

/// One of them.
class QuadricCone {
 public:
  QuadricCone(ExactCone cone) : exact_(std::move(cone)) {}          // NOLINT: it is one
  QuadricCone(CertifiedCone cone) : certified_(std::move(cone)) {}  // NOLINT
  QuadricCone(SlicedCone cone) : sliced_(std::move(cone)) {}        // NOLINT

  /// What `ask` says of the one that it is.
  template <typename Ask>
  decltype(auto) ask(Ask ask) const {
    if (exact_) return ask(*exact_);
    if (certified_) return ask(*certified_);
    return ask(*sliced_);
  }

 private:
  std::optional<ExactCone> exact_;
  std::optional<CertifiedCone> certified_;
  std::optional<SlicedCone> sliced_;
};

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
