// SPDX-License-Identifier: BSD-3-Clause
//
// Whether any direction between two leads two disjoint bodies to a contact, by pairs of boxes of their
// boundaries.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "combined/body_tree.h"
#include "combined/frame.h"

namespace vericone {

/// A contact along w has m.(b - a) >= 0 for every m with m.w >= 0. The normals of the plane of both
/// directions and those of its two rays, a few of their sums with them, are such m: a pair of boxes is done
/// with when one of them says that b - a is not so. Each box is asked once a chord, however many pairs it is
/// in, and what is left of the bodies in a box is known from the chords before.
class PairSearch {
 public:
  /// Refers to the frame.
  explicit PairSearch(const CombinedFrame& frame);

  /// Whether no direction between two is one of a contact: true is certain, false says nothing.
  bool none_between(const IntervalVector3& from, const IntervalVector3& to, int most_pairs,
                    double least_width);

  /// After `false`: the middles of two boxes where a contact may be, in A's frame and in B's own coordinates.
  std::pair<Eigen::Vector3d, Eigen::Vector3d> left() const;

  /// Pairs looked at since the construction.
  std::uint64_t pairs() const { return pairs_; }

 private:
  bool set_rows(const IntervalVector3& from, const IntervalVector3& to);
  double least(int i, int j);

  const CombinedFrame& frame_;
  BodyTree a_, b_;
  std::array<double, TreeRows::kMost> offset_{};  // m.c, rounded up, and what rounding may lose
  int rows_ = 0;
  std::vector<std::pair<int, int>> stack_;
  std::pair<int, int> last_{0, 0};
  std::uint64_t pairs_ = 0;
};

}  // namespace vericone
