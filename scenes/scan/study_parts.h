// SPDX-License-Identifier: BSD-3-Clause
//
// What the study and the picture of one plane share.
#pragma once

#include <vericone/internal/cones/assembly/assembly_oracle.h>
#include <vericone/lidar/lidar.h>
#include <vericone/scanning/study.h>
#include <string>
#include <vector>

namespace vericone::scanning {

/// Replaces seen.points by the cloud of the scans fused from poses that are off as `setup` says.
void fuse_scans(const Setup& setup, Seen& seen);

/// With `factor` times as many steps between elevations and between azimuths; the old beams among the new.
std::vector<lidar::Lidar> finer(const std::vector<lidar::Lidar>& lidars, int factor);

/// Throws InputError naming "lidars" where there are none.
Eigen::Vector3d center_of(const std::vector<Eigen::Vector3d>& points);

/// Throws InputError naming "agent" unless the bodies are disjoint.
AssemblyOracle oracle_of(const Setup& setup, Assembly obstacle);

}  // namespace vericone::scanning
