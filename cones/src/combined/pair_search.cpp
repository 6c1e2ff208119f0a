// SPDX-License-Identifier: BSD-3-Clause
#include "combined/pair_search.h"

#include <Eigen/Geometry>

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

bool PairSearch::none_between(const IntervalVector3& from, const IntervalVector3& to, int most_pairs,
                              double least_width) {
  if (!set_rows(from, to)) return false;
  stack_.clear();
  for (const int i : a_.roots())
    for (const int j : b_.roots()) stack_.emplace_back(i, j);
  for (int count = 0; !stack_.empty(); ++count) {
    if (count >= most_pairs) return false;
    ++pairs_;
    const auto [i, j] = stack_.back();
    stack_.pop_back();
    bool apart = false;
    for (int k = 0; k < rows_ && !apart; ++k) {
      const double of_a = a_.most(i, k), of_b = b_.most(j, k), sum = of_a + of_b + offset_[k];
      apart = sum < -1e-15 * (std::abs(of_a) + std::abs(of_b) + std::abs(offset_[k]));
    }
    if (apart) continue;
    const double width_a = a_.node(i).width, width_b = b_.node(j).width;
    last_ = {i, j};
    if (std::max(width_a, width_b) < least_width) return false;
    int first = 0;
    if (width_a >= width_b) {
      const int parts = a_.divide(i, first);
      for (int p = 0; p < parts; ++p) stack_.emplace_back(first + p, j);
    } else {
      const int parts = b_.divide(j, first);
      for (int p = 0; p < parts; ++p) stack_.emplace_back(i, first + p);
    }
  }
  return true;
}

std::pair<Vector3d, Vector3d> PairSearch::left() const {
  return {a_.node(last_.first).box.middle, b_.node(last_.second).box.middle};
}

}  // namespace vericone
