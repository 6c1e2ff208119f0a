// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/scanning/picture.h>
#include <vericone/scanning/study.h>

#include <vericone/geometry/error.h>
#include <sstream>

#include "json/json_value.h"
#include "output/output_file.h"
#include "output/slice_json.h"
#include "scan/study_json.h"
#include "scan/study_parts.h"

namespace vericone::scanning {
namespace {

using Eigen::Vector3d;

std::string ply(const std::vector<Vector3d>& points) {
  std::ostringstream out;
  out << "ply\nformat ascii 1.0\ncomment metres, world frame; made by vericone scan\nelement vertex "
      << points.size() << "\nproperty double x\nproperty double y\nproperty double z\nend_header\n";
  for (const Vector3d& x : points)
    out << to_text(x.x()) << ' ' << to_text(x.y()) << ' ' << to_text(x.z()) << '\n';
  return out.str();
}

/// The source's sectors of the fused cloud.
Json sectors_json(const VisibleCone& cone, const Vector3d& v_agent, const Vector3d& v_obstacle) {
  Json sectors = Json::array();
  for (const VisiblePlane& plane : cone.planes) {
    Json one{{"azimuth", plane.azimuth}, {"points", plane.points}, {"tried", plane.tried}};
    if (plane.slice) {
      one.update(sector_json(*plane.slice, cone.axis, v_agent, v_obstacle));
    } else {
      one["reason"] = to_string(plane.reason);
    }
    sectors.push_back(one);
  }
  return sectors;
}

Json parsed(const auto& what) {
  std::ostringstream text;
  write_json(what, text);
  return Json::parse(text.str());
}

}  // namespace

Findings scan_and_study(const Setup& setup, const std::function<void(const std::string&)>& told) {
  Findings found;
  found.seen = look(setup, lidar::MeshScene(setup.points, setup.triangles), setup.lidars);
  if (told) told(std::to_string(found.seen.points.size()) + " returns");
  found.study = study(setup, told);
  if (found.seen.not_fused.empty())
    found.cone = visible_cone(setup.agent, points_near_plane(found.seen.points, found.seen.half_thickness),
                              center_of(found.seen.points), setup.planes);
  return found;
}

std::string scan_text(const Setup& setup, const Findings& found, const Vector3d& v_agent,
                      const Vector3d& v_obstacle) {
  const Seen& seen = found.seen;
  Json result = parsed(found.study);
  std::size_t beams = 0;
  for (const lidar::Lidar& l : setup.lidars) beams += l.beams.size();
  result["planes"] = setup.planes;
  result["seed"] = setup.seed;
  result["cloud"] = {
      {"beams", beams}, {"points", seen.points.size()}, {"half_thickness", seen.half_thickness}};
  result["fusion"] = nullptr;
  if (setup.position_error > 0 || setup.rotation_error > 0)
    result["fusion"] = {{"failed", seen.not_fused.empty() ? Json(nullptr) : Json(seen.not_fused)},
                        {"error", seen.not_fused.empty() ? Json(seen.fusion_error) : Json(nullptr)}};
  result["sectors"] = nullptr;
  if (found.cone) {
    Json sectors = polyhedral_json(found.cone->polyhedral());
    const Vector3d& axis = found.cone->axis;
    sectors["axis"] = {axis.x(), axis.y(), axis.z()};
    sectors["planes_without_answer"] = found.cone->planes_without_answer();
    sectors["sectors"] = sectors_json(*found.cone, v_agent, v_obstacle);
    result["sectors"] = sectors;
  }
  return result.dump(1) + "\n";
}

void write_scan(const Setup& setup, const Findings& found, const Vector3d& v_agent,
                const Vector3d& v_obstacle, double azimuth, const std::filesystem::path& folder) {
  const std::string picture = parsed(plane_section_picture(setup, azimuth)).dump() + "\n";
  write_whole(folder / "cloud.ply", ply(found.seen.points));
  write_whole(folder / "scan.json", scan_text(setup, found, v_agent, v_obstacle));
  write_whole(folder / "section.json", picture);
}

}  // namespace vericone::scanning
