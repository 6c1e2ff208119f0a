// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/random_engagement.h>
#include <vericone/swarm/swarm.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "cells.h"
#include "plan.h"
#include "threads.h"

namespace vericone::swarm {

using Eigen::Vector3d;

namespace {

// Deadlocks: an agent that in kLook seconds has come nearer to its goal by less than kProgress of what it
// flies alone turns kAside rad off for kLong seconds.
constexpr double kLook = 2, kProgress = 0.4, kLong = 6, kAside = std::numbers::pi / 3;
constexpr double kGolden = 2.399963229728653;  // rad, of the golden section
constexpr double kRoom = 0.1;                  // of its size, that an agent's planes keep free about it
constexpr double kToMakeRoom = 0.5;            // s, within which that room is to be there again
constexpr double kWide = 4;                    // obstacles that reach so many times sight are asked always

struct Neighbour {
  double square;  // of the distance, m^2
  std::uint32_t index;
  bool operator<(const Neighbour& other) const {
    return square != other.square ? square < other.square : index < other.index;
  }
};

void keep_nearest(std::vector<Neighbour>& all, std::size_t most) {
  if (all.size() > most) {
    std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(most), all.end());
    all.resize(most);
  }
  std::sort(all.begin(), all.end());
}

[[noreturn]] void refuse(const std::string& field, double value, const char* requirement) {
  throw InputError(field, to_text(value), requirement);
}

void check(const Solid& body, const std::string& name) {
  for (int k = 0; k < 3; ++k)
    if (!(body.half(k) > 0) || !std::isfinite(body.half(k)))
      refuse(name + ".half[" + std::to_string(k) + "]", body.half(k), "a positive finite number (m)");
  if (!((body.rotation.transpose() * body.rotation - Eigen::Matrix3d::Identity()).norm() < 1e-12))
    throw InputError(name + ".rotation", "another matrix", "orthonormal to 1e-12");
}

void check(const Vector3d& x, const std::string& name) {
  if (!x.allFinite() || x.lpNorm<Eigen::Infinity>() > 1e5)
    throw InputError(name, to_text(x.x()) + ", " + to_text(x.y()) + ", " + to_text(x.z()),
                     "within 1e5 m (m/s)");
}

void check(const Agent& agent, const std::string& name) {
  check(agent.body, name + ".body");
  if (agent.body.box) throw InputError(name + ".body.box", "true", "false: agents are ellipsoids");
  check(agent.position, name + ".position");
  check(agent.velocity, name + ".velocity");
  if (agent.goals.empty()) throw InputError(name + ".goals", "none", "one or more");
  for (std::size_t k = 0; k < agent.goals.size(); ++k)
    check(agent.goals[k], name + ".goals[" + std::to_string(k) + "]");
  if (!(agent.share >= 0 && agent.share <= 1)) refuse(name + ".share", agent.share, "0 to 1");
  for (const auto& [field, value] :
       {std::pair(".wished", agent.wished), {".fastest", agent.fastest}, {".most", agent.most}})
    if (!(value > 0) || !std::isfinite(value)) refuse(name + field, value, "a positive finite number");
  if (!(agent.wished <= agent.fastest)) refuse(name + ".wished", agent.wished, "at most `fastest`");
}

void check(const SwarmOptions& options) {
  const auto positive = [](double value, const char* name) {
    if (!(value > 0) || !std::isfinite(value)) refuse(name, value, "a positive finite number");
  };
  positive(options.step, "step");
  positive(options.horizon, "horizon");
  positive(options.box_horizon, "box_horizon");
  positive(options.sight, "sight");
  if (!(options.lost >= 0 && options.lost <= 1)) refuse("lost", options.lost, "0 to 1");
  if (options.neighbours == 0) throw InputError("neighbours", "0", "1 or more");
}

}  // namespace

const char* to_string(Method method) { return method == Method::proved ? "proved" : "orca"; }

SwarmOptions SwarmOptions::published() {
  SwarmOptions options;
  options.method = Method::orca;
  options.horizon = 10;
  options.neighbours = 10;
  return options;
}

