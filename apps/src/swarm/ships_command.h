// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "output/output_options.h"

namespace vericone::ships {

/// `vericone swarm` of ships: those options of a swarm that ships have.
struct ShipsCommand : OutputOptions {
  std::string start;
  std::uint64_t agents = 0;
  std::string method;
  double lost = 0;
  std::optional<double> step, duration, sample;  // s
  std::vector<double> current;                   // m/s, to the east and to the north
};

[[nodiscard]] bool is_of_ships(const std::string& start);

/// Sails the ships and writes what became of them. Returns the exit status: 1 where a domain is not proved to
/// have been kept, 130 interrupted. Throws InputError.
int run_ships(const ShipsCommand& command, std::ostream& out);

}  // namespace vericone::ships
