// SPDX-License-Identifier: BSD-3-Clause
#include "picture/surface_json.h"

#include <cstdio>
#include <cstdlib>

#include "json/json_value.h"

namespace vericone {
namespace {

/// As many digits as a picture shows.
double rounded(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return std::strtod(text, nullptr);
}

}  // namespace

Json surface_json(const glb::Drawn& drawn) {
  Json points = Json::array(), triangles = Json::array();
  for (const Eigen::Vector3d& x : drawn.points)
    for (const double entry : x) points.push_back(rounded(entry));
  for (const auto& triangle : drawn.triangles)
    for (const std::uint32_t i : triangle) triangles.push_back(i);
  return {{"points", std::move(points)}, {"triangles", std::move(triangles)}};
}

}  // namespace vericone