struct Swarm::State {
  State(std::vector<Agent> given, std::vector<Obstacle> at_rest, const SwarmOptions& chosen);

  struct Scratch {
    std::vector<Neighbour> neighbours, obstacles;
    std::vector<std::uint32_t> near, near_obstacles;
    std::vector<VelocityHalfSpace> planes;
    std::uint64_t unsafe = 0;
  };

  [[nodiscard]] bool orca() const { return options.method == Method::orca; }
  void look_around();
  void gather(std::size_t i, Scratch& scratch) const;
  void add_planes(std::size_t i, Scratch& scratch) const;
  [[nodiscard]] Vector3d wish(std::size_t i) const;
  void decide(std::size_t i, Scratch& scratch);
  [[nodiscard]] bool apart_from_stops(std::size_t i, const Plan& plan, const Scratch& scratch) const;
  [[nodiscard]] bool agreed(std::size_t i) const;
  [[nodiscard]] bool hears(std::size_t i, std::size_t j) const;
  [[nodiscard]] bool outranks(std::size_t i, std::size_t j) const {
    return waited[i] != waited[j] ? waited[i] > waited[j] : i < j;
  }
  void move(std::size_t i);
  void watch(std::size_t i);
  [[nodiscard]] double to_go(std::size_t i) const;
  void check_start();

  std::vector<Agent> agents;
  std::vector<Obstacle> obstacles;
  SwarmOptions options;
  std::uint64_t steps = 0;
  SwarmCounts counts;
  std::vector<std::size_t> heading;
  std::vector<Flown> flown;
  std::vector<Scratch> rooms;

  std::vector<Prepared> bodies, obstacle_bodies;
  std::vector<Prepared> roomy;      // of agents, with the room that planes keep
  std::vector<std::uint32_t> wide;  // obstacles that are asked always
  Cells obstacle_cells;
  std::vector<std::uint32_t> in_cells;  // of obstacles, by their number among the cells
  double widest_obstacle = 0;           // m, reach of those in cells

  // Of this step: what each does where it gives up, what it would fly, and whether it does.
  std::vector<Plan> stops, plans;
  std::vector<Vector3d> accelerations;
  std::vector<std::uint8_t> offers, flies;
  std::vector<std::uint32_t> waited;  // steps in a row that it braked
  Cells cells;
  std::vector<double> near_by;  // m, from its position, of all that it may cover by what it does now
  double farthest = 0;          // of all of these
  // Of deadlocks.
  std::vector<std::uint32_t> stuck;
  std::vector<double> left, aside_until;  // m, s
};

Swarm::State::State(std::vector<Agent> given, std::vector<Obstacle> at_rest, const SwarmOptions& chosen)
    : agents(std::move(given)), obstacles(std::move(at_rest)), options(chosen) {
  check(options);
  for (std::size_t i = 0; i < agents.size(); ++i) check(agents[i], "agents[" + std::to_string(i) + "]");
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    const std::string name = "obstacles[" + std::to_string(i) + "]";
    check(obstacles[i].body, name + ".body");
    check(obstacles[i].position, name + ".position");
  }
  for (const Agent& agent : agents) {
    Solid body = orca() ? Solid::ball(agent.body.reach()) : agent.body;
    bodies.emplace_back(body);
    if (!orca()) body.half *= 1 + kRoom;
    roomy.emplace_back(body);
  }
  std::vector<Vector3d> places;
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    const Solid& solid = obstacles[i].body;
    obstacle_bodies.emplace_back(orca() && !solid.box ? Solid::ball(solid.reach()) : solid);
    if (obstacles[i].body.box || obstacle_bodies[i].reach > kWide * options.sight) {
      wide.push_back(static_cast<std::uint32_t>(i));
      continue;
    }
    in_cells.push_back(static_cast<std::uint32_t>(i));
    places.push_back(obstacles[i].position);
    widest_obstacle = std::max(widest_obstacle, obstacle_bodies[i].reach);
  }
  double reach = 0, speed = 0, braking = 0;
  for (const Agent& agent : agents) {
    reach = std::max(reach, agent.body.reach());
    speed = std::max({speed, agent.fastest, agent.velocity.norm()});
    braking = std::max(braking, 1 / agent.most);
  }
  const double covered = 2 * (speed * options.step + speed * speed * braking) + reach;
  obstacle_cells = Cells(places, std::max(options.sight, covered) + widest_obstacle);
  const std::size_t count = agents.size();
  heading.assign(count, 0);
  flown.resize(count);
  stops.resize(count);
  plans.resize(count);
  accelerations.resize(count);
  offers.assign(count, 0);
  flies.assign(count, 0);
  waited.assign(count, 0);
  stuck.assign(count, 0);
  near_by.assign(count, 0);
  aside_until.assign(count, -1);
  rooms.resize(static_cast<std::size_t>(std::max(1, options.threads)));
  for (std::size_t i = 0; i < count; ++i) left.push_back(to_go(i));
  look_around();
  if (!orca()) check_start();
}

