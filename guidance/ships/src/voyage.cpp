// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/ships/ships.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "fleet.h"

namespace vericone::ships {

using Eigen::Vector2d;

namespace {

ShipSample sample_of(const Fleet& fleet) {
  ShipSample sample{fleet.time(), {}, {}, {}};
  for (std::size_t i = 0; i < fleet.states().size(); ++i) {
    sample.positions.push_back(fleet.ground(i));
    sample.headings.push_back(fleet.states()[i].heading);
    sample.speeds.push_back(fleet.states()[i].speed);
  }
  return sample;
}

}  // namespace

bool Voyage::kept() const {
  return std::all_of(pairs.begin(), pairs.end(), [](const PairOfShips& pair) {
    return pair.verdict == simulation::ProofVerdict::avoided;
  });
}

Voyage sail(const std::vector<Ship>& ships, const FleetOptions& options, const VoyageOptions& voyage) {
  for (const auto& [name, value] : {std::pair("duration", voyage.duration), {"sample", voyage.sample}})
    if (!(value > 0) || !std::isfinite(value))
      throw InputError(name, to_text(value), "a positive finite number (seconds)");
  if (!(voyage.duration >= options.step))
    throw InputError("duration", to_text(voyage.duration), "at least a step (seconds)");
  if (ships.empty()) throw InputError("ships", "none", "one or more");
  Fleet fleet(ships, options);
  Voyage found;
  found.arrived.assign(ships.size(), std::numeric_limits<double>::infinity());
  found.path.assign(ships.size(), 0);
  found.samples.push_back(sample_of(fleet));
  std::size_t there = 0;
  while (there < ships.size() && fleet.time() + options.step <= voyage.duration * (1 + 1e-9)) {
    fleet.step();
    for (std::size_t i = 0; i < ships.size(); ++i) {
      if (std::isfinite(found.arrived[i])) continue;
      found.path[i] = length_of(fleet.pieces()[i]);
      if (fleet.past_goal(i) < 0) continue;
      found.arrived[i] = fleet.time();
      ++there;
    }
    if (fleet.time() >= static_cast<double>(found.samples.size()) * voyage.sample - 1e-9)
      found.samples.push_back(sample_of(fleet));
    if (voyage.progress && !voyage.progress(fleet.time() / voyage.duration)) {
      found.interrupted = true;
      break;
    }
  }
  found.end = fleet.time();
  found.counts = fleet.counts();
  std::vector<Sailed> tracks;
  for (std::size_t i = 0; i < ships.size(); ++i)
    tracks.push_back(sailed(ships[i], fleet.pieces()[i], options.current, 0, found.end));
  found.pairs = fleet.pairs();
  for (PairOfShips& pair : found.pairs) {
    const Sailed &a = tracks[pair.a], &b = tracks[pair.b];
    const double until = std::min({a.hull.end(), a.domain.end(), b.hull.end(), b.domain.end()});
    const DomainProof proof = prove_domains(a, b, 0, until);
    pair.verdict = proof.verdict;
    pair.least_domain_distance = proof.least_distance;
  }
  return found;
}

}  // namespace vericone::ships
