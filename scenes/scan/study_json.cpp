// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <ostream>

#include "scan/study_json.h"

#include "json/json_value.h"

namespace vericone::scanning {
namespace {

using Json = Json;  // NaN becomes null

Json to_json(const Eigen::Vector2d& v) { return {v.x(), v.y()}; }
Json to_json(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Json to_json(const std::vector<Eigen::Vector2d>& points) {
  Json all = Json::array();
  for (const auto& p : points) all.push_back(to_json(p));
  return all;
}
Json to_json(const HalfPlaneCone& cone) { return {{"solid_angle", cone.solid_angle}, {"edges", cone.edges}}; }

}  // namespace

void write_json(const Study& study, std::ostream& out) {
  Json levels = Json::array();
  for (const Level& l : study.levels)
    levels.push_back(
        {{"fineness", l.fineness},
         {"beams", l.beams},
         {"returned", l.returned},
         {"missed", l.missed},
         {"dropped", l.dropped},
         {"too_near", l.too_near},
         {"spacing", l.spacing},
         {"sections", to_json(l.sections)},
         {"cone", to_json(l.cone)},
         {"planes_without_answer", l.planes_without_answer},
         {"tried", l.tried},
         {"not_fused", l.not_fused.empty() ? Json() : Json(l.not_fused)},
         {"fusion_error", l.fusion_error},
         {"seconds",
          {{"scan", l.seconds_scan}, {"sections", l.seconds_sections}, {"cone", l.seconds_cone}}}});
  const Json json = {{"axis", to_json(study.axis)},
                     {"levels", levels},
                     {"visible",
                      {{"sections", to_json(study.visible_sections)},
                       {"cone", to_json(study.visible_cone)},
                       {"area", study.visible_area}}},
                     {"whole",
                      {{"sections", to_json(study.whole_sections)},
                       {"cone", to_json(study.whole_cone)},
                       {"area", study.whole_area}}}};
  out << json.dump(1) << '\n';
}

void write_json(const PlaneSectionPicture& picture, std::ostream& out) {
  Json obstacle = Json::array(), tangents = Json::array();
  for (const auto& line : picture.obstacle) obstacle.push_back(to_json(line));
  for (const auto& t : picture.tangents)
    tangents.push_back({{"on_agent", to_json(t.on_agent)}, {"on_obstacle", to_json(t.on_obstacle)}});
  const Json json = {{"agent", to_json(picture.agent)},
                     {"obstacle", obstacle},
                     {"sensors", to_json(picture.sensors)},
                     {"returns", to_json(picture.returns)},
                     {"tangents", tangents},
                     {"reason", picture.reason.empty() ? Json() : Json(picture.reason)},
                     {"psi", picture.psi},
                     {"theta_b", picture.theta_b},
                     {"whole_left", picture.whole_left},
                     {"whole_right", picture.whole_right},
                     {"half_thickness", picture.half_thickness},
                     {"tried", picture.tried}};
  out << json.dump(1) << '\n';
}

}  // namespace vericone::scanning
