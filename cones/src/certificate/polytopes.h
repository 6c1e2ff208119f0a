// SPDX-License-Identifier: BSD-3-Clause
//
// What proves a verdict about two convex bodies of which at least one has corners.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "certificate/bodies.h"
#include "certificate/ellipsoids.h"
#include "hulls/exact.h"
#include "hulls/scene.h"

namespace vericone::certificates {

/// Corners of a body and what they count, of sum 1.
using Weights = std::vector<std::pair<std::uint32_t, Rational>>;

/// Weights where a body has corners.
struct CornerMeeting {
  Meeting meeting;
  Weights weights;
  bool corners_of_agent;
};
struct CornerTouch {
  Touch touch;
  Weights agent, obstacle;
};

/// Corners of two bodies whose differences lie around a place of the way.
struct Crossing {
  struct Term {
    HullPair pair;
    Integer weight;
  };
  Rational time;
  std::vector<Term> terms;
};

class PolytopePair {
 public:
  PolytopePair(const Piece& a, const Eigen::Vector3d& a_at, const Piece& b, const Eigen::Vector3d& b_at,
               const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b, const Horizon& horizon, int grid);

  [[nodiscard]] std::optional<Plane> plane() const;
  /// Planes that may keep them apart, of few digits; not checked.
  [[nodiscard]] std::vector<Plane> proposals() const;
  static constexpr int kProposals = kNoGrid;  // the grid of a pair that is asked for nothing else
  [[nodiscard]] std::optional<CornerTouch> touch() const;
  /// Of an ellipsoid and a hull.
  [[nodiscard]] std::optional<CornerMeeting> meeting() const;
  /// Of two hulls.
  [[nodiscard]] std::optional<Crossing> crossing() const;

  [[nodiscard]] bool has_round() const { return scene_.ellipsoid.has_value(); }

 private:
  struct Found;
  using Pairs = std::vector<HullPair>;
  [[nodiscard]] bool moves() const { return !is_zero(motion_.w); }
  [[nodiscard]] const Round& round() const { return agent_.round ? *agent_.round : *obstacle_.round; }
  [[nodiscard]] Vector difference(HullPair pair) const {
    return obstacle_.points[pair.obstacle] - agent_.points[pair.agent];
  }
  [[nodiscard]] Found search(double from, double until) const;
  [[nodiscard]] Plane rounded_plane(Eigen::Vector3d n, int bits, bool across) const;
  [[nodiscard]] std::optional<Plane> short_plane(const Eigen::Vector3d& n, double left, bool across) const;
  [[nodiscard]] int least_bits(double left) const;
  [[nodiscard]] std::optional<Plane> exact_plane() const;
  [[nodiscard]] std::optional<Plane> shortened(const Vector& n) const;
  [[nodiscard]] std::optional<CornerMeeting> rounded_meeting(
      const std::vector<std::pair<std::uint32_t, double>>&, double time) const;
  [[nodiscard]] std::optional<CornerMeeting> exact_meeting(const exact::Shown& shown,
                                                           const std::optional<Rational>& time) const;
  [[nodiscard]] std::optional<CornerMeeting> checked(
      const std::vector<std::pair<std::uint32_t, Integer>>& parts, unsigned bits, const Dyadic& time) const;
  [[nodiscard]] double end_of_way() const;
  void add(Pairs& pairs, HullPair pair) const;
  [[nodiscard]] Pairs around(const Found& found) const;
  [[nodiscard]] Pairs around_line(bool widely) const;
  [[nodiscard]] std::optional<Crossing> crossing_along(const Pairs& pairs) const;
  [[nodiscard]] std::optional<Crossing> crossing_at(const Pairs& pairs, const Dyadic& time) const;
  [[nodiscard]] std::optional<CornerTouch> touch_of(const exact::Shown& shown,
                                                    const std::optional<Rational>& time) const;
  /// The time of points at both ends of the way, whose indices it takes off.
  [[nodiscard]] Rational time_of(exact::Shown& shown) const;
  [[nodiscard]] Dyadic nearest(double time, int beat) const;

  HullScene scene_;
  Motion motion_;
  Convex agent_, obstacle_;
  Eigen::Vector3d v_a_, v_b_, w_;
  Horizon horizon_;
};

}  // namespace vericone::certificates