void Swarm::State::check_start() {
  for (std::size_t i = 0; i < agents.size(); ++i) {
    gather(i, rooms[0]);
    if (!apart_from_stops(i, stops[i], rooms[0]))
      throw InputError("agents[" + std::to_string(i) + "]", "a start too near to another body",
                       "apart from all others while all brake to rest");
  }
}

double Swarm::State::to_go(std::size_t i) const {
  const Agent& agent = agents[i];
  double length = 0;
  Vector3d at = agent.position;
  for (std::size_t k = std::min(heading[i], agent.goals.size() - 1); k < agent.goals.size(); ++k) {
    length += (agent.goals[k] - at).norm();
    at = agent.goals[k];
  }
  return length;
}

void Swarm::State::look_around() {
  std::vector<Vector3d> places;
  places.reserve(agents.size());
  farthest = 0;
  for (std::size_t i = 0; i < agents.size(); ++i) {
    const Agent& agent = agents[i];
    places.push_back(agent.position);
    stops[i] = Plan::stop(agent.position, agent.velocity, agent.most);
    const double fast = agent.velocity.norm() + agent.most * options.step;
    near_by[i] = bodies[i].reach + fast * options.step + 0.5 * fast * fast / agent.most + kPadding;
    farthest = std::max(farthest, near_by[i]);
  }
  cells = Cells(places, std::max(options.sight, 2 * farthest));
}

void Swarm::State::gather(std::size_t i, Scratch& scratch) const {
  const Vector3d& at = agents[i].position;
  scratch.neighbours.clear();
  scratch.near.clear();
  const double sight = options.sight * options.sight;
  cells.around(at, [&](std::uint32_t j) {
    if (j == i) return;
    const double square = (agents[j].position - at).squaredNorm(), near = near_by[i] + near_by[j];
    if (square <= sight) scratch.neighbours.push_back({square, j});
    if (square <= near * near) scratch.near.push_back(j);
  });
  scratch.obstacles.clear();
  scratch.near_obstacles = wide;
  obstacle_cells.around(at, [&](std::uint32_t k) {
    const std::uint32_t j = in_cells[k];
    const double distance = (obstacles[j].position - at).norm() - obstacle_bodies[j].reach;
    if (distance <= options.sight) scratch.obstacles.push_back({distance * std::abs(distance), j});
    if (distance <= near_by[i]) scratch.near_obstacles.push_back(j);
  });
  keep_nearest(scratch.neighbours, options.neighbours);
  keep_nearest(scratch.obstacles, options.neighbours);
}

