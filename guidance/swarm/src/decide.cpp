// SPDX-License-Identifier: BSD-3-Clause
//
// What an agent does in a step: what it sees, the velocity that keeps all planes, the plan that is proved.
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/random_engagement.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "state.h"

namespace vericone::swarm {

using Eigen::Vector3d;

namespace {

constexpr double kAside = std::numbers::pi / 3;
constexpr double kGolden = 2.399963229728653;  // rad, of the golden section
constexpr double kToMakeRoom = 0.5;            // s, within which the room of planes is to be there again
constexpr double kSlow = 1e-3;                 // m/s: below it has no heading to turn to
constexpr double kTurned = 1e-6;               // rad: it need not turn
constexpr double kAtOnce = 0.05;  // of the wished speed: planes that bind within it are made at once
constexpr double kNever = std::numeric_limits<double>::infinity();

void keep_nearest(std::vector<Neighbour>& all, std::size_t most) {
  if (all.size() > most) {
    std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(most), all.end());
    all.resize(most);
  }
  std::sort(all.begin(), all.end());
}

}  // namespace

void Swarm::State::gather(std::size_t i, Scratch& scratch) const {
  const Vector3d& at = agents[i].position;
  const auto after = static_cast<std::uint32_t>(agents.size());
  scratch.neighbours.clear();
  scratch.near.clear();
  const double sight = options.sight * options.sight;
  cells.around(at, [&](std::uint32_t j) {
    if (j == i) return;
    const double square = (agents[j].position - at).squaredNorm(), near = near_by[i] + near_by[j];
    if (square <= sight) scratch.neighbours.push_back({square, j});
    if (square <= near * near) scratch.near.push_back(j);
  });
  scratch.near_agents = scratch.near.size();
  scratch.obstacles.clear();
  for (const std::uint32_t j : wide) scratch.near.push_back(after + j);
  obstacle_cells.around(at, [&](std::uint32_t k) {
    const std::uint32_t j = in_cells[k];
    const double distance = (obstacles[j].position - at).norm() - obstacle_bodies[j].reach;
    if (distance <= obstacle_sight) scratch.obstacles.push_back({distance * std::abs(distance), j});
    if (distance <= near_by[i]) scratch.near.push_back(after + j);
  });
  keep_nearest(scratch.neighbours, options.neighbours);
  keep_nearest(scratch.obstacles, options.neighbours);
}

Swarm::State::Known* Swarm::State::known_of(std::uint32_t number, const std::vector<Known>& old,
                                            Scratch& scratch) {
  std::uint32_t& slot = scratch.slots[number];
  if (slot <= old.size()) {
    scratch.known.push_back(slot > 0 ? old[slot - 1] : Known{number});
    slot = static_cast<std::uint32_t>(old.size() + scratch.known.size());
  }
  return &scratch.known[slot - old.size() - 1];
}

void Swarm::State::look_at(std::size_t i, Scratch& scratch) const {
  const Agent& agent = agents[i];
  const std::vector<Known>& old = known[i];
  const auto after = static_cast<std::uint32_t>(agents.size());
  scratch.slots.resize(agents.size() + obstacles.size(), 0);
  for (std::size_t k = 0; k < old.size(); ++k)
    scratch.slots[old[k].number] = static_cast<std::uint32_t>(k + 1);
  scratch.known.clear();
  scratch.known.reserve(scratch.near.size() + wide.size() + scratch.obstacles.size() +
                        scratch.neighbours.size());
  for (const std::uint32_t number : scratch.near) (void)known_of(number, old, scratch);
  scratch.seen.clear();
  const auto add = [&](std::uint32_t number, const Prepared& other, const Vector3d& c, const Vector3d& v,
                       double share) {
    Seen one{&other, c, v, share, other.box ? options.box_horizon : options.horizon, -1, nullptr, true};
    const double most = roomy[i].reach + other.reach;
    if (other.box) {
      one.clear = (c.norm() - most) / one.horizon - agent.fastest > 0 ? kNever : -1;
    } else if (!(roomy[i].round && other.round)) {
      one.known = known_of(number, old, scratch);
      if (one.known->plane.squaredNorm() > 0)
        one.clear = share * outside_by(roomy[i], other, c, v, one.horizon, one.known->plane);
      if (one.clear < kAtOnce * agent.wished && c.squaredNorm() > most * most) {
        const Vector3d n = normal_of_balls(roomy[i], other, c, v, one.horizon);
        one.clear = std::max(one.clear, share * outside_by(roomy[i], other, c, v, one.horizon, n));
      }
    } else if (c.norm() <= most) {
      // Nearer than the room that is wanted: it is to be there again after a while, ORCA's after a step.
      one.horizon = orca() ? options.step : kToMakeRoom;
    }
    one.taken = one.clear < kAtOnce * agent.wished;
    scratch.seen.push_back(one);
  };
  const auto add_obstacle = [&](std::uint32_t j) {
    add(after + j, obstacle_bodies[j], obstacles[j].position - agent.position, agent.velocity, 1);
  };
  for (const std::uint32_t j : wide) add_obstacle(j);
  for (const Neighbour& near : scratch.obstacles) add_obstacle(near.index);
  for (const Neighbour& near : scratch.neighbours) {
    const Agent& other = agents[near.index];
    const double both = agent.share + other.share;
    add(near.index, roomy[near.index], other.position - agent.position, agent.velocity - other.velocity,
        both > 0 ? agent.share / both : 0.5);
  }
  for (const Known& one : old) scratch.slots[one.number] = 0;
  for (const Known& one : scratch.known) scratch.slots[one.number] = 0;
}

