// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/lidar/lidar.h>
#include <algorithm>
#include <cmath>
#include <random>

#include "scan/study_parts.h"

namespace vericone::scanning {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr std::size_t kMostPoints = 20'000;  // of a scan for the alignment; more are thinned

Isometry3d disturbed(const Isometry3d& pose, const Setup& setup, std::mt19937_64& engine) {
  std::normal_distribution<double> normal;
  const auto vector = [&](double deviation) {
    Vector3d v;
    for (double& x : v) x = deviation * normal(engine);
    return v;
  };
  const Vector3d shift = vector(setup.position_error), turn = vector(setup.rotation_error);
  Isometry3d off = pose;
  off.translation() += shift;
  if (turn.norm() > 0)
    off.linear() = pose.linear() * Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  return off;
}

}  // namespace

void fuse_scans(const Setup& setup, Seen& seen) {
  std::mt19937_64 engine(setup.seed);
  std::vector<std::vector<Vector3d>> scans;
  std::vector<Isometry3d> truth, initial;
  double farthest = 0;
  std::size_t most = 0;
  for (const lidar::Scan& scan : seen.scans) {
    // A lidar that sees nothing, or next to it, adds nothing.
    if (scan.returns.size() < 20) continue;
    scans.push_back(scan.sensor_points());
    truth.push_back(scan.pose);
    initial.push_back(truth.size() == 1 ? scan.pose : disturbed(scan.pose, setup, engine));
    for (const Vector3d& p : scans.back()) farthest = std::max(farthest, p.norm());
    most = std::max(most, scans.back().size());
  }
  seen.points.clear();
  if (scans.empty()) return;
  // Three standard deviations of both bodies' errors; at last what the beams' spacing leaves between points.
  const double off = 3 * std::sqrt(3.0) * (setup.position_error + farthest * setup.rotation_error),
               spacing = 2 * seen.half_thickness;
  lidar::FuseOptions options;
  options.last_distance = 2 * spacing;
  options.max_distance = std::max(off + spacing, options.last_distance);
  if (most > kMostPoints) options.voxel = spacing * std::sqrt(double(most) / kMostPoints);
  options.last_distance = std::max(options.last_distance, 2 * options.voxel);
  options.max_distance = std::max(options.max_distance, options.last_distance);
  // Correspondences of sparse scans keep changing: a small part of the distance between points is at rest.
  options.tolerance = std::max(1e-6 * farthest, 5e-3 * spacing);
  lidar::Fusion fusion = lidar::fuse(scans, initial, options);
  seen.not_fused = fusion.reason;
  if (!fusion.converged) return;
  seen.points = std::move(fusion.cloud);
  for (std::size_t i = 0; i < scans.size(); ++i)
    for (const Vector3d& p : scans[i])
      seen.fusion_error = std::max(seen.fusion_error, (fusion.poses[i] * p - truth[i] * p).norm());
}

}  // namespace vericone::scanning