void Swarm::State::add_planes(std::size_t i, Scratch& scratch) const {
  const Agent& agent = agents[i];
  scratch.planes.clear();
  const auto add = [&](const Prepared& other, const Vector3d& c, const Vector3d& v, double share) {
    const Between between(roomy[i], other);
    double horizon = other.box ? options.box_horizon : options.horizon;
    // Nearer than the room that is wanted: it is to be there again after a while, ORCA's after a step.
    if (roomy[i].round && other.round && c.norm() <= between.most())
      horizon = orca() ? options.step : kToMakeRoom;
    const ReciprocalPlane plane = between.plane(c, v, horizon, Nearest::in_speed);
    scratch.planes.push_back({plane.normal, plane.normal.dot(agent.velocity + share * plane.change)});
  };
  for (const std::uint32_t j : wide)
    add(obstacle_bodies[j], obstacles[j].position - agent.position, agent.velocity, 1);
  for (const Neighbour& near : scratch.obstacles)
    add(obstacle_bodies[near.index], obstacles[near.index].position - agent.position, agent.velocity, 1);
  for (const Neighbour& near : scratch.neighbours) {
    const Agent& other = agents[near.index];
    const double both = agent.share + other.share;
    add(roomy[near.index], other.position - agent.position, agent.velocity - other.velocity,
        both > 0 ? agent.share / both : 0.5);
  }
}

