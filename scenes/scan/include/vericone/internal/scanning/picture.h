// SPDX-License-Identifier: BSD-3-Clause
//
// A study's picture of a section, and its words.
#pragma once

#include <vericone/scanning/study.h>
#include <string>
#include <vector>

namespace vericone::scanning {

/// Fig 6.7 of the source for these bodies: the section by the plane through `Study::axis` at an azimuth.
struct PlaneSectionPicture {
  struct Line {
    Eigen::Vector2d on_agent, on_obstacle;
  };
  std::vector<Eigen::Vector2d> agent;                  // outline of its section
  std::vector<std::vector<Eigen::Vector2d>> obstacle;  // section of the whole mesh, polylines
  std::vector<Eigen::Vector2d> sensors;                // the lidars, projected onto the plane
  std::vector<Eigen::Vector2d> returns;                // points near the plane, projected onto it
  std::vector<Line> tangents;                          // left, right; empty where the search finds none
  std::string reason;                                  // why there are none
  double psi = 0, theta_b = 0;                         // of the tangents; radians from the axis
  double whole_left = 0, whole_right = 0;  // true cone of the whole obstacle: radians from the axis
  double half_thickness = 0;               // m, of the slab of points
  int tried = 0;
};

/// `azimuth`: radians. Throws as study().
[[nodiscard]] PlaneSectionPicture plane_section_picture(const Setup& setup, double azimuth);

/// scan.json. `v_agent`, `v_obstacle`: the bodies' velocities in the world, m/s, for the y of each sector.
[[nodiscard]] std::string scan_text(const Setup& setup, const Findings& found, const Eigen::Vector3d& v_agent,
                                    const Eigen::Vector3d& v_obstacle);

}  // namespace vericone::scanning
