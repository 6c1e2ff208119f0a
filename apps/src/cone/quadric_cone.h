// SPDX-License-Identifier: BSD-3-Clause
//
// The cone of two quadrics in space, by each method of `vericone cone`.
#pragma once

#include <vericone/cones/slices/slice_cone.h>
#include <vericone/scenes/scene.h>
#include <optional>
#include <string>

#include "json/json_value.h"

namespace vericone {

/// A cone as it is told.
struct QuadricCone {
  std::optional<Relation> relation;
  Json json;         // as docs/reference/formats.md says, without the map
  std::string text;  // without verdict and time
  double seconds = 0;
};

bool ellipsoids(const scenes::Scene& scene);

QuadricCone exact_cone(const Ellipsoid& a, const Ellipsoid& b, int samples);
/// Inner and outer cone to a tolerance.
QuadricCone certified_cone(const CombinedEllipsoid& a, const CombinedEllipsoid& b, double tolerance);
/// By slices: of two ellipsoids (SliceCone), or of bodies with dents.
QuadricCone sliced_cone(const scenes::Scene& scene, int planes, SliceSector sectors);

}  // namespace vericone
