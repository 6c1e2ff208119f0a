// SPDX-License-Identifier: BSD-3-Clause
#include "cone/map_answer.h"

#include <vericone/geometry/error.h>
#include <vericone/internal/cones/map/classifiers.h>
#include <algorithm>
#include <ostream>

#include "input/stopwatch.h"
#include "json/json_value.h"
#include "output/number_text.h"
#include "picture/cone_map_json.h"

namespace vericone {
namespace {

constexpr std::size_t kShownRegions = 20;

const char* name_of(Certified label) { return label == Certified::in ? "colliding" : "safe"; }

/// Steradian of the regions that may be connected with this one, through undecided cells.
double possibly_connected(const ConeMapRegion& region, const std::vector<ConeMapRegion>& all) {
  if (region.surely_separate) return 0;
  double others = 0;
  for (const ConeMapRegion& other : all)
    if (other.label == region.label && other.possible == region.possible) others += other.solid_angle;
  return std::max(0.0, others - region.solid_angle);
}

/// `all`: the map's.
Json region_json(const ConeMapRegion& region, const std::vector<ConeMapRegion>& all) {
  return {{"label", name_of(region.label)},
          {"solid_angle", region.solid_angle},
          {"most_solid_angle", region.most_solid_angle},
          {"surely_separate", region.surely_separate},
          {"others_possibly_connected", possibly_connected(region, all)},
          {"holes", region.boundary.empty() ? 0 : region.boundary.size() - 1}};
}

}  // namespace

MapAnswer map_answer(const DirectionClassifier& classifier, const MapRequest& request,
                     const Eigen::Vector3d& middle, const std::string& title) {
  if (!(request.resolution >= 1e-4 && request.resolution <= 1))
    throw InputError("--map", to_text(request.resolution), "between 0.0001 and 1 radians");
  if (request.around && !(request.around->norm() > 0))
    throw InputError("--around", "0,0,0", "a direction x,y,z");
  const auto start = Clock::now();
  ConeMapOptions options;
  options.resolution = request.resolution;
  options.threads = request.threads;
  MapAnswer answer{request, cone_map(classifier, options), {}, {}, 0, {}};
  answer.seconds = seconds_since(start);
  answer.regions = regions(answer.map);
  if (request.around) answer.around = region_around(answer.map, *request.around);
  answer.picture = cone_map_json(answer.map, request.around.value_or(middle), request.resolution, title);
  return answer;
}

MapAnswer map_answer(const scenes::Scene& scene, const MapRequest& request, double tolerance,
                     const std::string& title) {
  const CombinedEllipsoid &a = *scene.agent.quadric(), &b = *scene.obstacle.quadric();
  const Eigen::Vector3d between = b.center() - a.center();
  const Eigen::Vector3d middle = between.norm() > 0 ? between : Eigen::Vector3d(1, 0, 0);
  if (a.is_ellipsoid() && b.is_ellipsoid())
    return map_answer(EllipsoidClassifier(a.ellipsoid(), b.ellipsoid()), request, middle, title);
  return map_answer(CombinedClassifier(combined_cone(a, b, tolerance)), request, middle, title);
}

Json to_json(const MapAnswer& answer) {
  const ConeMap& map = answer.map;
  Json list = Json::array();
  for (std::size_t i = 0; i < std::min(answer.regions.size(), kShownRegions); ++i)
    list.push_back(region_json(answer.regions[i], answer.regions));
  Json summary{{"resolution", answer.request.resolution},
               {"colliding", map.colliding},
               {"safe", map.safe},
               {"undecided", map.undecided},
               {"cells", map.cells.size()},
               {"asked", map.asked},
               {"complete", map.complete},
               {"regions_in_all", answer.regions.size()},
               {"regions", list},
               {"around", answer.around ? region_json(*answer.around, answer.regions) : Json(nullptr)},
               {"seconds", answer.seconds}};
  if (const auto& w = answer.request.around) summary["asked_around"] = {w->x(), w->y(), w->z()};
  return summary;
}

void print_map(const MapAnswer& answer, std::ostream& out) {
  const ConeMap& map = answer.map;
  out << "cone map            colliding " << at_least_text(map.colliding, 5) << " sr, safe "
      << at_least_text(map.safe, 5) << " sr, undecided " << at_most_text(map.undecided, 2) << " sr, at "
      << number_text(answer.request.resolution) << " rad\n";
  int safe = 0, colliding = 0;
  for (const ConeMapRegion& region : answer.regions) ++(region.label == Certified::out ? safe : colliding);
  if (answer.regions.size() <= kShownRegions)
    out << "regions             " << colliding << " colliding, " << safe << " safe\n";
  if (answer.request.around) {
    const Eigen::Vector3d& w = *answer.request.around;
    out << "around " << to_text(w.x()) << "," << to_text(w.y()) << "," << to_text(w.z());
    if (!answer.around) {
      out << "  undecided\n";
    } else {
      const ConeMapRegion& region = *answer.around;
      out << "  " << name_of(region.label) << ", a region of "
          << bounds_text(region.solid_angle, region.most_solid_angle, " to ") << " sr"
          << (region.surely_separate
                  ? ", surely apart from all others of its kind\n"
                  : ", may be connected with others of " +
                        number_text(possibly_connected(region, answer.regions), 3) + " sr\n");
    }
  }
  out << "map time            " << number_text(answer.seconds, 2) << " s\n";
}

}  // namespace vericone
