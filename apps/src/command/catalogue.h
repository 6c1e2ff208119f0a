// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

namespace vericone {

/// A command as `vericone --help` lists it and as its own help ends.
struct CatalogueEntry {
  std::string group, name, what;
  std::array<std::string, 2> examples;  // words after "vericone"
  std::string failed, bad, stopped;     // exit statuses 1, 2 and 130, what they mean beyond the usual
  std::string lacks, needs;             // what a vericone without it is, and what it takes
};

/// The commands of the family, in the order of the help: by what they are for.
const std::vector<CatalogueEntry>& catalogue();

/// The entry with this name, or null.
const CatalogueEntry* find_entry(const std::string& name);

/// What a command's help ends with: examples and exit statuses.
std::string help_end(const CatalogueEntry& entry);

}  // namespace vericone
