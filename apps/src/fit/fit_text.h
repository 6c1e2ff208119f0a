// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <string>

#include "json/json_forward.h"

namespace vericone::fit {

/// The table of `vericone fit` from its JSON. `scan`: what was fitted, in words.
void print_fit(const Json& fit, const std::string& scan, std::ostream& out);

}  // namespace vericone::fit