VelocityFound Swarm::State::best_velocity(std::size_t i, Scratch& scratch) const {
  const Agent& agent = agents[i];
  const Vector3d wished = wish(i);
  const auto made = [&](Seen& one) {
    const ReciprocalPlane plane =
        Between(roomy[i], *one.body).plane(one.c, one.v, one.horizon, Nearest::in_speed);
    if (one.known != nullptr) one.known->plane = plane.normal;
    one.half_space = {plane.normal, plane.normal.dot(agent.velocity + one.share * plane.change)};
  };
  for (Seen& one : scratch.seen)
    if (one.taken) made(one);
  VelocityFound found;
  for (bool again = true; again;) {
    scratch.planes.clear();
    for (const Seen& one : scratch.seen)
      if (one.taken) scratch.planes.push_back(one.half_space);
    found = nearest_velocity(scratch.planes, agent.fastest, wished);
    // What was left out keeps all velocities that are nearer to the present one than it is clear.
    const double changed = (found.velocity - agent.velocity).norm();
    again = false;
    for (Seen& one : scratch.seen) {
      if (one.taken || one.clear >= changed) continue;
      one.taken = true;
      made(one);
      again = again || one.half_space.offset - one.half_space.normal.dot(found.velocity) > found.violation;
    }
  }
  return found;
}

Vector3d Swarm::State::wish(std::size_t i) const {
  const Agent& agent = agents[i];
  const std::size_t k = std::min(heading[i], agent.goals.size() - 1);
  Vector3d way = agent.goals[k] - agent.position;
  // Towards the last goal ever slower: a metre before it at 1 m/s.
  const double distance = way.norm();
  const bool last = k + 1 == agent.goals.size();
  if (distance > 0) way *= (last ? std::min(agent.wished, distance) : agent.wished) / distance;
  if (!(now() < aside_until[i]) || !(way.norm() > 0)) return way;
  // To the right, as all do: around each other. Upwards or downwards each another way.
  const double size = way.norm();
  const Vector3d ahead = way / size, right = ahead.cross(Vector3d::UnitZ());
  Vector3d aside = right.normalized();
  if (!(right.norm() > 0.1)) {
    const double turn = kGolden * static_cast<double>(i + stuck[i]);
    const Vector3d e = ahead.unitOrthogonal();
    aside = std::cos(turn) * e + std::sin(turn) * ahead.cross(e);
  }
  return size * (std::cos(kAside) * ahead + std::sin(kAside) * aside);
}

void Swarm::State::ask_own_laws() {
  using guidance::BodyState;
  const auto state = [](const Solid& solid, const Vector3d& position, const Vector3d& velocity) {
    BodyState body;
    body.shape = world_body(solid).posed(position, solid.rotation);
    body.position = position;
    body.velocity = velocity;
    return body;
  };
  for (std::size_t i = 0; i < agents.size(); ++i) {
    const Agent& agent = agents[i];
    if (!agent.steering) continue;
    gather(i, rooms[0]);
    std::vector<BodyState> others;
    for (const Neighbour& one : rooms[0].neighbours)
      others.push_back(state(agents[one.index].body, agents[one.index].position, agents[one.index].velocity));
    for (const std::uint32_t j : wide)
      others.push_back(state(obstacles[j].body, obstacles[j].position, Vector3d::Zero()));
    for (const Neighbour& one : rooms[0].obstacles)
      others.push_back(state(obstacles[one.index].body, obstacles[one.index].position, Vector3d::Zero()));
    accelerations[i] = agent.steering(now(), state(agent.body, agent.position, agent.velocity), others);
    if (!accelerations[i].allFinite())
      throw InputError("agents[" + std::to_string(i) + "].steering", "no finite acceleration",
                       "a finite acceleration (m/s^2)");
  }
}

