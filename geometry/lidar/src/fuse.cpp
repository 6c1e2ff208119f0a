// SPDX-License-Identifier: BSD-3-Clause
#include <omp.h>
#include <open3d/geometry/KDTreeSearchParam.h>
#include <open3d/geometry/PointCloud.h>
#include <open3d/pipelines/registration/Registration.h>
#include <open3d/utility/Logging.h>
#include <vericone/geometry/error.h>
#include <vericone/lidar/lidar.h>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "float_environment.h"
#include "rigid.h"

namespace vericone::lidar {
namespace {

namespace registration = open3d::pipelines::registration;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using open3d::geometry::PointCloud;

constexpr int kNeighbours = 20;        // for a normal
constexpr int kIterationsASweep = 10;  // of Open3D, before the other scans have their turn
constexpr std::size_t kLeastPoints = 6;

/// One thread in Open3D, whose sums depend on how many there are, and nothing on the standard output.
class Quiet {
 public:
  Quiet() : levels_(omp_get_max_active_levels()), verbosity_(open3d::utility::VerbosityLevel::Error) {
    omp_set_max_active_levels(0);
    verbosity_.Enter();
  }
  ~Quiet() {
    verbosity_.Exit();
    omp_set_max_active_levels(levels_);
  }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  int levels_;
  open3d::utility::VerbosityContextManager verbosity_;
  FloatEnvironment environment_;
};

void check(std::span<const std::vector<Vector3d>> scans, std::span<const Isometry3d> initial,
           const FuseOptions& options) {
  if (scans.empty()) throw InputError("scans", "none", "one at least");
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const std::string name = "scans[" + std::to_string(i) + "]";
    if (scans[i].size() < kLeastPoints)
      throw InputError(name, std::to_string(scans[i].size()) + " points",
                       std::to_string(kLeastPoints) + " points or more");
    for (const Vector3d& p : scans[i])
      if (!p.allFinite()) throw InputError(name, "a point that is not finite", "finite");
  }
  if (initial.size() != scans.size())
    throw InputError("initial", std::to_string(initial.size()) + " poses", "one for each scan");
  for (const Isometry3d& pose : initial)
    if (!is_rigid(pose)) throw InputError("initial", "another matrix", "rotations and finite translations");
  const auto positive = [](const char* field, double value) {
    if (!(value > 0 && std::isfinite(value)))
      throw InputError(field, to_text(value), "a positive finite number (metres)");
  };
  positive("last_distance", options.last_distance);
  positive("tolerance", options.tolerance);
  if (!(options.max_distance >= options.last_distance && std::isfinite(options.max_distance)))
    throw InputError("max_distance", to_text(options.max_distance), "finite and not below last_distance");
  if (!(options.voxel >= 0 && std::isfinite(options.voxel)))
    throw InputError("voxel", to_text(options.voxel), "a finite number from 0 up (metres)");
  if (options.max_sweeps < 1)
    throw InputError("max_sweeps", std::to_string(options.max_sweeps), "a positive whole number");
}

/// The scans in their common frame, as they are moved.
class Alignment {
 public:
  Alignment(std::span<const std::vector<Vector3d>> scans, std::span<const Isometry3d> initial,
            const FuseOptions& options)
      : poses_(initial.begin(), initial.end()) {
    for (std::size_t i = 0; i < scans.size(); ++i) {
      checkpoint();
      auto cloud = std::make_shared<PointCloud>(scans[i]);
      if (options.voxel > 0) cloud = cloud->VoxelDownSample(options.voxel);
      cloud->EstimateNormals(open3d::geometry::KDTreeSearchParamKNN(kNeighbours));
      clouds_.push_back(cloud->Transform(poses_[i].matrix()));
    }
  }

  const std::vector<Isometry3d>& poses() const { return poses_; }

  /// Aligns every scan but the first once; the farthest that a point moved.
  double sweep(double distance) {
    double farthest = 0;
    for (std::size_t i = 1; i < clouds_.size(); ++i) {
      checkpoint();
      const registration::RegistrationResult result = registration::RegistrationICP(
          clouds_[i], others(i), distance, Eigen::Matrix4d::Identity(),
          registration::TransformationEstimationPointToPlane(),
          registration::ICPConvergenceCriteria(1e-12, 1e-12, kIterationsASweep));
      Isometry3d motion(Eigen::Matrix4d(result.transformation_));
      // Open3D multiplies many small rotations: back to an orthonormal matrix.
      motion.linear() = Eigen::Quaterniond(Eigen::Matrix3d(motion.linear())).normalized().toRotationMatrix();
      for (const Vector3d& p : clouds_[i].points_) farthest = std::max(farthest, (motion * p - p).norm());
      clouds_[i].Transform(motion.matrix());
      poses_[i] = motion * poses_[i];
    }
    return farthest;
  }

