// SPDX-License-Identifier: BSD-3-Clause
//
// Combined quadrics and what belongs to them as JSON for apps/figures.
#pragma once

#include <vericone/geometry/combined_surface.h>
#include <nlohmann/json.hpp>
#include <string>

namespace vericone {

nlohmann::ordered_json to_json(const Eigen::Vector2d& v);
nlohmann::ordered_json to_json(const Eigen::Vector3d& v);
/// By rows.
nlohmann::ordered_json to_json(const Eigen::Matrix2d& m);
nlohmann::ordered_json to_json(const Eigen::Matrix3d& m);

/// {"center", "factor", "delimiters": [{"matrix", "level"}]}
nlohmann::ordered_json body_json(const CombinedEllipse& body);
nlohmann::ordered_json body_json(const CombinedEllipsoid& body);

/// {"vertices", "triangles", "quadrics"}
nlohmann::ordered_json mesh_json(const CombinedSurface& surface);

/// A body in space, or the part of its surface on the ellipsoid ("ellipsoid") or on the delimiters
/// ("delimiters"): {"body", "part", "mesh"}
nlohmann::ordered_json solid_json(const CombinedEllipsoid& body, const CombinedSurface& whole,
                                  const std::string& part = "whole");

/// The planar body with its arcs and corners: body_json and {"arcs": [{"conic", "points"}], "corners"}
nlohmann::ordered_json outline_json(const CombinedEllipse& body);

}  // namespace vericone
