// SPDX-License-Identifier: BSD-3-Clause
#include "picture/cone_map_json.h"

#include <vericone/cones/map/cone_map.h>

#include "json/json_value.h"

namespace vericone {
namespace {

Json region_json(const std::optional<ConeMapRegion>& region) {
  if (!region) return nullptr;
  return {{"label", to_string(region->label)},
          {"solid_angle", region->solid_angle},
          {"most_solid_angle", region->most_solid_angle},
          {"surely_separate", region->surely_separate},
          {"holes", region->boundary.empty() ? 0 : region->boundary.size() - 1}};
}

}  // namespace

Json cone_map_json(const ConeMap& map, const Eigen::Vector3d& towards, double resolution,
                   const std::string& title) {
  Json corners = Json::array(), cells = Json::array();
  for (const Eigen::Vector3d& x : map.corners) corners.push_back(vector_json(x));
  std::string labels;
  for (const ConeMapCell& cell : map.cells) {
    cells.push_back(cell.corners);
    labels.push_back(to_string(cell.label)[0]);
  }
  const auto region = region_around(map, towards);
  Json region_part = region_json(region);
  if (region) {
    Json loops = Json::array();
    for (const auto& loop : region->boundary) {
      Json points = Json::array();
      for (const Eigen::Vector3d& x : loop) points.push_back(vector_json(x));
      loops.push_back(std::move(points));
    }
    region_part["boundary"] = std::move(loops);
  }
  return {{"title", title},
          {"towards", vector_json(Eigen::Vector3d(towards.stableNormalized()))},
          {"colliding", map.colliding},
          {"safe", map.safe},
          {"undecided", map.undecided},
          {"asked", map.asked},
          {"complete", map.complete},
          {"resolution", resolution},
          {"corners", std::move(corners)},
          {"cells", std::move(cells)},
          {"labels", labels},
          {"region", std::move(region_part)}};
}

}  // namespace vericone
