// SPDX-License-Identifier: BSD-3-Clause
//
// Pursuits from YAML; the fields are described in docs/reference/pursuits.md.
#pragma once

#include <vericone/vision/pursuit/pursuit.h>
#include <string>

namespace vericone::vision {

/// Reads a pursuit, and the pictures it names, relative to its folder. The camera of `eyes` must be there;
/// exact eyes look through the perspective one, or the source's where it is alone. Throws InputError naming
/// the file or the field, for example "cars[1].road.changes[0].at". A pursuit without name is called like the
/// file.
[[nodiscard]] Pursuit read_pursuit(const std::string& file, Eyes eyes = Eyes::perspective);

}  // namespace vericone::vision
