// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "input/body.h"

namespace vericone::input {

/// Throws InputError with `path` before the field.
CombinedEllipsoid read_spatial_body(const Json& value, const std::string& path);

/// The rotation nearest to the field `rotation` of a body, the identity without that field. Throws InputError
/// with `path` before the field where none is near.
Eigen::Matrix3d read_rotation(const Json& body, const std::string& path);

}  // namespace vericone::input
