// SPDX-License-Identifier: BSD-3-Clause
#include "output/slice_json.h"

#include <vericone/cones/cone_geometry.h>
#include <cmath>
#include <numbers>

#include "json/json_value.h"

namespace vericone {

ConeFunction plane_function(const Slice& s, const Eigen::Vector3d& axis,
                            const Eigen::Vector3d& agent_velocity, const Eigen::Vector3d& obstacle_velocity) {
  const AxisFrame frame(axis);
  const Eigen::Vector3d across = frame.across(s.azimuth);
  const auto in_plane = [&](const Eigen::Vector3d& v) {
    return Eigen::Vector2d(v.dot(frame.axis), v.dot(across));
  };
  return cone_function(s.psi(), s.theta_b(), in_plane(agent_velocity), in_plane(obstacle_velocity));
}

Json sector_json(const Slice& s, const Eigen::Vector3d& axis, const Eigen::Vector3d& agent_velocity,
                 const Eigen::Vector3d& obstacle_velocity) {
  const ConeFunction y = plane_function(s, axis, agent_velocity, obstacle_velocity);
  return {{"azimuth", s.azimuth},
          {"psi", s.psi()},
          {"theta_b", s.theta_b()},
          // y cannot tell a sector of more than half a turn.
          {"y", s.psi() <= std::numbers::pi ? Json(y.y) : Json(nullptr)},
          {"v_r_hat", y.v_r_hat},
          {"v_theta_hat", y.v_theta_hat}};
}

Json polyhedral_json(const PolyhedralCone& cone) {
  Json directions = Json::array();
  for (const auto& d : cone.directions) directions.push_back(vector_json(d));
  return {{"directions", directions},
          {"solid_angle", number_or_null(cone.solid_angle)},
          {"cross_section_area", number_or_null(cone.cross_section_area)}};
}

}  // namespace vericone
