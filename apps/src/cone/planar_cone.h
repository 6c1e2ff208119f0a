// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/internal/cones/combined/sector.h>
#include <vericone/scenes/scene.h>
#include <iosfwd>
#include <optional>

#include "json/json_forward.h"

namespace vericone {

/// The sector of a planar scene with the source's y.
struct PlanarCone {
  CombinedSector found;  // of other bodies than conics: without what is touched
  /// Nothing: not decided. Of other bodies than conics angles are NaN unless they are apart.
  std::optional<Relation> relation;
  ConeFunction function{};
  double seconds = 0;
};

PlanarCone planar_cone(const scenes::Scene& scene);

/// As docs/reference/formats.md says.
Json to_json(const PlanarCone& cone);
/// The verdict first.
void print_text(const PlanarCone& cone, const scenes::Scene& scene, std::ostream& out);

/// What its picture shows: outlines, sector and edges of `cone`, and the course (course.h).
Json planar_picture(const Json& cone, const scenes::Scene& scene);

}  // namespace vericone
