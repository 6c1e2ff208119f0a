// SPDX-License-Identifier: BSD-3-Clause
//
// The largest length of a derivative: the square of it is a polynomial, whose Bernstein coefficients bound it
// and whose values reach it. The piece with the largest bound is halved until both are equal but for 1e-9.
#include <vericone/geometry/error.h>
#include <vericone/simulation/trajectory.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include "foreign/bernstein.h"
#include "foreign/pieces.h"

namespace vericone::simulation {
namespace {

using Eigen::Vector3d;

constexpr double kDerivativeRounding = 1e-13;  // of the largest coefficient that a sum is made of
constexpr double kEnough = 1e-9;
constexpr int kMostSteps = 100'000;

/// A part of a piece, its derivative by control points.
struct DerivativePart {
  ControlPoints points;
  double from, to;   // s
  double most;       // not below the length of the derivative in it
  double uncertain;  // of its control points, in their unit

  bool operator<(const DerivativePart& other) const { return most < other.most; }
};

double bound_of(const ControlPoints& points) {
  constexpr double kSquared = 1e150;  // above, squares are not finite
  if (!(most_of(points) < kSquared)) return std::numeric_limits<double>::infinity();
  const int m = degree_of(points);
  double most = 0;
  for (int k = 0; k <= 2 * m; ++k) {
    double sum = 0;
    for (int i = std::max(0, k - m); i <= std::min(k, m); ++i)
      sum += binomial(m, i) * binomial(m, k - i) *
             points[static_cast<std::size_t>(i)].dot(points[static_cast<std::size_t>(k - i)]);
    most = std::max(most, sum / binomial(2 * m, k));
  }
  return std::sqrt(most) + kDerivativeRounding * most_of(points);
}

class GreatestSearch {
 public:
  GreatestSearch(const Piecewise& of, int derivative) {
    for (std::size_t k = 0; k < of.points.size(); ++k) {
      const double h = of.times[k + 1] - of.times[k];
      ControlPoints points = of.points[k];
      double uncertain = of.error + kDerivativeRounding * most_of(points);
      for (int i = 0; i < derivative; ++i) {
        uncertain *= 2.0 * std::max(0, degree_of(points)) / h;
        points = derivative_of(points);
        for (Vector3d& x : points) x /= h;
      }
      add({std::move(points), of.times[k], of.times[k + 1], 0, uncertain});
    }
  }

  Greatest found() {
    for (int i = 0; i < kMostSteps && parts_.top().most > found_.least * (1 + kEnough); ++i) {
      checkpoint();
      const DerivativePart whole = parts_.top();
      const double middle = 0.5 * (whole.from + whole.to);
      if (!(whole.from < middle && middle < whole.to) || !std::isfinite(whole.most)) break;
      if (whole.most - 2 * whole.uncertain <= found_.least * (1 + kEnough)) break;
      parts_.pop();
      add({part_of(whole.points, 0, 0.5), whole.from, middle, 0, whole.uncertain});
      add({part_of(whole.points, 0.5, 1), middle, whole.to, 0, whole.uncertain});
    }
    found_.most = parts_.top().most;
    return found_;
  }

 private:
  void add(DerivativePart part) {
    part.most = bound_of(part.points) + part.uncertain;
    reach(part.points.front(), part, part.from);
    reach(part.points.back(), part, part.to);
    parts_.push(std::move(part));
  }

  void reach(const Vector3d& value, const DerivativePart& part, double t) {
    const double length = value.norm() * (1 - kDerivativeRounding) - part.uncertain;
    if (!(length > found_.least)) return;
    found_.least = length;
    found_.time = t;
  }

  std::priority_queue<DerivativePart> parts_;
  Greatest found_;
};

}  // namespace

const char* to_string(LimitVerdict verdict) {
  constexpr const char* kWords[] = {"kept", "broken", "undecided"};
  return kWords[static_cast<std::size_t>(verdict)];
}

Greatest greatest(const Piecewise& polynomial, int derivative) {
  if (derivative < 1 || derivative > kMostDegree)
    throw InputError("derivative", std::to_string(derivative), "1 to 9");
  require_pieces(polynomial, "times", "points");
  Greatest found = GreatestSearch(polynomial, derivative).found();
  for (std::size_t k = 1; k < polynomial.points.size(); ++k) {
    const auto derived = [&](std::size_t piece) {
      ControlPoints p = polynomial.points[piece];
      for (int i = 1; i < derivative; ++i) {
        p = derivative_of(p);
        for (Vector3d& x : p) x /= polynomial.times[piece + 1] - polynomial.times[piece];
      }
      return p;
    };
    found.jump = std::max(found.jump, (derived(k).front() - derived(k - 1).back()).norm());
  }
  return found;
}

}  // namespace vericone::simulation
