// SPDX-License-Identifier: BSD-3-Clause
//
// What the tests of cone maps share: classifiers whose truth is a formula, and directions within cells.
#pragma once

#include <gtest/gtest.h>
#include <vericone/cones/map/cone_map.h>
#include <vericone/testing/random_bodies.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>
#include "support/campaign.h"

namespace vericone::testing {

/// A set of directions told by a signed distance on the sphere in radians, negative where they collide, that
/// changes by no more than the angle between two directions.
template <typename Distance>
class DistanceClassifier : public DirectionClassifier {
 public:
  explicit DistanceClassifier(Distance distance) : distance_(std::move(distance)) {}
  Certified classify(const DirectionCell& cell, const Frontier&, Frontier&) const override {
    const Eigen::Vector3d middle = (cell[0] + cell[1] + cell[2]).normalized();
    double reach = 1e-12;
    for (const auto& d : cell) reach = std::max(reach, angle(middle, d));
    const double distance = distance_(middle);
    return distance < -reach ? Certified::in : distance > reach ? Certified::out : Certified::undecided;
  }
  static double angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
  }

 private:
  Distance distance_;
};

/// Collides between two angles from an axis.
inline auto ring(const Eigen::Vector3d& axis, double low, double high) {
  const Eigen::Vector3d unit = axis.normalized();
  return DistanceClassifier([=](const Eigen::Vector3d& d) {
    const double t = std::atan2(unit.cross(d).norm(), unit.dot(d));
    return std::max(low - t, t - high);
  });
}

inline double cap(double angle) { return 4 * std::numbers::pi * std::pow(std::sin(0.5 * angle), 2); }

inline Eigen::Vector3d direction_in(const DirectionCell& cell, RandomBodies& random) {
  Eigen::Vector3d d = Eigen::Vector3d::Zero();
  for (const auto& corner : cell) d += random.uniform(1e-9, 1) * corner;
  return d;
}

/// `truth(d)`: in, out or undecided (not known) of a direction; no cell says otherwise of any of its own.
template <typename Truth>
void expect_never_contradicted(const ConeMap& map, RandomBodies& random, int directions, const Truth& truth) {
  int told = 0;
  for (int i = 0; i < directions; ++i) {
    const int cell = random.integer(0, static_cast<int>(map.cells.size()) - 1);
    const Certified label = map.cells[cell].label;
    if (label == Certified::undecided) continue;
    const DirectionCell corners = map.cell(cell);
    const Eigen::Vector3d d = i % 4 == 0 ? corners[i / 4 % 3] : direction_in(corners, random);
    const Certified answer = truth(d);
    told += answer != Certified::undecided;
    ASSERT_TRUE(answer == label || answer == Certified::undecided)
        << "cell " << cell << " is " << to_string(label) << ", direction " << d.transpose() << " is "
        << to_string(answer);
  }
  EXPECT_GT(told, directions / 10);
}

}  // namespace vericone::testing
