// SPDX-License-Identifier: BSD-3-Clause
//
// Contacts of two disjoint combined quadrics along directions, searched for with proofs.
#pragma once

#include <vericone/cones/ellipsoids/predicates.h>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "combined/frame.h"
#include "combined/pair_search.h"

namespace vericone {

/// A contact along a direction w of the frame.
struct CombinedContact {
  SearchOutcome outcome = SearchOutcome::undecided;
  Eigen::Vector3d on_b = Eigen::Vector3d::Zero();  // A an ellipsoid: the point of B, in B's own coordinates
  Eigen::Vector3d on_a = Eigen::Vector3d::Zero();  // otherwise: the point of A, in the frame,
  double way = 0;                                  // and way w from there to that of B
};

/// Where A is an ellipsoid, the points z of B are searched, A being the unit ball: three unknowns. Otherwise
/// a point of A and the way along the direction, four unknowns for one direction, and pairs of boxes of both
/// for all between two. Directions are those of CombinedFrame::direction. Not for several threads at once:
/// lists and stacks are kept between calls.
class CombinedContacts {
 public:
  CombinedContacts(const CombinedEllipsoid& a, const CombinedEllipsoid& b, double tolerance);

  const CombinedFrame& frame() const { return frame_; }
  bool usable() const { return frame_.usable(); }

  /// Whether the bodies have a point in common; nothing where they touch or nearly do.
  std::optional<Relation> relation() const;

  /// Contacts of disjoint bodies along w within the ways [0, longest].
  CombinedContact along(const IntervalVector3& w, double longest) const;
  /// By a contact near the edge of the cone alone, without a search: see decide_from().
  CombinedContact beside(const IntervalVector3& w, const CombinedContact& near) const;
  /// No way is longer.
  double extent() const { return extent_; }

  /// Whether no direction between two, less than a right angle apart, leads to a contact (all of them do):
  /// true is certain, false says nothing.
  bool none_between(const IntervalVector3& from, const IntervalVector3& to) const;
  /// Where neither is an ellipsoid and the last answer of none_between() was false: points of A, in the
  /// frame, and of B, in its own coordinates, that were in the way.
  std::pair<Eigen::Vector3d, Eigen::Vector3d> left() const { return pairs_->left(); }
  /// `at_from`, `at_to`: contacts near both, from which others are looked for by steps alone, where neither
  /// is an ellipsoid; `between`: one half way.
  bool all_between(const IntervalVector3& from, const IntervalVector3& to,
                   const CombinedContact* at_from = nullptr, const CombinedContact* at_to = nullptr,
                   const CombinedContact* between = nullptr) const;
  /// Whether no direction w with n.w >= 0, n in metres, leads to a contact, from the points of both bodies
  /// that are nearly farthest along n and -n: true is certain, false says nothing.
  bool none_beyond(const Eigen::Vector3d& n, const CombinedContact& farthest) const;

  std::uint64_t boxes_searched() const { return boxes_ + (pairs_ ? pairs_->pairs() : 0); }

 private:
  template <int N>
  SearchResult<N> search(QuadraticSearch<N>& searcher, const std::vector<QuadraticConstraint<N>>& list,
                         const SearchBox<N>& box, const SearchLimits& most) const;
  IntervalVector3 in_own(const IntervalVector3& l) const;
  void add_half_space(const IntervalVector3& l, const Interval& l0) const;
  double ball_slack() const;
  template <int N>
  void add_bodies(const std::array<IntervalVector3, N>& to_y, const IntervalVector3& k, double squares,
                  const Eigen::Matrix<double, N, 1>& room, std::vector<QuadraticConstraint<N>>& list) const;
  void contact_inequalities(const IntervalVector3& w, double way) const;
  SearchLimits chord_limits() const;

  void ball_inequalities(const IntervalVector3& w) const;
  CombinedContact of_ball(const IntervalVector3& w, double longest) const;
  CombinedContact of_both(const IntervalVector3& w, double longest) const;
  CombinedContact deep_contact(const IntervalVector3& w, const CombinedContact& near, bool search) const;
  CombinedContact deepened(const IntervalVector3& w, const CombinedContact& near) const;
  SearchOutcome ball_between(const IntervalVector3& from, const IntervalVector3& to) const;
  bool ball_meets(const CombinedContact& found, const IntervalVector3& from, const IntervalVector3& to) const;
  bool ball_meets_all(const IntervalVector3& from, const IntervalVector3& to, int depth) const;
  bool joined(const IntervalVector3& from, const CombinedContact& first, const IntervalVector3& to,
              const CombinedContact& last) const;
  bool both_meet_all(const IntervalVector3& from, const CombinedContact& first, const IntervalVector3& to,
                     const CombinedContact& last, const CombinedContact* between, bool search,
                     int depth) const;

  CombinedFrame frame_;
  bool ball_;  // A is an ellipsoid
  SearchLimits limits_;
  std::vector<QuadraticConstraint<3>> surfaces_a_;  // in the frame
  std::vector<QuadraticConstraint<3>> surfaces_b_;  // of z, B's own coordinates
  double extent_ = 0;                               // |x| is at most this
  double columns_square_ = 0;                       // squared columns of G, summed

  std::unique_ptr<PairSearch> pairs_;  // neither is an ellipsoid
  mutable std::uint64_t boxes_ = 0;
  mutable QuadraticSearch<3> search3_;
  mutable QuadraticSearch<4> search4_;
  mutable std::vector<QuadraticConstraint<3>> list3_;
  mutable std::vector<QuadraticConstraint<4>> list4_;
};

}  // namespace vericone
