// SPDX-License-Identifier: BSD-3-Clause
//
// Whether some point of a box satisfies a list of quadratic inequalities: branch and bound with proofs. What
// the certified cones of combined quadrics rest on (docs/explanation/theory.md, 7).
#pragma once

#include <vericone/geometry/error.h>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "balance.h"

namespace vericone {

/// q(x) = x^T H x + 2 g.x + c + min(0, u.x + u0)^2 <= 0, for x in the box of the search. The last term is
/// convex with a continuous gradient: it makes the distance from a line to that from a half-line's side.
///
/// `slack` bounds everything that separates the value computed from the true one, anywhere in the box: the
/// errors of the coefficients and the roundings of evaluating it. `concavity` a >= 0 makes H + a I positive
/// semidefinite.
template <int N>
struct QuadraticConstraint {
  Eigen::Matrix<double, N, N> h = Eigen::Matrix<double, N, N>::Zero();
  Eigen::Matrix<double, N, 1> g = Eigen::Matrix<double, N, 1>::Zero();
  double c = 0;
  Eigen::Matrix<double, N, 1> u = Eigen::Matrix<double, N, 1>::Zero();
  double u0 = 0;
  double slack = 0;
  double concavity = 0;

  /// Value without slack, and gradient.
  double evaluate(const Eigen::Matrix<double, N, 1>& x, Eigen::Matrix<double, N, 1>& gradient) const {
    const Eigen::Matrix<double, N, 1> hx = h * x;
    const double side = std::min(0.0, u.dot(x) + u0);
    gradient = 2 * (hx + g + side * u);
    return x.dot(hx + 2 * g) + c + side * side;
  }
};

template <int N>
struct SearchBox {
  Eigen::Matrix<double, N, 1> middle, half;
};

/// Between two checkpoints: 0.3 ms.
inline constexpr int kBoxesWorthAsking = 1024;

struct SearchLimits {
  double least_width = 1e-6;  // boxes are not split below this half width
  int boxes = 20000;          // at most
};

enum class SearchOutcome : std::uint8_t { empty, found, undecided };

template <int N>
struct SearchResult {
  SearchOutcome outcome = SearchOutcome::undecided;
  Eigen::Matrix<double, N, 1> point;  // `found`: satisfies all, with certainty
  int boxes = 0;
};

/// `empty`: no point of the box satisfies all inequalities; `found`: the point returned does. Both are
/// certain.
///
/// In a box of half widths h about m, q(m + d) >= q(m) + G.d - a |h|^2 with G = 2 (H m + g): a linear bound
/// that is off by the square of the width only. Each single bound may empty or shrink the box; otherwise
/// multipliers lambda >= 0 are sought for which the combination is positive on all of it, so that not all can
/// be negative. Near the tangency of two bodies the multipliers are those of the tangency (Karush, Kuhn and
/// Tucker), and a gap delta is proved with boxes of width sqrt(delta). Cost: about 0.3 us a box, no
/// allocation once the scratch memory has grown.
template <int N>
class QuadraticSearch {
 public:
  using Vector = Eigen::Matrix<double, N, 1>;

  SearchResult<N> run(const std::vector<QuadraticConstraint<N>>& constraints, const SearchBox<N>& box,
                      const SearchLimits& limits) {
    count_ = static_cast<int>(constraints.size());
    bounds_.resize(constraints.size());
    concavity_.resize(constraints.size());
    SearchResult<N> result;
    bool undecided = false;
    stack_.assign(1, box);
    while (!stack_.empty()) {
      if (result.boxes >= limits.boxes) return result;
      if (++result.boxes % kBoxesWorthAsking == 0) checkpoint();
      SearchBox<N> current = stack_.back();
      stack_.pop_back();
      int split = -1;
      switch (examine(constraints, current, result.point, split)) {
        case SearchOutcome::empty:
          continue;
        case SearchOutcome::found:
          result.outcome = SearchOutcome::found;
          return result;
        case SearchOutcome::undecided:
          break;
      }
      if (current.half.maxCoeff() < limits.least_width) {
        undecided = true;
        continue;
      }
      // Nearer half, by the gradient of the combination that came closest, first: witnesses are found sooner.
      SearchBox<N> other = current;
      const double quarter = 0.5 * current.half(split);
      // Wider by what the rounding of the middles may lose.
      current.half(split) = other.half(split) =
          quarter * (1 + 1e-15) + 4e-16 * (std::abs(current.middle(split)) + quarter);
      current.middle(split) -= quarter;
      other.middle(split) += quarter;
      const bool low_first = gradient_(split) > 0;
      stack_.push_back(low_first ? other : current);
      stack_.push_back(low_first ? current : other);
    }
    result.outcome = undecided ? SearchOutcome::undecided : SearchOutcome::empty;
    return result;
  }

