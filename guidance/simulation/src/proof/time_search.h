// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/geometry/error.h>
#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace vericone::simulation {

/// An interval of time, and the normal that certified, or nearly, the one it was cut from.
template <typename Moment>
struct TimeSpan {
  Moment from, to;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

/// What is found of a span: a proof that nothing meets all over it, a meeting in its middle, or neither.
template <typename Leaf>
struct TimeLook {
  std::optional<Leaf> proved;
  bool meets = false;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

enum class TimeEnd : std::uint8_t { touched, undecided, apart };

/// The search for a proof: spans of time from the first to the last, halved until each is proved or a meeting
/// is found. What is proved, and how, is the Certificate's, which has
///   Moment (with its time t), Leaf (a span that is proved, and its bound), at(t),
///   meets(moment), look(span, middle); for refine(): measured(leaf), near_enough(leaf), half(leaf, span).
template <typename Certificate>
class TimeSearch {
 public:
  using Moment = typename Certificate::Moment;
  using Leaf = typename Certificate::Leaf;
  using Span = TimeSpan<Moment>;

  /// Spans shorter than `resolution` s are not halved, and no more than `most` are proved: of bodies as long
  /// as a town that turn, spans of any length prove little; without an end the search takes all memory.
  TimeSearch(Certificate& certificate, double resolution, std::size_t most)
      : certificate_(certificate), resolution_(resolution), most_(most) {}

  TimeEnd run(double from, double to) {
    const Moment first = certificate_.at(from), last = certificate_.at(to);
    if (certificate_.meets(first)) return touched({first, first});
    open_.push_back({first, last});
    while (!open_.empty()) {
      checkpoint();
      const Span span = open_.back();
      open_.pop_back();
      if (step(span)) return TimeEnd::touched;
    }
    if (horizon_) return touched({*horizon_, *horizon_});
    return unresolved_ ? TimeEnd::undecided : TimeEnd::apart;
  }

  /// touched: apart before the span, proved, meeting at its end. undecided: the first span without proof.
  [[nodiscard]] const Span& found() const { return found_ ? *found_ : *unresolved_; }
  [[nodiscard]] const std::vector<Leaf>& leaves() const { return leaves_; }
  [[nodiscard]] const Leaf& least() const { return *std::min_element(leaves_.begin(), leaves_.end(), lower); }
  [[nodiscard]] Moment middle(const Span& span) const {
    return certificate_.at(0.5 * (span.from.t + span.to.t));
  }

  /// Halves the span of the least bound until that is near a distance that the bodies do come to; what holds
  /// for the whole holds for the half.
  void refine(int most) {
    for (int i = 0; i < most; ++i) {
      const auto least = std::min_element(leaves_.begin(), leaves_.end(), lower);
      if (!certificate_.measured(*least)) continue;
      if (certificate_.near_enough(*least)) return;
      const Leaf parent = *least;
      const Moment mid = middle(parent.span);
      if (!inside(parent.span, mid)) return;
      *least = certificate_.half(parent, {parent.span.from, mid, parent.span.normal});
      leaves_.push_back(certificate_.half(parent, {mid, parent.span.to, parent.span.normal}));
    }
  }

 private:
  static bool lower(const Leaf& x, const Leaf& y) { return x.bound < y.bound; }
  static bool inside(const Span& span, const Moment& mid) { return mid.t > span.from.t && mid.t < span.to.t; }

  /// Once a span has been left undecided, only a meeting is still looked for, ever more coarsely.
  double shortest(double t) const {
    const double since = unresolved_ ? t - unresolved_->from.t : 0;
    return std::max(resolution_, since / 16);
  }

  TimeEnd touched(const Span& span) {
    found_ = span;
    return TimeEnd::touched;
  }

  /// One span. True: they meet.
  bool step(const Span& span) {
    const Moment mid = middle(span);
    TimeLook<Leaf> look = certificate_.look(span, mid);
    if (look.proved) {
      leaves_.push_back(std::move(*look.proved));
      return false;
    }
    const bool halved = inside(span, mid) && span.to.t - span.from.t > shortest(span.from.t) &&
                        (leaves_.size() < most_ || unresolved_);
    const Moment& apart_before = unresolved_ ? unresolved_->from : span.from;
    if (look.meets) {  // what comes later does not matter any more
      open_.clear();
      horizon_ = mid;
      if (halved)
        open_.push_back({span.from, mid, look.normal});
      else
        touched({apart_before, mid, look.normal});
      return !halved;
    }
    if (halved) {
      open_.push_back({mid, span.to, look.normal});
      open_.push_back({span.from, mid, look.normal});
      return false;
    }
    if ((horizon_ && span.to.t == horizon_->t) || certificate_.meets(span.to)) {
      touched({apart_before, span.to, look.normal});
      return true;
    }
    if (!unresolved_) unresolved_ = span;
    return false;
  }

  Certificate& certificate_;
  double resolution_;
  std::size_t most_;
  std::vector<Span> open_;  // the earliest last
  std::vector<Leaf> leaves_;
  std::optional<Span> unresolved_;  // the first
  std::optional<Moment> horizon_;   // they meet then
  std::optional<Span> found_;
};

}  // namespace vericone::simulation