Vector3d Swarm::State::turn_towards(std::size_t i, const Vector3d& velocity) const {
  const Agent& agent = agents[i];
  const double speed = velocity.norm();
  if (!(agent.turning > 0) || !(speed > kSlow)) return Vector3d::Zero();
  const Vector3d ahead = agent.body.rotation.col(0), axis = ahead.cross(velocity) / speed;
  const double angle = std::atan2(axis.norm(), ahead.dot(velocity) / speed);
  if (!(angle > kTurned)) return Vector3d::Zero();
  const Vector3d about = axis.norm() > 1e-9 ? Vector3d(axis.normalized()) : Vector3d(ahead.unitOrthogonal());
  return std::min(angle, agent.turning * options.step) * about;
}

bool Swarm::State::apart_from_stops(const Course& course, Scratch& scratch) const {
  for (std::size_t k = 0; k < scratch.near.size(); ++k) {
    const std::uint32_t number = scratch.near[k];
    Vector3d& hint = scratch.known[k].between;
    if (number < agents.size()) {
      if (!apart(course, stop_of(number), &hint)) return false;
      continue;
    }
    const std::size_t j = number - agents.size();
    const Plan rests = Plan::stop(obstacles[j].position, Vector3d::Zero(), 1);
    if (!apart(course, {rests, &obstacle_bodies[j]}, &hint)) return false;
  }
  return true;
}

void Swarm::State::decide(std::size_t i, Scratch& scratch) {
  const Agent& agent = agents[i];
  gather(i, scratch);
  look_at(i, scratch);
  const auto limited = [&](Vector3d a) {
    if (const double size = a.stableNorm(); size > agent.most) a *= agent.most / size;
    return a;
  };
  Vector3d wanted;
  if (agent.steering && !orca()) {
    wanted = limited(accelerations[i]);
    const Vector3d later = agent.velocity + options.step * wanted;
    if (const double speed = later.norm(); speed > agent.fastest)
      wanted = limited((agent.fastest / speed * later - agent.velocity) / options.step);
  } else {
    const VelocityFound found = best_velocity(i, scratch);
    scratch.unsafe += found.violation > 0;
    if (orca()) {
      accelerations[i] = found.velocity;  // it is its velocity from now on
      return;
    }
    wanted = limited((found.velocity - agent.velocity) / options.step);
  }
  const Vector3d braking = limited(-agent.velocity / options.step);
  offers[i] = 0;
  for (const double part : {1.0, 0.5, 0.25}) {
    const Vector3d a = part * wanted + (1 - part) * braking;
    plans[i] = Plan(agent.position, agent.velocity, a, options.step, agent.most);
    accelerations[i] = a;
    turns[i] = turn_towards(i, agent.velocity + options.step * a);
    const bool turns_here = turns[i].squaredNorm() > 0;
    if (turns_here) bodies[i][1] = Prepared(turned(agent.body, turns[i]));
    bool proved = apart_from_stops(plan_of(i), scratch);
    if (!proved && turns_here) {
      turns[i].setZero();
      proved = apart_from_stops(plan_of(i), scratch);
    }
    if (!proved) continue;
    offers[i] = 1;
    break;
  }
  known[i] = scratch.known;
  near_agents[i] = static_cast<std::uint32_t>(scratch.near_agents);
}

bool Swarm::State::hears(std::size_t i, std::size_t j) const {
  if (!(options.lost > 0)) return true;
  return engagements::Random(options.seed, (steps * agents.size() + i) * agents.size() + j).uniform() >=
         options.lost;
}

bool Swarm::State::agreed(std::size_t i) {
  if (!offers[i]) return false;
  // Agents that can come near stand at the beginning of what it knows.
  for (std::size_t k = 0; k < near_agents[i]; ++k) {
    Known& one = known[i][k];
    if (!hears(i, one.number)) return false;
    if (offers[one.number] && outranks(one.number, i) &&
        !apart(plan_of(i), plan_of(one.number), &one.between))
      return false;
  }
  return true;
}

}  // namespace vericone::swarm
