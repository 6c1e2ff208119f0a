// SPDX-License-Identifier: BSD-3-Clause
//
// Swarms of bodies that a scenario has, and in the free space of a map.
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/random_engagement.h>
#include <vericone/swarm/swarm.h>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "cells.h"

namespace vericone::swarm {

using Eigen::Vector3d;
using engagements::Random;

namespace {

constexpr double kTurning = 1;  // rad/s, of bodies that turn with their heading
constexpr double kBall = 0.2, kClear = 0.5, kFar = 3, kApart = 0.3;  // m

[[noreturn]] void refuse(const std::string& field, const char* value, const char* requirement) {
  throw InputError(field, value, requirement);
}

const CombinedEllipsoid* ellipsoid_of(const WorldBody& body) {
  const CombinedEllipsoid* quadric = body.quadric();
  if (quadric == nullptr && body.placed() != nullptr) quadric = body.placed()->body.quadric();
  return quadric != nullptr && quadric->is_ellipsoid() ? quadric : nullptr;
}

/// Of an ellipsoid in its body's frame, at a motion.
void place(const CombinedEllipsoid& quadric, const Pose& pose, Solid& solid, Vector3d& position) {
  const Ellipsoid& ellipsoid = quadric.ellipsoid();
  // Its axes as they were written, where they were: the first one is ahead.
  const Eigen::Matrix3d& factor = ellipsoid.factor();
  solid.half = factor.colwise().norm();
  Eigen::Matrix3d axes = factor * solid.half.cwiseInverse().asDiagonal();
  if (!((axes.transpose() * axes - Eigen::Matrix3d::Identity()).norm() < 1e-13)) {
    solid.half = ellipsoid.semi_axes();
    axes = ellipsoid.axis_directions();
  }
  if (axes.determinant() < 0) axes.col(2) *= -1;
  solid.rotation = pose.rotation * axes;
  position = pose.position + pose.rotation * ellipsoid.center();
}

Agent agent_of(const simulation::Body& body, const WorldBody& shape, const std::string& name) {
  const CombinedEllipsoid* quadric = ellipsoid_of(shape);
  if (quadric == nullptr) refuse(name + ".shape", "another body", "an ellipsoid, of an agent of a swarm");
  if (quadric->ellipsoid().center().norm() > 0)
    refuse(name + ".shape.center", "another place", "the origin, of an agent of a swarm");
  Agent agent;
  place(*quadric, {body.start.position, body.start.rotation}, agent.body, agent.position);
  agent.velocity = body.start.velocity;
  const simulation::Pilot& pilot = *body.pilot;
  for (std::size_t k = 0; k < pilot.goals.size(); ++k) {
    const simulation::Goal& goal = pilot.goals[k];
    if (goal.velocity.norm() > 0 || !goal.follows.empty() || !goal.after.empty() || goal.stay > 0)
      refuse(name + ".pilot.goals[" + std::to_string(k) + "]",
             "a goal that moves, waits or comes after another", "a point alone, of an agent of a swarm");
    agent.goals.push_back(goal.point);
  }
  agent.most = simulation::most_commanded(pilot);
  agent.fastest = std::isfinite(pilot.fastest) ? pilot.fastest : agent.velocity.norm();
  agent.wished = agent.fastest;
  if (!std::isfinite(agent.most))
    refuse(name + ".pilot.most", "no limit", "a number (m/s^2), of an agent of a swarm");
  if (!(agent.fastest > 0))
    refuse(name + ".pilot.fastest", "nothing", "a number (m/s), of an agent that starts at rest");
  if (body.orientation != simulation::Orientation::fixed) agent.turning = kTurning;
  return agent;
}

/// Of a body at rest all obstacles that it is.
void add_obstacles(const simulation::Body& body, const WorldBody& shape, const std::string& name,
                   std::vector<Obstacle>& obstacles) {
  Pose pose{body.start.position, body.start.rotation};
  Obstacle one;
  if (const CombinedEllipsoid* quadric = ellipsoid_of(shape)) {
    if (shape.placed() != nullptr) pose = composed(pose, shape.placed()->pose);
    place(*quadric, pose, one.body, one.position);
    obstacles.push_back(one);
    return;
  }
  const Assembly* boxes = shape.placed() != nullptr ? shape.placed()->body.assembly() : nullptr;
  if (boxes == nullptr || boxes->kind() != PieceKind::box)
    refuse(name + ".shape", "another body", "an ellipsoid or a map, of a body at rest amid a swarm");
  pose = composed(pose, shape.placed()->pose);
  one.body.box = true;
  one.body.rotation = pose.rotation;
  for (const Box& box : boxes->by_slot().boxes) {
    one.body.half = 0.5 * (box.high - box.low);
    one.position = pose.position + pose.rotation * (0.5 * (box.low + box.high));
    obstacles.push_back(one);
  }
}

/// m, of a point from a body, or less.
double distance(const Obstacle& obstacle, const Vector3d& x) {
  const Vector3d seen = obstacle.body.rotation.transpose() * (x - obstacle.position);
  if (!obstacle.body.box) return seen.norm() - obstacle.body.reach();
  return (seen.cwiseAbs() - obstacle.body.half).cwiseMax(0.0).norm();
}

/// Where a ball may be amid bodies at rest.
class FreeSpace {
 public:
  explicit FreeSpace(const std::vector<Obstacle>& obstacles) : obstacles_(obstacles) {
    std::vector<Vector3d> places;
    double widest = 0;
    for (std::size_t j = 0; j < obstacles.size(); ++j) {
      reaches_.push_back(obstacles[j].body.reach());
      const bool wide = reaches_.back() > kWide;
      (wide ? wide_ : in_cells_).push_back(j);
      if (wide) continue;
      places.push_back(obstacles[j].position);
      widest = std::max(widest, reaches_.back());
    }
    cells_ = Cells(places, widest + kClear + kBetween);
  }

