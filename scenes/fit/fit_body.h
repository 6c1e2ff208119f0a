// SPDX-License-Identifier: BSD-3-Clause
//
// Pieces of a hull as bodies that scenes read (docs/reference/formats.md).
#pragma once

#include <vericone/fitting/hull.h>
#include <string>
#include <vector>

#include "json/json_forward.h"

namespace vericone::fit {

/// The body fields of one piece: center, semi_axes, rotation and hyperboloids; of a footprint those of a body
/// in the plane. All lengths about the centre times `factor`.
Json body_fields(const fitting::Piece& piece, double factor = 1);

/// The same for all pieces, moved outwards by the least factor of 1 + 2^-50, 1 + 2^-48, ... with which the
/// bodies that scenes read from the fields contain, in exact arithmetic, every point that `inside` names.
/// As they are where it names none. Throws std::runtime_error where no factor up to 1 + 2^-20 does.
std::vector<Json> enclosing_body_fields(const std::vector<fitting::Piece>& pieces,
                                        const std::vector<Eigen::Vector3d>& inside);

/// The points of a sample that are in one of the pieces, as their quadrics say, in exact arithmetic; of a
/// mesh among those that its triangles use.
std::vector<Eigen::Vector3d> points_inside(const std::vector<fitting::Piece>& pieces,
                                           const fitting::Sample& sample);

/// A scene file's obstacle, or for several pieces a list of bodies, each of which may be one.
std::string body_yaml(const std::vector<Json>& fields, const std::string& comment);

}  // namespace vericone::fit
