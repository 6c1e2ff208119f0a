// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/internal/geometry/exact/algebraic.h>
#include <optional>
#include <utility>

#include "times/entry_time.h"

namespace vericone::exact {

/// When A, moving by w t with w = v_a - v_b, finite, first touches B, in seconds: an algebraic number, known
/// as well as it was asked for.
class ContactTime {
 public:
  enum class When { now, later, never };

  ContactTime(const ConeOracle& oracle, const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b);

  When when() const { return when_; }
  /// Contains it, a few units in the last place wide; `later`.
  Interval enclosure();

  /// Sign of x - y, `never` being later than any other.
  friend int compare(ContactTime& x, ContactTime& y);

 private:
  const Polynomial& polynomial();
  RealRoot& root();
  std::pair<Dyadic, Dyadic> bounds(int bits);

  When when_ = When::never;
  // `later`: a contact that lasts, or one that grazes and is known as a root at once.
  std::optional<EntryTime> entry_;
  std::optional<RealRoot> root_;
};

}  // namespace vericone::exact