 private:
  struct Bound {
    double base = 0;   // q(m) - a |h|^2 - slack
    double reach = 0;  // sum |G_j| h_j
    Vector gradient;
  };

  SearchOutcome examine(const std::vector<QuadraticConstraint<N>>& constraints, SearchBox<N>& box,
                        Vector& point, int& split) {
    for (int pass = 0; pass < 2; ++pass) {
      const double square = box.half.squaredNorm();
      double worst = -1e300;
      for (int i = 0; i < count_; ++i) {
        const QuadraticConstraint<N>& q = constraints[i];
        Bound& b = bounds_[i];
        const double value = q.evaluate(box.middle, b.gradient);
        worst = std::max(worst, value + q.slack);
        b.base = value - q.concavity * square - q.slack;
        b.reach = b.gradient.cwiseAbs().dot(box.half);
        if (b.base - b.reach > rounding(b)) return SearchOutcome::empty;
      }
      if (worst <= 0) {
        point = box.middle;
        return SearchOutcome::found;
      }
      const double before = box.half.prod();
      if (!shrink(box)) return SearchOutcome::empty;
      if (box.half.prod() > 0.5 * before) break;
    }
    if (improved_point(constraints, box, point)) return SearchOutcome::found;
    if (combine(box, constraints, split)) return SearchOutcome::empty;
    // Worth its cost where little but the curvature is in the way.
    const bool tangent = flat_ > -0.1 && box.half.maxCoeff() < 0.03;
    return tangent && balanced(box, constraints) ? SearchOutcome::empty : SearchOutcome::undecided;
  }

  /// The most that -d^T H d can be in the box: by its entries.
  static double sag(const Eigen::Matrix<double, N, N>& h, const Vector& half) {
    double most = 0;
    for (int i = 0; i < N; ++i) {
      most += std::max(0.0, -h(i, i)) * half(i) * half(i);
      for (int j = 0; j < i; ++j) most += 2 * std::abs(h(i, j)) * half(i) * half(j);
    }
    return most;
  }

  /// Multipliers for which the gradients, in units of the box, nearly cancel: what the combination bends
  /// then is its own curvature, often none, not the sum of those of its parts.
  bool balanced(const SearchBox<N>& box, const std::vector<QuadraticConstraint<N>>& constraints) const {
    Balance<N> balance;
    for (int i = 0; i < count_; ++i) {
      typename Balance<N>::Bound bound;
      const QuadraticConstraint<N>& q = constraints[i];
      const double base = q.evaluate(box.middle, bound.slope) - q.slack;
      bound.slope = bound.slope.cwiseProduct(box.half);
      const double size = bound.slope.norm();
      if (!(size > 0) || base < -size) continue;
      bound.index = i;
      bound.scale = 1 / size;
      bound.base = base * bound.scale;
      bound.slope *= bound.scale;
      balance.offer(bound);
    }
    if (!balance.solve()) return false;
    Eigen::Matrix<double, N, N> h = Eigen::Matrix<double, N, N>::Zero();
    for (int i = 0; i < balance.count(); ++i)
      h += balance[i].weight * balance[i].scale * constraints[balance[i].index].h;
    return balance.base() - balance.rest().cwiseAbs().sum() - sag(h, box.half) > 1e-13;
  }

  /// What the few operations on a bound itself may round.
  static double rounding(const Bound& b) { return 1e-15 * (std::abs(b.base) + b.reach); }

  /// G.d <= -base with |d| <= h bounds every coordinate. False: nothing is left.
  bool shrink(SearchBox<N>& box) const {
    Vector lo = -box.half, hi = box.half;
    for (int i = 0; i < count_; ++i) {
      const Bound& b = bounds_[i];
      if (b.base + b.reach <= 0) continue;  // does not cut
      const double room = -b.base + rounding(b);
      for (int j = 0; j < N; ++j) {
        const double g = b.gradient(j);
        const double rest = b.reach - std::abs(g) * box.half(j);
        if (std::abs(g) * box.half(j) <= 1e-3 * b.reach) continue;
        const double limit = (room + rest) / g * (1 + (((room + rest) > 0) ? 1e-14 : -1e-14));
        if (g > 0) {
          hi(j) = std::min(hi(j), limit);
        } else {
          lo(j) = std::max(lo(j), limit);
        }
      }
    }
    for (int j = 0; j < N; ++j) {
      if (lo(j) > hi(j)) return false;
      if (lo(j) == -box.half(j) && hi(j) == box.half(j)) continue;
      const double middle = box.middle(j) + 0.5 * (lo(j) + hi(j));
      // Widened so that rounding loses nothing of the interval.
      box.half(j) = 0.5 * (hi(j) - lo(j)) + 4e-16 * (std::abs(middle) + box.half(j));
      box.middle(j) = middle;
    }
    return true;
  }

