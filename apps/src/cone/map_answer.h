// SPDX-License-Identifier: BSD-3-Clause
//
// The cone map that `vericone cone --map` adds to the answer, for bodies of every kind.
#pragma once

#include <vericone/cones/map/cone_map.h>
#include <vericone/scenes/scene.h>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "json/json_value.h"

namespace vericone {

inline constexpr double kDefaultResolution = 0.02;  // radians

struct MapRequest {
  double resolution = kDefaultResolution;
  std::optional<Eigen::Vector3d> around;  // the direction whose region is asked for
  int threads = 0;                        // 0: one per processor
};

struct MapAnswer {
  MapRequest request;
  ConeMap map;
  std::vector<ConeMapRegion> regions;   // the largest first
  std::optional<ConeMapRegion> around;  // the region asked for; nothing where its direction is undecided
  double seconds = 0;
  Json picture;  // for apps/figures/cone_map.py
};

/// `middle`: the direction of the middle of the picture where none is asked for. Throws InputError naming
/// "--map" or "--around".
MapAnswer map_answer(const DirectionClassifier& classifier, const MapRequest& request,
                     const Eigen::Vector3d& middle, const std::string& title);

/// The same for two ellipsoids or combined quadrics, the latter by their cone to `tolerance`.
MapAnswer map_answer(const scenes::Scene& scene, const MapRequest& request, double tolerance,
                     const std::string& title);

/// As docs/reference/formats.md says.
Json to_json(const MapAnswer& answer);
void print_map(const MapAnswer& answer, std::ostream& out);

}  // namespace vericone
