// SPDX-License-Identifier: BSD-3-Clause
//
// What plain code knows of a body without the library: balls that cover the
// body, points that are in it, and whether a ray surely hits it. With these a sweep says "they meet" or "they
// miss" wherever that is clear, for the answers of Pair to be held against.
#pragma once

#include <vericone/geometry/body.h>
#include <Eigen/Geometry>
#include <functional>
#include <vector>

namespace vericone::testing {

/// In the body's own frame.
struct SampledBody {
  struct Ball {
    Eigen::Vector3d center;
    double radius;
  };
  Body body;
  std::vector<Ball> cover;              // their union contains the body
  std::vector<Eigen::Vector3d> inside;  // points of the body
  /// Whether the ray x + t d, t >= 0, goes through the body, by more than rounding; false says nothing.
  std::function<bool(const Eigen::Vector3d& x, const Eigen::Vector3d& d)> hit;
};

/// About 1 m large.
SampledBody sampled(const Body& body);

/// The same, standing somewhere.
struct SampledPlaced {
  Placed placed;
  std::vector<SampledBody::Ball> cover;
  std::vector<Eigen::Vector3d> inside;
  std::function<bool(const Eigen::Vector3d& x, const Eigen::Vector3d& d)> hit;
};
SampledPlaced stand(const SampledBody& body, const Pose& pose);

enum class Swept { meet, miss, unclear };
/// What the sweep of two bodies along w = v_a - v_b says: `meet` where a point of one surely goes through the
/// other, `miss` where no two balls of the covers meet on the way.
Swept sweep(const SampledPlaced& a, const SampledPlaced& b, const Eigen::Vector3d& w);

}  // namespace vericone::testing
