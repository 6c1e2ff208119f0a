// SPDX-License-Identifier: BSD-3-Clause
//
// What a navigator thinks in: courses, and what will happen on them.
#pragma once

#include <vericone/guidance/navigator.h>
#include <algorithm>
#include <limits>

namespace vericone::guidance {

inline constexpr double kFar = std::numeric_limits<double>::infinity();
inline constexpr double kAligned = 1e-6;  // rad

struct Navigator::Moment {
  Eigen::Vector3d position, velocity, ahead;
  double speed, step;
  Ellipsoid body;
  double reach;  // of the agent about its position
  bool planar, carried;
};

/// A turn about a circle by `angle`, then straight on.
struct Navigator::Course {
  Eigen::Vector3d direction,
      aside;  // unit vectors: at the end; towards the centre of the circle, at the start
  double angle = 0, radius = 0;
  double until = kFar;  // s from now, when it ends
};

struct Navigator::Foreseen {
  bool safe = true;
  double least = kFar;    // metres
  double lacking = kFar;  // least of (metres kept - metres required)
  std::size_t nearest = 0;
  void see(double distance, double required, std::size_t body) {
    if (distance < least) {
      least = distance;
      nearest = body;
    }
    lacking = std::min(lacking, distance - required);
  }
};

/// A course as the agent flies it.
struct Navigator::Flight {
  const Moment& now;
  const Course& course;
  double turning;  // s, how long it turns
  double rate;     // rad/s, meanwhile
  Eigen::Vector3d axis;

  Flight(const Moment& at, const Course& on);
  /// How far the agent has come while it turns.
  Eigen::Vector3d moved(double t) const;
  /// Its body while it turns.
  Ellipsoid body_at(double t) const;
  Eigen::Vector3d straight() const { return now.speed * course.direction; }  // m/s, after the turn
};

}  // namespace vericone::guidance
