// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

#include <vericone/geometry/error.h>
#include <algorithm>
#include <vector>

#include "../point_merger.h"
#include "../source.h"

namespace vericone::files {

/// Where a part of a scene stands: x becomes linear x + shift.
struct Placement {
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator()(const Eigen::Vector3d& x) const { return linear * x + shift; }
  Placement operator*(const Placement& inner) const {
    return {linear * inner.linear, linear * inner.shift + shift};
  }
  bool mirrors() const { return linear.determinant() < 0; }
};

/// The parts of a scene as one mesh: points that are equal where they stand become one.
class PlacedMesh {
 public:
  /// `file`: its bytes. Parts that are placed again and again may make more of them, up to a limit.
  PlacedMesh(const Source& source, std::size_t file) : source_(source), most_(std::max(kSmall, file)) {}

  /// Refuses what would take more memory than a file may: points, corners, or parts without either.
  void count(std::size_t more) {
    if (more > most_ - counted_)
      source_.refuse("parts that are placed again and again, up to more than " + std::to_string(most_) +
                         " points and corners",
                     "at most as many as the file has bytes, or " + std::to_string(kSmall));
    counted_ += more;
  }

  /// Polygons of corners of `points`; one that is mirrored turns the other way round.
  void add(const std::vector<Eigen::Vector3d>& points, const std::vector<Face>& faces,
           const Placement& placement) {
    const bool mirrors = placement.mirrors();
    std::vector<std::uint32_t> index(points.size(), kNone);
    std::size_t added = 0;
    for (const Face& face : faces) {
      if (++added % 4096 == 0) checkpoint();
      Face placed(face.size());
      for (std::size_t k = 0; k < face.size(); ++k) {
        std::uint32_t& known = index[face[k]];
        if (known == kNone) known = merger_.index(placement(points[face[k]]));
        placed[mirrors ? face.size() - 1 - k : k] = known;
      }
      parsed_.faces.push_back(std::move(placed));
    }
  }
  void add_cloud(const std::vector<Eigen::Vector3d>& points, const Placement& placement) {
    for (const Eigen::Vector3d& x : points) cloud_.push_back(placement(x));
  }

  /// A cloud's points are all kept.
  Parsed take() {
    parsed_.points.insert(parsed_.points.end(), cloud_.begin(), cloud_.end());
    return std::move(parsed_);
  }

 private:
  static constexpr std::size_t kSmall = 3'000'000;
  static constexpr std::uint32_t kNone = 0xffffffff;

  const Source& source_;
  std::size_t most_, counted_ = 0;
  Parsed parsed_;
  std::vector<Eigen::Vector3d> cloud_;
  PointMerger merger_{parsed_.points};
};

}  // namespace vericone::files