  ScanFit fit(std::size_t i, double distance) const {
    ScanFit fit;
    const PointCloud target = others(i);
    const registration::RegistrationResult result =
        registration::EvaluateRegistration(clouds_[i], target, distance);
    const auto& pairs = result.correspondence_set_;
    fit.overlap = double(pairs.size()) / double(clouds_[i].points_.size());
    if (pairs.empty()) return fit;
    Vector3d center = Vector3d::Zero();
    for (const auto& pair : pairs) center += target.points_[pair(1)] / double(pairs.size());
    double square = 0, radius = 0;
    for (const auto& pair : pairs) {
      const Vector3d &p = clouds_[i].points_[pair(0)], &q = target.points_[pair(1)];
      square += std::pow(target.normals_[pair(1)].dot(p - q), 2);
      radius += (q - center).squaredNorm();
    }
    fit.rms = std::sqrt(square / double(pairs.size()));
    radius = std::sqrt(radius / double(pairs.size()));
    if (!(radius > 0)) return fit;
    Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
    for (const auto& pair : pairs) {
      Eigen::Matrix<double, 6, 1> row;
      row << ((target.points_[pair(1)] - center) / radius).cross(target.normals_[pair(1)]),
          target.normals_[pair(1)];
      information += row * row.transpose() / double(pairs.size());
    }
    fit.weakest = std::max(0.0, Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(information).eigenvalues()(0));
    return fit;
  }

 private:
  PointCloud others(std::size_t i) const {
    PointCloud all;
    for (std::size_t j = 0; j < clouds_.size(); ++j)
      if (j != i) all += clouds_[j];
    return all;
  }

  std::vector<PointCloud> clouds_;
  std::vector<Isometry3d> poses_;
};

/// Why the scans as they are now cannot be aligned; empty where they can.
std::string fault(const Alignment& alignment, double distance, const FuseOptions& options,
                  std::vector<ScanFit>& fits) {
  std::string reason;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    fits[i] = alignment.fit(i, distance);
    if (!reason.empty()) continue;
    const std::string scan = "scan " + std::to_string(i);
    if (!(fits[i].overlap >= options.least_overlap))
      reason = scan + " overlaps the others in " + to_text(fits[i].overlap) + " of its points only";
    else if (!(fits[i].weakest >= options.least_weakest))
      reason = scan + " can slide on the others: what they have in common does not fix its pose (" +
               to_text(fits[i].weakest) + ")";
  }
  return reason;
}

}  // namespace

Fusion fuse(std::span<const std::vector<Vector3d>> scans, std::span<const Isometry3d> initial,
            const FuseOptions& options) {
  check(scans, initial, options);
  Fusion fusion;
  std::vector<Isometry3d> poses(initial.begin(), initial.end());
  fusion.fits.resize(scans.size());
  fusion.converged = true;
  if (scans.size() > 1) {
    const Quiet quiet;
    Alignment alignment(scans, initial, options);
    for (double distance = options.max_distance;; distance = std::max(options.last_distance, distance / 2)) {
      fusion.reason = fault(alignment, distance, options, fusion.fits);
      if (!fusion.reason.empty()) break;
      const bool last = distance <= options.last_distance;
      double moved = 0;
      int sweeps = 0;
      do {
        moved = alignment.sweep(distance);
        ++sweeps;
        // The stages before the last need only come near.
      } while (moved > (last ? options.tolerance : 0.05 * distance) && sweeps < options.max_sweeps);
      fusion.sweeps += sweeps;
      if (!last) continue;
      fusion.reason = fault(alignment, distance, options, fusion.fits);
      if (fusion.reason.empty() && moved > options.tolerance)
        fusion.reason =
            "points still moved by " + to_text(moved) + " m after " + std::to_string(sweeps) + " sweeps";
      break;
    }
    fusion.converged = fusion.reason.empty();
    poses = alignment.poses();
  }
  if (!fusion.converged) return fusion;
  for (std::size_t i = 0; i < scans.size(); ++i)
    for (const Vector3d& p : scans[i]) fusion.cloud.push_back(poses[i] * p);
  fusion.poses = std::move(poses);
  return fusion;
}

}  // namespace vericone::lidar