Vector3d Swarm::State::wish(std::size_t i) const {
  const Agent& agent = agents[i];
  const std::size_t k = std::min(heading[i], agent.goals.size() - 1);
  Vector3d way = agent.goals[k] - agent.position;
  // Towards the last goal ever slower: a metre before it at 1 m/s.
  const double distance = way.norm();
  const bool last = k + 1 == agent.goals.size();
  if (distance > 0) way *= (last ? std::min(agent.wished, distance) : agent.wished) / distance;
  if (!(static_cast<double>(steps) * options.step < aside_until[i]) || !(way.norm() > 0)) return way;
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

bool Swarm::State::apart_from_stops(std::size_t i, const Plan& plan, const Scratch& scratch) const {
  for (const std::uint32_t j : scratch.near)
    if (!apart(bodies[i], plan, bodies[j], stops[j])) return false;
  for (const std::uint32_t j : scratch.near_obstacles)
    if (!apart(bodies[i], plan, obstacle_bodies[j], Plan::stop(obstacles[j].position, Vector3d::Zero(), 1)))
      return false;
  return true;
}

void Swarm::State::decide(std::size_t i, Scratch& scratch) {
  const Agent& agent = agents[i];
  gather(i, scratch);
  add_planes(i, scratch);
  const VelocityFound found = nearest_velocity(scratch.planes, agent.fastest, wish(i));
  scratch.unsafe += found.violation > 0;
  if (orca()) {
    accelerations[i] = found.velocity;  // it is its velocity from now on
    return;
  }
  const auto towards = [&](const Vector3d& velocity) {
    Vector3d a = (velocity - agent.velocity) / options.step;
    if (const double size = a.norm(); size > agent.most) a *= agent.most / size;
    return a;
  };
  const Vector3d wanted = towards(found.velocity), braking = towards(Vector3d::Zero());
  offers[i] = 0;
  for (const double part : {1.0, 0.5, 0.25}) {
    const Vector3d a = part * wanted + (1 - part) * braking;
    const Plan plan(agent.position, agent.velocity, a, options.step, agent.most);
    if (!apart_from_stops(i, plan, scratch)) continue;
    plans[i] = plan;
    accelerations[i] = a;
    offers[i] = 1;
    return;
  }
}

bool Swarm::State::hears(std::size_t i, std::size_t j) const {
  if (!(options.lost > 0)) return true;
  return engagements::Random(options.seed, (steps * agents.size() + i) * agents.size() + j).uniform() >=
         options.lost;
}

bool Swarm::State::agreed(std::size_t i) const {
  if (!offers[i]) return false;
  const Vector3d& at = agents[i].position;
  bool all = true;
  cells.around(at, [&](std::uint32_t j) {
    if (!all || j == i) return;
    const double near = near_by[i] + near_by[j];
    if ((agents[j].position - at).squaredNorm() > near * near) return;
    if (!hears(i, j))
      all = false;
    else if (offers[j] && outranks(j, i))
      all = apart(bodies[i], plans[i], bodies[j], plans[j]);
  });
  return all;
}

void Swarm::State::move(std::size_t i) {
  Agent& agent = agents[i];
  Flown& way = flown[i];
  way = {agent.position, agent.velocity, Vector3d::Zero(), options.step};
  if (orca()) {
    way.velocity = accelerations[i];
    agent.velocity = way.velocity;
    agent.position += options.step * way.velocity;
    return;
  }
  if (flies[i]) {
    way.acceleration = accelerations[i];
    const PlanLeg after = plans[i].legs().size() > 1 ? plans[i].legs()[1] : plans[i].legs()[0];
    agent.position = after.position;
    agent.velocity = after.velocity;
    waited[i] = 0;
    return;
  }
  ++waited[i];
  const PlanLeg& braking = stops[i].legs()[0];
  way.acceleration = braking.acceleration;
  way.seconds = std::min(options.step, stops[i].end());
  if (stops[i].end() > options.step) {
    agent.position = braking.at(options.step);
    agent.velocity = braking.velocity_at(options.step);
  } else {
    agent.position = stops[i].last();
    agent.velocity.setZero();
  }
}

void Swarm::State::watch(std::size_t i) {
  const Agent& agent = agents[i];
  const auto passed = [&](std::size_t k) {
    const Vector3d& goal = agent.goals[k];
    if ((goal - agent.position).norm() <= agent.body.reach()) return true;
    if (k + 1 == agent.goals.size()) return false;
    const Vector3d& next = agent.goals[k + 1];
    return (next - agent.position).squaredNorm() <= (next - goal).squaredNorm();
  };
  while (heading[i] < agent.goals.size() && passed(heading[i])) ++heading[i];
  const auto look = static_cast<std::uint64_t>(std::ceil(kLook / options.step));
  if (steps % look != 0 || heading[i] == agent.goals.size()) return;
  const double now = to_go(i), flown_by = left[i] - now;
  left[i] = now;
  const double t = static_cast<double>(steps) * options.step;
  // After a turn aside it first goes straight again for as long as it takes to see whether that helps.
  if (t < aside_until[i] + kLook || flown_by >= kProgress * agent.wished * kLook) return;
  ++counts.deadlocks;
  ++stuck[i];
  if (!orca()) aside_until[i] = t + kLong;
}

Swarm::Swarm(std::vector<Agent> agents, std::vector<Obstacle> obstacles, const SwarmOptions& options)
    : state_(std::make_unique<State>(std::move(agents), std::move(obstacles), options)) {}
Swarm::Swarm(Swarm&&) noexcept = default;
Swarm& Swarm::operator=(Swarm&&) noexcept = default;
Swarm::~Swarm() = default;

void Swarm::step() {
  State& s = *state_;
  const std::size_t count = s.agents.size();
  s.look_around();
  on_threads(count, s.options.threads, [&](std::size_t i, std::size_t k) { s.decide(i, s.rooms[k]); });
  if (!s.orca())
    on_threads(count, s.options.threads, [&](std::size_t i, std::size_t) { s.flies[i] = s.agreed(i); });
  ++s.steps;
  for (std::size_t i = 0; i < count; ++i) {
    s.counts.fallbacks += !s.orca() && !s.flies[i] && s.agents[i].velocity.norm() > 0;
    s.move(i);
    s.watch(i);
  }
  s.counts.commands += count;
  for (State::Scratch& one : s.rooms) s.counts.unsafe += std::exchange(one.unsafe, 0);
}

double Swarm::time() const { return state_->options.step * static_cast<double>(state_->steps); }
const std::vector<Agent>& Swarm::agents() const { return state_->agents; }
const std::vector<Obstacle>& Swarm::obstacles() const { return state_->obstacles; }
const std::vector<Flown>& Swarm::flown() const { return state_->flown; }
const SwarmCounts& Swarm::counts() const { return state_->counts; }
const SwarmOptions& Swarm::options() const { return state_->options; }
const std::vector<std::size_t>& Swarm::heading() const { return state_->heading; }

}  // namespace vericone::swarm
