// SPDX-License-Identifier: BSD-3-Clause
//
// The registry of figures: how each is made.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "json/json_value.h"

namespace vericone::dhal2022 {

struct Figure {
  std::string id;       // of the source, "5.6"; of ours "laws-6.5"
  std::string caption;  // in our words
  std::string script;   // of papers/dhal2022/figures; empty: Fig 6.5, from `vericone accuracy`
  std::vector<std::pair<std::string, std::string>> runs;  // role and scenario
  Json parameters;                                        // what the script is told beyond the runs

  std::string name() const { return "fig-" + id; }  // of its files, without extension
};

const std::vector<Figure>& all_figures();

/// In the registry's order; all where `ids` is empty. Throws InputError naming "figures".
std::vector<Figure> choose_figures(const std::vector<std::string>& ids);

}  // namespace vericone::dhal2022
