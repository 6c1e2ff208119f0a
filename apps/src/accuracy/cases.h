// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <string>
#include <vector>

namespace vericone::accuracy {

/// A pair whose cones are measured. Its id is a cell of a table.
struct Case {
  std::string id;
  Ellipsoid agent, obstacle;
};

/// Reads a file of cases as `vericone query` does (docs/reference/formats.md): one JSON object a line, two
/// ellipsoids that a plane across their line of centres separates, velocities left out or ignored. A case
/// without an id is called by its line. Throws InputError naming the file, the line and the field.
std::vector<Case> read_cases(const std::string& path);

}  // namespace vericone::accuracy
