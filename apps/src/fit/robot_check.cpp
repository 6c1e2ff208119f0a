// SPDX-License-Identifier: BSD-3-Clause
#include "fit/robot_check.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <ostream>

#include "fit/robot_shapes.h"
#include "json/json_value.h"

namespace vericone {
namespace {

struct LinkCheck {
  std::string name;
  fitting::Certificate meshes;
  std::size_t shapes = 0, shapes_inside = 0;

  bool holds() const { return meshes.all_inside() && shapes == shapes_inside; }
};

bool is_same(const fitting::Solid& a, const fitting::Solid& b) {
  return a.kind == b.kind && a.center == b.center && a.rotation == b.rotation && a.sizes == b.sizes;
}

/// Points whose hull has the body in it, all in one solid.
bool has_corners(const std::vector<fitting::Solid>& solids, const fitting::Sample& corners) {
  return std::any_of(solids.begin(), solids.end(), [&](const fitting::Solid& solid) {
    return fitting::check({solid}, corners).points_inside == corners.points.size();
  });
}

LinkCheck check_link(const RobotShapes& robot, const RobotShapes::Link& link,
                     const std::vector<fitting::Solid>& solids) {
  LinkCheck result;
  result.name = link.text.name;
  fitting::Sample meshes;
  for (const robot::Geometry& shape : *link.shapes) {
    if (!shape.body) {
      robot.add_mesh(shape, meshes);
      continue;
    }
    ++result.shapes;
    const std::optional<fitting::Solid> own = solid_of(shape);
    const auto same = [&](const fitting::Solid& other) { return own && is_same(*own, other); };
    result.shapes_inside += std::any_of(solids.begin(), solids.end(), same) ||
                            (!solids.empty() && has_corners(solids, corners_around(shape)));
  }
  if (!meshes.is_mesh()) return result;
  meshes = merged(std::move(meshes));
  if (solids.empty()) {
    result.meshes.points = meshes.points.size();
    result.meshes.triangles = meshes.triangles.size();
  } else {
    result.meshes = fitting::check(solids, meshes);
  }
  return result;
}

}  // namespace

int check_robot(const FitCommandOptions& given, std::ostream& out) {
  if (!given.certificate.empty())
    throw InputError("--certificate", given.certificate, "left out: certificates have no words for robots");
  const RobotShapes robot(given.file, given.packages), other(given.check, given.packages);
  const std::vector<RobotShapes::Link> others = other.links();
  std::vector<LinkCheck> checks;
  for (const RobotShapes::Link& link : robot.links()) {
    std::vector<fitting::Solid> solids;
    for (const RobotShapes::Link& one : others)
      if (one.text.name == link.text.name)
        for (const robot::Geometry& shape : *one.shapes)
          if (const auto solid = solid_of(shape)) solids.push_back(*solid);
    checks.push_back(check_link(robot, link, solids));
  }
  const bool good = std::all_of(checks.begin(), checks.end(), [](const LinkCheck& c) { return c.holds(); });
  if (given.json) {
    Json links = Json::array();
    for (const LinkCheck& c : checks)
      links.push_back({{"name", c.name},
                       {"holds", c.holds()},
                       {"triangles", c.meshes.triangles},
                       {"triangles_inside", c.meshes.triangles_inside},
                       {"shapes", c.shapes},
                       {"shapes_inside", c.shapes_inside}});
    out << json_text({{"holds", good}, {"links", links}}) << '\n';
    return good ? 0 : 1;
  }
  for (const LinkCheck& c : checks) {
    std::string label = "link " + c.name;
    label.resize(std::max<std::size_t>(20, label.size() + 1), ' ');
    out << label << c.meshes.triangles_inside << " of " << c.meshes.triangles << " triangles inside";
    if (c.shapes) out << ", " << c.shapes_inside << " of " << c.shapes << " other shapes";
    out << '\n';
  }
  out << "certificate         " << (good ? "holds" : "does NOT hold") << " (" << given.check << ")\n";
  return good ? 0 : 1;
}

}  // namespace vericone
