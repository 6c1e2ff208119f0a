// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "input/body.h"
#include "input/field_table.h"

namespace vericone::input {

/// Throws InputError with `path` before the field.
CombinedEllipsoid read_spatial_body(const Json& value, const std::string& path);

/// The rotation nearest to what is given; refused where none is near.
Value<Eigen::Matrix3d> rotation();
/// That of the field `rotation` of a body, the identity without that field.
Eigen::Matrix3d read_rotation(const Json& body, const std::string& path);

/// What the JSON schema of bodies says of ellipsoids, and their delimiters.
Json spatial_schema();
Json hyperboloid_schema();

}  // namespace vericone::input
