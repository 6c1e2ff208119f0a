// SPDX-License-Identifier: BSD-3-Clause
//
// What the study and the picture of one plane share.
#pragma once

#include <vericone/cones/assembly/assembly_oracle.h>
#include <vericone/lidar/scan.h>
#include <string>
#include <vector>

#include "scan/study.h"

namespace vericone::scanning {

/// All lidars' scans together.
struct Seen {
  std::vector<lidar::Scan> scans;
  std::vector<Eigen::Vector3d> points;  // in the world
  double half_thickness = 0;            // m, of the slabs that stand for planes
  std::string not_fused;                // then there are no points
  double fusion_error = 0;              // m
};
Seen look(const Setup& setup, const lidar::MeshScene& scene, const std::vector<lidar::Lidar>& lidars);

/// Replaces seen.points by the cloud of the scans fused from poses that are off as `setup` says.
void fuse_scans(const Setup& setup, Seen& seen);

/// With `factor` times as many steps between elevations and between azimuths; the old beams among the new.
std::vector<lidar::Lidar> finer(const std::vector<lidar::Lidar>& lidars, int factor);

/// Throws InputError naming "lidars" where there are none.
Eigen::Vector3d center_of(const std::vector<Eigen::Vector3d>& points);

/// Throws InputError naming "agent" unless the bodies are disjoint.
AssemblyOracle oracle_of(const Setup& setup, Assembly obstacle);

}  // namespace vericone::scanning