  [[nodiscard]] bool clear(const Vector3d& x, double more = 0) const {
    bool all = true;
    const auto ask = [&](std::size_t j) { all = all && distance(obstacles_[j], x) >= kClear + more; };
    for (const std::size_t j : wide_) ask(j);
    if (all) cells_.around(x, [&](std::uint32_t k) { ask(in_cells_[k]); });
    return all;
  }

  [[nodiscard]] bool clear(const Vector3d& from, const Vector3d& to) const {
    const double length = (to - from).norm();
    const int parts = 1 + static_cast<int>(length / kBetween);
    for (int k = 0; k <= parts; ++k)
      if (!clear(from + (to - from) * k / parts, 0.5 * length / parts)) return false;
    return true;
  }

  /// Whether bodies are on all six sides, along the axes of the world.
  [[nodiscard]] bool inside(const Vector3d& x) const {
    unsigned sides = 0;
    for (std::size_t j = 0; j < obstacles_.size() && sides != 63; ++j) {
      const Vector3d c = obstacles_[j].position - x;
      for (int k = 0; k < 3; ++k)
        if (std::abs(c((k + 1) % 3)) < reaches_[j] && std::abs(c((k + 2) % 3)) < reaches_[j])
          sides |= 1U << (2 * k + (c(k) > 0 ? 1 : 0));
    }
    return sides == 63;
  }

 private:
  static constexpr double kWide = 2, kBetween = 0.1;  // m: bodies that are asked always; of points on a way

  const std::vector<Obstacle>& obstacles_;
  std::vector<double> reaches_;
  std::vector<std::size_t> wide_, in_cells_;
  Cells cells_;
};

}  // namespace

Start start_of(const simulation::Scenario& scenario) {
  Start start;
  for (std::size_t i = 0; i < scenario.bodies.size(); ++i) {
    const simulation::Body& body = scenario.bodies[i];
    const std::string name = "bodies[" + std::to_string(i) + "]";
    const WorldBody* shape = body.shape.rigid();
    if (shape == nullptr || shape->planar())
      refuse(name + ".shape", "another body", "rigid and in space, of a swarm");
    if (body.vehicle != nullptr) refuse(name + ".vehicle", "one", "none: agents of a swarm are point masses");
    if (body.appears > 0) refuse(name + ".appears", "later", "0: all of a swarm are there from the start");
    if (body.pilot && !body.pilot->goals.empty()) {
      start.agents.push_back(agent_of(body, *shape, name));
      continue;
    }
    if (body.pilot) refuse(name + ".pilot.goals", "none", "one or more, of an agent of a swarm");
    if (body.road != nullptr || body.start.velocity.norm() > 0)
      refuse(name + ".velocity", "a body that moves without a pilot",
             "at rest: who gives no way is promised nothing");
    add_obstacles(body, *shape, name, start.obstacles);
  }
  return start;
}

Start start_amid(std::vector<Obstacle> obstacles, std::size_t agents, std::uint64_t seed) {
  Start start;
  start.obstacles = std::move(obstacles);
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Obstacle& one : start.obstacles) {
    low = low.cwiseMin(one.position);
    high = high.cwiseMax(one.position);
  }
  Random random(seed, 0);
  const auto any = [&] {
    Vector3d x;
    for (int k = 0; k < 3; ++k) x(k) = random.uniform(low(k), high(k));
    return x;
  };
  const FreeSpace space(start.obstacles);
  std::vector<Vector3d> places;  // free ones, from which to choose starts and goals
  // Where fewer than one place in a thousand is free there is no room.
  for (std::size_t k = 0; k < 2000 + 1000 * places.size() && places.size() < 12 * agents; ++k) {
    checkpoint();
    if (const Vector3d x = any(); space.clear(x) && space.inside(x)) places.push_back(x);
  }
  const auto apart = [&](const Vector3d& x, const auto& other) {
    return std::all_of(start.agents.begin(), start.agents.end(),
                       [&](const Agent& agent) { return (other(agent) - x).norm() >= 2 * kBall + kApart; });
  };
  for (std::size_t i = 0; i < places.size() && start.agents.size() < agents; ++i) {
    checkpoint();
    if (!apart(places[i], [](const Agent& agent) { return agent.position; })) continue;
    for (std::size_t draw = 0; draw < 60; ++draw) {
      const Vector3d& goal =
          places[std::min(places.size() - 1,
                          static_cast<std::size_t>(random.uniform() * static_cast<double>(places.size())))];
      if ((goal - places[i]).norm() < kFar ||
          !apart(goal, [](const Agent& agent) { return agent.goals[0]; }) || !space.clear(places[i], goal))
        continue;
      Agent agent;
      agent.body = Solid::ball(kBall);
      agent.position = places[i];
      agent.goals = {goal};
      start.agents.push_back(agent);
      break;
    }
  }
  if (start.agents.size() < agents)
    throw InputError("agents", std::to_string(agents),
                     "at most " + std::to_string(start.agents.size()) + ": the others found no free place");
  return start;
}

}  // namespace vericone::swarm