  /// A point that satisfies all, looked for from the middle by steps against what is violated most.
  bool improved_point(const std::vector<QuadraticConstraint<N>>& constraints, const SearchBox<N>& box,
                      Vector& point) const {
    Vector x = box.middle;
    for (int step = 0; step < 6; ++step) {
      double worst = 0;
      Vector gradient = Vector::Zero();
      for (int i = 0; i < count_; ++i) {
        const QuadraticConstraint<N>& q = constraints[i];
        Vector own;
        const double value = q.evaluate(x, own) + q.slack;
        if (value > worst) {
          worst = value;
          gradient = own;
        }
      }
      if (worst <= 0) {
        // Inside the box of the search, where the slacks hold.
        if (((x - box.middle).cwiseAbs() - box.half).maxCoeff() > 0) return false;
        point = x;
        return true;
      }
      const double norm = gradient.squaredNorm();
      if (!(norm > 0)) return false;
      x -= (1.05 * worst / norm) * gradient;
      if (((x - box.middle).cwiseAbs() - box.half).maxCoeff() > 0) return false;
    }
    return false;
  }

  /// Multipliers: from the best single bound, exact line searches towards each other one (the function is
  /// concave and piecewise linear, its breaks are where a component of the gradient vanishes).
  bool combine(const SearchBox<N>& box, const std::vector<QuadraticConstraint<N>>& constraints, int& split) {
    const auto value = [&](const Bound& b) { return b.base - b.gradient.cwiseAbs().dot(box.half); };
    // The bounds anew: the box may have shrunk since.
    const double square = box.half.squaredNorm();
    int best = 0;
    double highest = -1e300, curvature = 0;
    for (int i = 0; i < count_; ++i) {
      const QuadraticConstraint<N>& q = constraints[i];
      Bound& b = bounds_[i];
      b.base = q.evaluate(box.middle, b.gradient) - q.concavity * square - q.slack;
      b.reach = b.gradient.cwiseAbs().dot(box.half);
      // One scale for all: multipliers compare parts of each bound's own reach.
      const double scale = 1 / (b.reach + q.concavity * square + q.slack + 1e-300);
      b.base *= scale;
      b.gradient *= scale;
      b.reach *= scale;
      concavity_[i] = q.concavity * scale;
      if (b.base - b.reach > highest) {
        highest = b.base - b.reach;
        best = i;
      }
    }
    Bound sum = bounds_[best];
    curvature = concavity_[best];
    for (int round = 0; round < 4 && highest <= 0; ++round) {
      double gain = 0;
      for (int k = 0; k < count_; ++k) {
        if (bounds_[k].base + bounds_[k].reach <= 0) continue;  // cannot help: negative everywhere
        double at = 0, top = highest;
        Bound found = sum;
        for (int j = 0; j < N; ++j) {
          // (1 - s) sum_j + s k_j = 0
          const double p = sum.gradient(j), q = bounds_[k].gradient(j);
          if (!(p * q < 0)) continue;
          const double s = p / (p - q);
          Bound mixed;
          mixed.base = (1 - s) * sum.base + s * bounds_[k].base;
          mixed.gradient = (1 - s) * sum.gradient + s * bounds_[k].gradient;
          const double v = value(mixed);
          if (v > top) {
            top = v;
            at = s;
            found = mixed;
          }
        }
        if (at > 0) {
          gain = std::max(gain, top - highest);
          highest = top;
          sum = found;
          curvature = (1 - at) * curvature + at * concavity_[k];
        }
      }
      if (!(gain > 1e-3 * std::abs(highest))) break;
    }
    // All numbers are at most one here, and at most a few hundred roundings were made.
    if (highest > 1e-13) return true;
    flat_ = highest + curvature * square;
    gradient_ = sum.gradient;
    double most = -1;
    for (int j = 0; j < N; ++j) {
      const double score =
          (std::abs(sum.gradient(j)) + curvature * box.half(j) + 1e-3 * spread(j)) * box.half(j);
      if (score > most) {
        most = score;
        split = j;
      }
    }
    return false;
  }

  /// Largest scaled slope of any bound along a coordinate.
  double spread(int j) const {
    double s = 0;
    for (int i = 0; i < count_; ++i) s = std::max(s, std::abs(bounds_[i].gradient(j)));
    return s;
  }

  int count_ = 0;
  std::vector<Bound> bounds_;
  std::vector<double> concavity_;
  Vector gradient_ = Vector::Zero();
  double flat_ = 0;  // the best combination's bound without the curvature
  std::vector<SearchBox<N>> stack_;
};

}  // namespace vericone
