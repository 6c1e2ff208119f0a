// SPDX-License-Identifier: BSD-3-Clause
//
// What a run is made of. Read from YAML by the command (docs/reference/scenarios.md).
#pragma once

#include <vericone/simulation/curve.h>
#include <vericone/simulation/pilot.h>
#include <vericone/simulation/proof.h>
#include <vericone/simulation/track.h>
#include <vericone/simulation/vehicle.h>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vericone::simulation {

struct Body {
  std::string name;
  ShapeInTime shape;
  Motion start;  // at `appears`
  Orientation orientation = Orientation::heading;
  double appears = 0;  // s
  std::optional<Pilot> pilot;
  /// What moves it in place of a point mass under its pilot's acceleration; its orientation is the vehicle's.
  std::shared_ptr<const VehicleModel> vehicle;
  /// What a body without pilot and vehicle follows, to 1e-6 m and rad, in place of its velocity; its time
  /// begins when the body appears. `start` is start_of it.
  std::shared_ptr<const Road> road;
};

struct Scenario {
  std::string name;
  double duration = 10;           // s, at most
  double step = 0.01;             // s, between two commands, which are held in between
  bool multiples = false;         // commands at multiples of the step as they round, not at decimals
  bool stop_when_passed = false;  // ends when every agent has passed all that it minds, and none is to come
  int planes_logged = 0;          // y and psi are logged on this many planes (Fig 6.9)
  std::vector<Body> bodies;
  Current water;  // that vehicles swim in
  std::vector<MovingOrifice> orifices;
  ProofOptions proof;
  std::uint64_t seed = 1;  // of all noise
};

/// The time of the k-th command, seconds. Of steps such as 0.01 s, a whole number of which is a second, the
/// double nearest to the decimal: 1.63 and not 1.6300000000000001; unless `multiples`.
[[nodiscard]] double time_of_step(const Scenario& scenario, std::uint64_t k);

/// Throws InputError with the field's path: "bodies[2].shape.k", "bodies[0].pilot.minds[1]", ...
void check(const Scenario& scenario);

}  // namespace vericone::simulation
