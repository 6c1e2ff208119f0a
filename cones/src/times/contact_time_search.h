// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <vericone/geometry/interval.h>
#include <array>
#include <optional>

#include "ellipsoids/enclosed_pair.h"

namespace vericone {

/// When A, moving by w t, first touches B.
struct ContactTimeBounds {
  enum class When { now, later, never };
  When when;
  double lo = 0, hi = 0;  // `later` lies between them, seconds
};

/// A floating search for the first contact, once, and certificates in intervals about what it found. An
/// answer holds for every w in the given intervals. No allocation, no throw.
///
/// A normal n with n.w > 0 bounds the time from below by g(n) / (n.w): until then its plane separates. A time
/// at which a point of the ray is certainly in K bounds it from above. A normal with g(n) > 0 and n.w <= 0
/// proves that there is none.
class ContactTimeSearch {
 public:
  ContactTimeSearch(const Ellipsoid& a, const Ellipsoid& b, const std::array<Interval, 3>& w) noexcept;

  /// Bounds `spread` apart, as a part of the time or of what it takes to cross the bodies; wider ones up to
  /// `widest` where these cannot be proved.
  std::optional<ContactTimeBounds> bounds(double spread, double widest) const noexcept;

 private:
  bool surely_touching(double time) const;
  /// Nothing where the search has not settled the question.
  void search(const Ellipsoid& a, const Ellipsoid& b);
  bool never_by(const Eigen::Vector3d& n) const;

  EnclosedPair<3> pair_;
  int speed_exponent_ = 0;
  std::array<Interval, 3> w_;  // divided by 2^speed_exponent
  Eigen::Vector3d w_mid_ = Eigen::Vector3d::Zero();
  std::optional<ContactTimeBounds> settled_;
  bool hit_ = false;
  Interval least_;  // of the time, in the units of pair_ and w_
  double crossing_ = 0;
  // Of the supporting points at contact.
  std::array<Interval, 3> support_a_, support_b_;
};

}  // namespace vericone
