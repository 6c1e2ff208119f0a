// SPDX-License-Identifier: BSD-3-Clause
//
// What proves a verdict about two convex bodies of which one has flat, round and straight parts.
#pragma once

#include <optional>

#include "certificate/rounded_hull.h"

namespace vericone::certificates {

/// A point of both at a time, as a mean of the parts of each.
struct CommonPoint {
  Rational time;
  Fractions point;
  Mean agent, obstacle;
};

/// That both are within, not on the rim of what they are the hull of; of which the directions span the space.
struct DeepPoint : CommonPoint {
  enum class Inside : std::uint8_t { agent, obstacle, both } inside = Inside::both;
};

struct CommonFace {
  Vector normal;
  CommonPoint at;
};

class ConvexPair {
 public:
  ConvexPair(const RoundedHull& agent, const RoundedHull& obstacle, const Eigen::Vector3d& v_a,
             const Eigen::Vector3d& v_b, const Horizon& horizon);

  /// With its two levels, of few digits.
  [[nodiscard]] std::optional<Plane> plane() const;
  [[nodiscard]] std::optional<DeepPoint> meeting() const;
  [[nodiscard]] std::optional<CommonFace> touch() const;

 private:
  struct Tried;
  struct Found;
  struct Direction;
  /// Of as many binary digits.
  [[nodiscard]] std::optional<Plane> plane_near(const Eigen::Vector3d& n, int bits, bool across) const;
  [[nodiscard]] std::optional<Plane> with_levels(Plane plane) const;
  [[nodiscard]] Found search(double share) const;
  [[nodiscard]] Found grown() const;
  void take_middle(const RoundedHull& hull, std::vector<std::uint32_t>& parts, Eigen::Vector3d& middle) const;
  [[nodiscard]] Mean mean_of(const Found& found, bool agent, int bits) const;
  [[nodiscard]] double time_of(const Found& found) const;
  [[nodiscard]] Rational time_of(const Found& found, int bits) const;
  [[nodiscard]] std::vector<Direction> ways(const CommonPoint& at) const;
  [[nodiscard]] bool close(CommonPoint& at) const;
  [[nodiscard]] std::optional<CommonPoint> checked(const Found& found, int bits, bool within) const;
  [[nodiscard]] std::optional<CommonPoint> common_point(bool or_rim) const;
  [[nodiscard]] std::vector<Vector> simple_normals(const Eigen::Vector3d& n) const;
  [[nodiscard]] std::optional<CommonFace> touch_along(const Vector& n) const;
  [[nodiscard]] bool moves() const { return !w_.isZero(0); }
  [[nodiscard]] bool within(const Rational& time) const {
    return time > from_ && (!until_ || time < *until_);
  }

  const RoundedHull &agent_, &obstacle_;
  Eigen::Vector3d v_a_, v_b_, w_;
  Fractions exact_v_a_, exact_v_b_;
  Rational from_;
  std::optional<Rational> until_;
  double start_ = 0, end_ = 0;  // of the way, s
  double size_ = 0;             // of both, m
  std::vector<std::uint32_t> middle_of_agent_, middle_of_obstacle_;
  Eigen::Vector3d agent_middle_, obstacle_middle_;  // about their places
};

}  // namespace vericone::certificates
