// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace vericone {

/// A command as `vericone --help` lists it.
struct CatalogueEntry {
  std::string name, what;
  std::string lacks, needs;  // what a vericone without it is, and what it takes
};

/// The commands of the family, in the order of the help.
const std::vector<CatalogueEntry>& catalogue();

/// The entry with this name, or null.
const CatalogueEntry* find_entry(const std::string& name);

}  // namespace vericone
