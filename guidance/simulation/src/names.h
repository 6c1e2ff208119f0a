// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace vericone::simulation {

inline bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Of the body or orifice that has the name; their number where none has.
template <typename Named>
std::size_t index_of(const std::vector<Named>& list, const std::string& name) {
  const auto has_name = [&](const Named& one) { return one.name == name; };
  return std::size_t(std::find_if(list.begin(), list.end(), has_name) - list.begin());
}

}  // namespace vericone::simulation
