// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/swarm/swarm.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "block_proof.h"

namespace vericone::swarm {

using Eigen::Vector3d;

namespace {

constexpr int kBlock = 32;  // steps

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<Vector3d> positions_of(const Swarm& swarm) {
  std::vector<Vector3d> all;
  for (const Agent& agent : swarm.agents()) all.push_back(agent.position);
  return all;
}

void check(const FlightOptions& options) {
  for (const auto& [name, value] : {std::pair("duration", options.duration), {"sample", options.sample}})
    if (!(value > 0) || !std::isfinite(value))
      throw InputError(name, to_text(value), "a positive finite number (seconds)");
}

/// From where an agent is along its goals to where it may arrive.
double straight_of(const Agent& agent) {
  double length = -agent.body.reach();
  Vector3d at = agent.position;
  for (const Vector3d& goal : agent.goals) {
    length += (goal - at).norm();
    at = goal;
  }
  return std::max(0.0, length);
}

/// Adds what the last step was, and says how many have arrived.
std::size_t follow(const Swarm& swarm, SwarmFlight& flight) {
  std::size_t there = 0;
  for (std::size_t i = 0; i < swarm.agents().size(); ++i) {
    if (std::isfinite(flight.arrived[i])) {
      ++there;
      continue;
    }
    const Flown& way = swarm.flown()[i];
    const double half = 0.5 * way.seconds;
    const Vector3d between = way.position + half * (way.velocity + 0.5 * half * way.acceleration);
    flight.path[i] += (between - way.position).norm() + (swarm.agents()[i].position - between).norm();
    if (swarm.heading()[i] < swarm.agents()[i].goals.size()) continue;
    flight.arrived[i] = swarm.time();
    ++there;
  }
  return there;
}

}  // namespace

SwarmFlight fly(Swarm& swarm, const FlightOptions& options) {
  check(options);
  if (!(options.duration >= swarm.options().step))
    throw InputError("duration", to_text(options.duration), "at least a step (seconds)");
  const std::size_t count = swarm.agents().size();
  SwarmFlight flight;
  flight.arrived.assign(count, std::numeric_limits<double>::infinity());
  flight.path.assign(count, 0);
  for (const Agent& agent : swarm.agents()) flight.straight.push_back(straight_of(agent));
  const double step = swarm.options().step, begin = swarm.time();
  BlockProof proof(swarm.agents(), swarm.obstacles(), swarm.options().threads, begin);
  flight.samples.push_back({begin, positions_of(swarm)});
  std::size_t there = 0;
  int in_block = 0;
  const auto prove = [&] {
    const auto start = std::chrono::steady_clock::now();
    if (options.prove && in_block > 0) proof.prove(swarm.time());
    in_block = 0;
    flight.proving += seconds_since(start);
  };
  while (there < count && swarm.time() - begin + step <= options.duration * (1 + 1e-9)) {
    const double t = swarm.time();
    const auto start = std::chrono::steady_clock::now();
    swarm.step();
    flight.stepping += seconds_since(start);
    if (options.prove) proof.add(swarm.flown(), t, step);
    there = follow(swarm, flight);
    if (swarm.time() >= begin + static_cast<double>(flight.samples.size()) * options.sample - 1e-9)
      flight.samples.push_back({swarm.time(), positions_of(swarm)});
    if (++in_block == kBlock) prove();
    const double share =
        std::max(static_cast<double>(there) / static_cast<double>(std::max<std::size_t>(count, 1)),
                 (swarm.time() - begin) / options.duration);
    if (options.progress && !options.progress(share)) {
      flight.interrupted = true;
      break;
    }
  }
  prove();
  flight.end = swarm.time();
  flight.counts = swarm.counts();
  flight.touched = proof.touched();
  flight.undecided = proof.undecided();
  flight.least_distance = proof.least_distance();
  return flight;
}

}  // namespace vericone::swarm
