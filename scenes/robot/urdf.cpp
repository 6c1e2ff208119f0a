// SPDX-License-Identifier: BSD-3-Clause
//
// URDF (wiki.ros.org/urdf/XML): whole sizes, metres and radians, cylinders about z and about their middle.
#include <algorithm>
#include <iterator>
#include <map>

#include "robot/robot.h"

namespace vericone::robot {
namespace {

using Eigen::Vector3d;

Pose origin_of(const Element& element) {
  Pose pose;
  const Element* origin = element.child("origin");
  if (!origin) return pose;
  if (const std::string* xyz = origin->attribute("xyz"))
    pose.position = vector_of<3>(*xyz, origin->line, "xyz");
  if (const std::string* rpy = origin->attribute("rpy"))
    pose.rotation = turn_of(vector_of<3>(*rpy, origin->line, "rpy"));
  return pose;
}

Geometry urdf_geometry(const Element& owner) {
  Geometry result;
  result.pose = origin_of(owner);
  const Element& geometry = needed_child(owner, "geometry");
  if (geometry.children.size() != 1)
    refuse(geometry.line, "<geometry> of " + std::to_string(geometry.children.size()), "one shape");
  const Element& shape = geometry.children.front();
  const auto size = [&](const char* name) { return size_of(needed(shape, name), shape.line, name); };
  if (shape.name == "box") {
    const Vector3d edges = vector_of<3>(needed(shape, "size"), shape.line, "size");
    if (!(edges.array() >= 0).all()) refuse(shape.line, "a size below 0", "0 or more (metres)");
    result.body = Convex::box(0.5 * edges);
  } else if (shape.name == "sphere") {
    result.body = Convex::capsule(size("radius"), 0).called("ball");
  } else if (shape.name == "cylinder") {
    result.body = Convex::cylinder(size("radius"), size("length"));
  } else if (shape.name == "capsule") {
    result.body = Convex::capsule(size("radius"), size("length"));
  } else if (shape.name == "mesh") {
    result.mesh = {needed(shape, "filename"), Vector3d::Ones(), shape.line};
    if (const std::string* scale = shape.attribute("scale"))
      result.mesh.scale = vector_of<3>(*scale, shape.line, "scale");
  } else {
    refuse(shape.line, "<" + shape.name.substr(0, 40) + ">", "box, sphere, cylinder, capsule or mesh");
  }
  return result;
}

Joint urdf_joint(const Element& element, const std::map<std::string, std::size_t>& links) {
  Joint joint;
  joint.line = element.line;
  joint.name = needed(element, "name");
  joint.type = needed(element, "type");
  const char* const kinds[] = {"fixed", "revolute", "continuous", "prismatic"};
  if (std::find(std::begin(kinds), std::end(kinds), joint.type) == std::end(kinds))
    refuse(element.line, "type \"" + joint.type.substr(0, 40) + "\"",
           "fixed, revolute, continuous or prismatic: others have no one value");
  const auto link = [&](const char* role) {
    const Element& named = needed_child(element, role);
    const auto found = links.find(needed(named, "link"));
    if (found == links.end()) refuse(named.line, needed(named, "link"), "the name of a link");
    return found->second;
  };
  joint.parent = link("parent");
  joint.child = link("child");
  joint.origin = origin_of(element);
  if (const Element* axis = element.child("axis"))
    joint.axis = unit_axis(vector_of<3>(needed(*axis, "xyz"), axis->line, "xyz"), axis->line);
  if (const Element* limit = element.child("limit");
      limit && (joint.type == "revolute" || joint.type == "prismatic")) {
    const auto end = [&](const char* name) {
      const std::string* given = limit->attribute(name);
      return given ? numbers(*given, 1, limit->line, name).front() : 0.0;  // as URDF says
    };
    joint.lower = end("lower");
    joint.upper = end("upper");
  }
  if (const Element* mimic = element.child("mimic")) {
    joint.mimic.emplace();
    joint.mimic->line = mimic->line;
    joint.mimic->joint = needed(*mimic, "joint");
    if (const std::string* given = mimic->attribute("multiplier"))
      joint.mimic->multiplier = numbers(*given, 1, mimic->line, "multiplier").front();
    if (const std::string* given = mimic->attribute("offset"))
      joint.mimic->offset = numbers(*given, 1, mimic->line, "offset").front();
  }
  return joint;
}

}  // namespace

Robot read_urdf(const Element& root, Shown shown) {
  for (const Element& element : root.children)
    if (element.name.starts_with("xacro:"))
      refuse(element.line, "<" + element.name.substr(0, 40) + ">",
             "URDF without macros: xacro FILE > robot.urdf writes it");
  Robot robot;
  std::map<std::string, std::size_t> links;
  for (const Element& element : root.children) {
    if (element.name != "link") continue;
    Link link;
    link.name = needed(element, "name");
    if (!links.emplace(link.name, robot.links.size()).second)
      refuse(element.line, link.name.substr(0, 40), "a name that no other link has");
    for (const Element& part : element.children)
      if (part.name == (shown == Shown::collision ? "collision" : "visual"))
        link.geometries.push_back(urdf_geometry(part));
    robot.links.push_back(std::move(link));
  }
  if (robot.links.empty()) refuse(root.line, "no link", "a robot of one link or more");
  for (const Element& element : root.children)
    if (element.name == "joint") robot.joints.push_back(urdf_joint(element, links));
  if (robot.joints.size() + 1 < robot.links.size())
    refuse(root.line, std::to_string(robot.links.size() - robot.joints.size()) + " links without a parent",
           "one: the others are joined to it");
  return robot;
}

}  // namespace vericone::robot
