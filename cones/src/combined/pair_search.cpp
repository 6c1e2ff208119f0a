// SPDX-License-Identifier: BSD-3-Clause
#include "combined/pair_search.h"

#include <vericone/geometry/error.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace vericone {
namespace {

using Eigen::Vector3d;

const Vector3d kTreeRoom = Vector3d::Constant(1.002);
const IntervalVector3 kNowhere{Interval(0), Interval(0), Interval(0)};
const std::array<IntervalVector3, 3> kUnitAxes{IntervalVector3{Interval(1), Interval(0), Interval(0)},
                                               IntervalVector3{Interval(0), Interval(1), Interval(0)},
                                               IntervalVector3{Interval(0), Interval(0), Interval(1)}};

IntervalVector3 as_intervals(const Vector3d& v) { return {Interval(v(0)), Interval(v(1)), Interval(v(2))}; }

std::vector<QuadraticConstraint<3>> constraints_of(const std::vector<EnclosedQuadric>& body) {
  std::vector<QuadraticConstraint<3>> all;
  for (const EnclosedQuadric& q : body)
    all.push_back(quadratic_constraint<3>(q.matrix, kUnitAxes, kNowhere, Interval(q.level),
                                          -q.least_eigenvalue, kTreeRoom));
  return all;
}

}  // namespace

PairSearch::PairSearch(const CombinedFrame& frame) : frame_(frame) {
  a_.start(constraints_of(frame.a()), Vector3d::Ones());
  Vector3d columns;
  for (int j = 0; j < 3; ++j) columns(j) = middle(frame.columns_b()[j]).norm();
  b_.start(constraints_of(frame.own_b()), columns);
}

bool PairSearch::set_rows(const IntervalVector3& from, const IntervalVector3& to) {
  const Vector3d first = middle(from).normalized(), last = middle(to).normalized(),
                 between = (first + last).normalized(), normal = first.cross(last).normalized();
  // Turned towards the directions by more than rounding may turn them away.
  constexpr double kTurn = 1e-11;
  TreeRows of_a, of_b;
  rows_ = 0;
  const auto add = [&](const Vector3d& across) {
    const Vector3d m = across + kTurn * between;
    const IntervalVector3 enclosed = as_intervals(m);
    if (!dot(enclosed, from).positive() || !dot(enclosed, to).positive()) return;
    of_a.add(-m);
    const auto& g = frame_.columns_b();
    Interval shift = dot(enclosed, frame_.center());
    Vector3d row;
    double off = 0;
    for (int j = 0; j < 3; ++j) {
      const Interval x = dot(enclosed, g[j]);
      row(j) = x.mid();
      off += x.rad() * kTreeRoom(j);
    }
    of_b.add(row);
    offset_[rows_++] = shift.hi() + 1.001 * off + 1e-15 * std::abs(shift.hi());
  };
  const Vector3d of_first = normal.cross(first), of_last = last.cross(normal);
  for (const double side : {1.0, -1.0}) add(side * normal);
  add(of_first);
  add(of_last);
  for (const double side : {1.0, -1.0})
    for (const Vector3d* ray : {&of_first, &of_last}) add((side * normal + 0.3 * *ray).normalized());
  a_.ask(of_a);
  b_.ask(of_b);
  return rows_ > 0;
}

/// The least that a row leaves to a pair of boxes: below 0 where no contact is in it.
double PairSearch::least(int i, int j) {
  ++pairs_;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < rows_; ++k) {
    const double of_a = a_.most(i, k), of_b = b_.most(j, k), sum = of_a + of_b + offset_[k];
    least = std::min(least, sum);
    if (sum < -1e-15 * (std::abs(of_a) + std::abs(of_b) + std::abs(offset_[k]))) return sum;
    if (sum < 0) least = 0;  // not certainly
  }
  return std::max(least, 0.0);
}

bool PairSearch::none_between(const IntervalVector3& from, const IntervalVector3& to, int most_pairs,
                              double least_width) {
  if (!set_rows(from, to)) return false;
  const std::uint64_t end = pairs_ + static_cast<std::uint64_t>(most_pairs);
  stack_.clear();
  for (const int i : a_.roots())
    for (const int j : b_.roots())
      if (least(i, j) >= 0) stack_.emplace_back(i, j);
  for (unsigned step = 1; !stack_.empty(); ++step) {
    if (step % 1024 == 0) checkpoint();
    const auto [i, j] = stack_.back();
    last_ = {i, j};
    if (pairs_ >= end) return false;
    stack_.pop_back();
    const double width_a = a_.node(i).width, width_b = b_.node(j).width;
    if (std::max(width_a, width_b) < least_width) return false;
    // Where a contact is most likely first: what is in the way of the proof is found soon.
    const bool of_a = width_a >= width_b;
    int first = 0;
    const int parts = of_a ? a_.divide(i, first) : b_.divide(j, first);
    double highest = -1;
    for (int p = 0; p < parts; ++p) {
      const std::pair<int, int> part = of_a ? std::pair(first + p, j) : std::pair(i, first + p);
      const double left = least(part.first, part.second);
      if (left < 0) continue;
      stack_.push_back(part);
      if (left < highest) std::swap(stack_.back(), stack_[stack_.size() - 2]);
      highest = left;
    }
  }
  return true;
}

std::pair<Vector3d, Vector3d> PairSearch::left() const {
  return {a_.node(last_.first).box.middle, b_.node(last_.second).box.middle};
}

}  // namespace vericone
