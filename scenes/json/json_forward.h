// SPDX-License-Identifier: BSD-3-Clause
//
// The name of a JSON value, for headers that only mention it.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace vericone {

/// Its fields keep the order in which they were written.
using Json = nlohmann::ordered_json;

}  // namespace vericone
