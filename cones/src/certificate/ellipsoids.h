// SPDX-License-Identifier: BSD-3-Clause
//
// What proves a verdict about two ellipsoids.
#pragma once

#include <array>
#include <optional>

#include "certificate/grid.h"

namespace vericone::certificates {

/// A common supporting plane and the point in it, at a time. Lengths in units of the grid.
struct Touch {
  Vector normal;                           // from the agent towards the obstacle
  Rational agent_radius, obstacle_radius;  // rho(n)
  Rational time;
  std::array<Rational, 3> point;
};

/// Two ellipsoids that move, as numbers and as integers.
class EllipsoidPair {
 public:
  EllipsoidPair(const Ellipsoid& a, const Vector& center_a, const Ellipsoid& b, const Vector& center_b,
                const Motion& motion);

  [[nodiscard]] std::optional<Plane> plane() const;
  [[nodiscard]] std::optional<Meeting> meeting() const;
  [[nodiscard]] std::optional<Touch> touch() const;

 private:
  struct Guess;
  [[nodiscard]] Guess line_guess() const;
  [[nodiscard]] Guess guess_at(double time) const;
  [[nodiscard]] std::optional<Plane> short_plane(const Guess& guess, bool across) const;
  [[nodiscard]] std::optional<Plane> exact_plane_across(double ratio) const;
  [[nodiscard]] std::optional<Plane> exact_plane_at(const Dyadic& time, double ratio) const;
  [[nodiscard]] std::optional<Meeting> short_meeting(const Guess& guess) const;
  [[nodiscard]] std::optional<Meeting> exact_meeting(double ratio, double size) const;
  [[nodiscard]] std::optional<Meeting> exact_meeting_at(const Dyadic& time, double ratio, double size) const;
  [[nodiscard]] std::optional<Touch> touch_of(const Vector& normal, const std::optional<Dyadic>& time) const;
  [[nodiscard]] bool is_common(const Meeting& meeting) const;
  [[nodiscard]] Dyadic nearest(double time) const;

  const Ellipsoid &a_, &b_;
  const Motion& motion_;
  Convex agent_, obstacle_;
  Vector c_;
  Eigen::Vector3d center_a_, center_b_, line_, v_a_, v_b_, w_;  // m, m/s
};

}  // namespace vericone::certificates
