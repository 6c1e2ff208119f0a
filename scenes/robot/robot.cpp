// SPDX-License-Identifier: BSD-3-Clause
#include "robot/robot.h"

#include <vericone/geometry/body.h>
#include <vericone/geometry/error.h>
#include <Eigen/Geometry>
#include <charconv>
#include <cmath>
#include <set>

namespace vericone::robot {
namespace {

Pose motion_of(const Joint& joint, double value) {
  Pose moved;
  if (value == 0 || !joint.moves()) return moved;
  if (joint.turns())
    moved.rotation = Eigen::AngleAxisd(value, joint.axis).toRotationMatrix();
  else
    moved.position = value * joint.axis;
  return moved;
}

std::string list_of(const std::vector<Joint>& joints) {
  std::string list;
  for (const Joint& joint : joints)
    if (joint.moves() && !joint.mimic) list.append(list.empty() ? "" : ", ").append(joint.name);
  return list.empty() ? "left out: no joint moves" : "of joints that move: " + list;
}

const Joint* find(const Robot& robot, const std::string& name) {
  for (const Joint& joint : robot.joints)
    if (joint.name == name) return &joint;
  return nullptr;
}

/// Of a joint that mimics another, that of the other; through at most as many as there are.
double value_of(const Robot& robot, const Joint& joint, const std::map<std::string, double>& values) {
  double multiplier = 1, offset = 0;
  const Joint* at = &joint;
  for (std::size_t i = 0; at->mimic; ++i) {
    if (i == robot.joints.size())
      refuse(joint.mimic->line, joint.name, "joints that do not mimic each other in a circle");
    offset += multiplier * at->mimic->offset;
    multiplier *= at->mimic->multiplier;
    const Joint* other = find(robot, at->mimic->joint);
    if (!other) refuse(at->mimic->line, at->mimic->joint, "the name of a joint");
    at = other;
  }
  const auto given = values.find(at->name);
  return multiplier * (given == values.end() ? 0 : given->second) + offset;
}

void require_within(const Joint& joint, double value, bool given) {
  // A value in the last place beside a limit is no mistake.
  const auto beyond = [](double x, double limit) { return x > limit + 1e-9 * (1 + std::abs(limit)); };
  const bool low = joint.lower && beyond(-value, -*joint.lower),
             high = joint.upper && beyond(value, *joint.upper);
  if (low || high)
    throw InputError("joints." + joint.name,
                     to_text(value) + (given ? "" : ", which is taken where it is left out"),
                     "between " + (joint.lower ? to_text(*joint.lower) : "-inf") + " and " +
                         (joint.upper ? to_text(*joint.upper) : "inf"));
}

}  // namespace

std::vector<double> numbers(const std::string& text, std::size_t count, int line, const std::string& what) {
  std::vector<double> all;
  const char *at = text.data(), *end = text.data() + text.size();
  const auto wrong = [&]() {
    refuse(line, what + " \"" + text.substr(0, 40) + "\"",
           std::to_string(count) + (count == 1 ? " finite number" : " finite numbers"));
  };
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  for (;;) {
    while (at != end && blank(*at)) ++at;
    if (at == end) break;
    if (*at == '+') ++at;
    double x = 0;
    const auto [next, error] = std::from_chars(at, end, x);
    // What underflows is 0, as strtod has it.
    if ((error != std::errc() && error != std::errc::result_out_of_range) || next == at ||
        (next != end && !blank(*next)))
      wrong();
    if (error == std::errc::result_out_of_range) x = std::strtod(std::string(at, next).c_str(), nullptr);
    if (!std::isfinite(x) || all.size() == count) wrong();
    all.push_back(x);
    at = next;
  }
  if (all.size() != count) wrong();
  return all;
}

Eigen::Matrix3d turn_of(const Eigen::Vector3d& rpy) {
  if (rpy.isZero(0)) return Eigen::Matrix3d::Identity();
  using Eigen::AngleAxisd, Eigen::Vector3d;
  return orthonormal<3>((AngleAxisd(rpy.z(), Vector3d::UnitZ()) * AngleAxisd(rpy.y(), Vector3d::UnitY()) *
                         AngleAxisd(rpy.x(), Vector3d::UnitX()))
                            .toRotationMatrix());
}

const std::string& needed(const Element& element, const char* attribute) {
  const std::string* given = element.attribute(attribute);
  if (!given)
    refuse(element.line, "<" + element.name + ">", std::string("one with ") + attribute + "=\"...\"");
  return *given;
}

const Element& needed_child(const Element& element, const char* child) {
  const Element* given = element.child(child);
  if (!given) refuse(element.line, "<" + element.name + ">", std::string("one with <") + child + ">");
  return *given;
}

double size_of(const std::string& text, int line, const std::string& what) {
  const double x = numbers(text, 1, line, what).front();
  if (!(x >= 0)) refuse(line, what + " " + to_text(x), "0 or more (metres)");
  return x;
}

Eigen::Vector3d unit_axis(const Eigen::Vector3d& axis, int line) {
  const double length = axis.stableNorm();
  if (!(length > 0)) refuse(line, "an axis of length 0", "a direction");
  return axis / length;
}

Robot read_robot(const Element& root, Shown shown, const Include& include) {
  if (root.name == "robot") return read_urdf(root, shown);
  if (root.name == "sdf") return read_sdf(root, shown, include);
  refuse(root.line, "<" + root.name.substr(0, 40) + ">", "<robot> (URDF) or <sdf>");
}

std::vector<Pose> link_places(const Robot& robot, const std::map<std::string, double>& values) {
  std::set<std::string> names;
  for (const Joint& joint : robot.joints)
    if (!names.insert(joint.name).second) refuse(joint.line, joint.name, "a name that no other joint has");
  for (const auto& [name, value] : values) {
    const Joint* joint = find(robot, name);
    if (!joint || !joint->moves() || joint->mimic)
      throw InputError("joints." + name, to_text(value), list_of(robot.joints));
  }
  std::vector<const Joint*> above(robot.links.size(), nullptr);
  for (const Joint& joint : robot.joints) {
    if (above[joint.child])
      refuse(joint.line, robot.links[joint.child].name,
             "the child of one joint: " + above[joint.child]->name + " has it");
    above[joint.child] = &joint;
  }
  std::vector<Pose> places(robot.links.size());
  std::vector<char> state(robot.links.size(), 0), at_rest(robot.links.size(), 0);  // 2: known
  // From each link up to one that is known, and back.
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    std::vector<std::size_t> way;
    for (std::size_t link = i; state[link] != 2; link = above[link]->parent) {
      if (state[link] == 1)
        refuse(above[link]->line, above[link]->name, "joints that do not go round in a circle");
      state[link] = 1;
      way.push_back(link);
      if (!above[link]) break;
    }
    for (; !way.empty(); way.pop_back()) {
      const std::size_t link = way.back();
      state[link] = 2;
      const Joint* joint = above[link];
      const std::optional<Pose>& rest = robot.links[link].rest;
      if (!joint) {
        places[link] = rest.value_or(Pose());
        at_rest[link] = 1;
        continue;
      }
      const double value = joint->moves() ? value_of(robot, *joint, values) : 0;
      require_within(*joint, value, values.contains(joint->name));
      at_rest[link] = at_rest[joint->parent] && value == 0;
      // Nothing is rounded where the file says where a link stands.
      places[link] =
          at_rest[link] && rest
              ? *rest
              : composed(composed(composed(places[joint->parent], joint->origin), motion_of(*joint, value)),
                         joint->child_in);
      places[link].rotation = orthonormal<3>(places[link].rotation);
    }
  }
  return places;
}

}  // namespace vericone::robot
