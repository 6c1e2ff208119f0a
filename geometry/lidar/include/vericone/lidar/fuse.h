// SPDX-License-Identifier: BSD-3-Clause
//
// Fusion of several scans by the iterative closest point algorithm (source, 6.3.3).
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <string>
#include <vector>

namespace vericone::lidar {

struct FuseOptions {
  /// Points farther apart than this never correspond, metres: above the error of the initial poses at the
  /// points. It is halved from stage to stage down to the last one below.
  double max_distance = 0.5;
  double last_distance = 0.05;  // m
  /// Points are thinned to one a voxel of this size for the alignment, metres; 0: all are used.
  double voxel = 0;
  /// A stage ends when no point of any scan moves by more than this, metres; how many sweeps it may take.
  double tolerance = 1e-7;
  int max_sweeps = 100;
  /// The least part of each scan's points that must have a counterpart.
  double least_overlap = 0.3;
  /// The least of `ScanFit::weakest`, dimensionless.
  double least_weakest = 1e-4;
};

struct ScanFit {
  double overlap = 0;  // part of the scan's points with a counterpart within last_distance
  double rms = 0;      // m, of the distances to the counterparts' tangent planes
  /// How well the overlap fixes the pose: the mean squared change of those distances for the unit motion that
  /// changes them least (lengths in units of the overlap's radius); 0 for scans of a plane or a ball, which
  /// can slide.
  double weakest = 0;
};

struct Fusion {
  bool converged = false;
  std::string reason;  // one line, empty where converged
  /// From each sensor's frame to that of the first initial pose, which is kept; empty unless converged.
  std::vector<Eigen::Isometry3d> poses;
  std::vector<Eigen::Vector3d> cloud;  // m, all points in that frame; empty unless converged
  std::vector<ScanFit> fits;           // of each scan against all others, also where not converged
  int sweeps = 0;
};

/// `scans`: points in their sensors' frames; `initial`: poses known up to an error. Each scan in turn is
/// aligned to the union of the others, point to plane (Open3D's ICP), until none moves. Where it did not
/// converge, where scans overlap too little or slide on each other there is no answer, and `reason` says so.
/// That it converged to the right place is not proved: ICP finds the nearest minimum; `fits` tells how good
/// it is. Does not depend on the number of threads. Throws InputError naming "scans", "scans[i]", "initial"
/// or an option.
[[nodiscard]] Fusion fuse(std::span<const std::vector<Eigen::Vector3d>> scans,
                          std::span<const Eigen::Isometry3d> initial, const FuseOptions& options = {});

}  // namespace vericone::lidar
