// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>

namespace vericone::fit {

/// The table of `vericone fit` from its JSON. `scan`: what was fitted, in words.
void print_fit(const nlohmann::ordered_json& fit, const std::string& scan, std::ostream& out);

}  // namespace vericone::fit
