// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "command/default_seed.h"
#include "output/output_options.h"

namespace vericone::swarm {

/// What `vericone swarm` is told.
struct SwarmCommand : OutputOptions {
  SwarmCommand() { out = "out/swarm"; }
  std::string start, method = "proved";
  std::uint64_t agents = 0, seed = kDefaultSeed;
  std::optional<double> step, duration, sample;  // s
  double lost = 0;
  std::vector<double> current;  // of ships, m/s, to the east and to the north
};

}  // namespace vericone::swarm

namespace vericone::ships {

using swarm::SwarmCommand;

[[nodiscard]] bool is_of_ships(const std::string& start);

/// Sails the ships and writes what became of them. Returns the exit status: 1 where a domain is not proved to
/// have been kept, 130 interrupted. Throws InputError.
int run_ships(const SwarmCommand& command, std::ostream& out);

}  // namespace vericone::ships
