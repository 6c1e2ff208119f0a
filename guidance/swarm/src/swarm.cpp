// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/swarm/swarm.h>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "state.h"
#include "threads.h"

namespace vericone::swarm {

using Eigen::Vector3d;

namespace {

constexpr double kRoomOfPlanes = 0.1;  // of its size, that an agent's planes keep free about it
constexpr double kWide = 4;            // obstacles that reach so many times sight are asked always

Prepared with_room(Solid body) {
  body.half *= 1 + kRoomOfPlanes;
  return Prepared(body);
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

Swarm::State::State(std::vector<Agent> given, std::vector<Obstacle> at_rest, const SwarmOptions& chosen)
    : agents(std::move(given)), obstacles(std::move(at_rest)), options(chosen) {
  check(options);
  for (std::size_t i = 0; i < agents.size(); ++i) check(agents[i], "agents[" + std::to_string(i) + "]");
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    const std::string name = "obstacles[" + std::to_string(i) + "]";
    check(obstacles[i], name);
  }
  for (const Agent& agent : agents) {
    const Solid body = orca() ? Solid::ball(agent.body.reach()) : agent.body;
    bodies.push_back({Prepared(body), Prepared(body)});
    roomy.push_back(orca() ? Prepared(body) : with_room(body));
  }
  std::vector<Vector3d> places;
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    const Solid& solid = obstacles[i].body;
    obstacle_bodies.emplace_back(orca() && !solid.box ? Solid::ball(solid.reach()) : solid);
    if (obstacle_bodies[i].reach > kWide * options.sight) {
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
  // A box farther off than what is flown within its horizon binds nobody.
  obstacle_sight =
      std::all_of(obstacles.begin(), obstacles.end(), [](const Obstacle& one) { return one.body.box; })
          ? std::min(options.sight, options.box_horizon * speed + reach)
          : options.sight;
  obstacle_cells = Cells(places, std::max(obstacle_sight, covered) + widest_obstacle);
  const std::size_t count = agents.size();
  heading.assign(count, 0);
  flown.resize(count);
  stops.resize(count);
  plans.resize(count);
  accelerations.assign(count, Vector3d::Zero());
  turns.assign(count, Vector3d::Zero());
  known.resize(count);
  near_agents.assign(count, 0);
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
    look_at(i, rooms[0]);
    if (!apart_from_stops(stop_of(i), rooms[0]))
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
    near_by[i] = bodies[i][0].reach + fast * options.step + 0.5 * fast * fast / agent.most + kPadding;
    farthest = std::max(farthest, near_by[i]);
  }
  cells = Cells(places, std::max(options.sight, 2 * farthest));
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
    if (turns[i].squaredNorm() > 0) {
      way.turn = turns[i];
      agent.body = turned(agent.body, turns[i]);
      bodies[i][0] = bodies[i][1];
      roomy[i] = with_room(agent.body);
    }
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
  const double to_fly = to_go(i), flown_by = left[i] - to_fly;
  left[i] = to_fly;
  const double t = now();
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
  s.ask_own_laws();
  on_threads(count, s.options.threads, [&](std::size_t i, std::size_t k) { s.decide(i, s.rooms[k]); });
  if (!s.orca())
    on_threads(count, s.options.threads, [&](std::size_t i, std::size_t) { s.flies[i] = s.agreed(i); });
  ++s.steps;
  for (std::size_t i = 0; i < count; ++i) {
    s.counts.fallbacks += !s.orca() && !s.flies[i] && s.agents[i].velocity.norm() > 0;
    s.move(i);
    if (const Vector3d& at = s.agents[i].position; !(at.lpNorm<Eigen::Infinity>() <= kFarthest))
      throw InputError("agents[" + std::to_string(i) + "].position", to_text(at.lpNorm<Eigen::Infinity>()),
                       "within 1e5 m throughout");
    s.watch(i);
  }
  s.counts.commands += count;
  for (State::Scratch& one : s.rooms) s.counts.unsafe += std::exchange(one.unsafe, 0);
}

double Swarm::time() const { return state_->now(); }
const std::vector<Agent>& Swarm::agents() const { return state_->agents; }
const std::vector<Obstacle>& Swarm::obstacles() const { return state_->obstacles; }
const std::vector<Flown>& Swarm::flown() const { return state_->flown; }
const SwarmCounts& Swarm::counts() const { return state_->counts; }
const SwarmOptions& Swarm::options() const { return state_->options; }
const std::vector<std::size_t>& Swarm::heading() const { return state_->heading; }

}  // namespace vericone::swarm
