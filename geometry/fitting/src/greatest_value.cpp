// SPDX-License-Identifier: BSD-3-Clause
#include "greatest_value.h"

#include <vericone/geometry/error.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "ball_bound.h"
#include "triangle_form.h"

namespace vericone::fitting {
namespace {

using exact::Rational;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Exact evaluations before intervals are taken at their word; some microseconds each.
constexpr int kMostExact = 5000;

double upper(const Interval& x) { return x.finite() ? x.hi() : kInfinity; }
double lower(const Interval& x) { return x.finite() ? x.lo() : -kInfinity; }

struct Candidate {
  double bound = 0;  // not below its greatest value
  bool triangle = false;
  std::uint32_t index = 0;
};

class Search {
 public:
  Search(const QuadraticForm& form, const Sample& sample) : form_(form), sample_(sample) {}

  void add_point(std::uint32_t i) {
    const Interval value = form_.at(sample_.points[i]).value;
    add({upper(value), false, i}, lower(value));
  }

  /// A form l^T C l with l >= 0, sum 1, is at most its largest entry, and the corners are values.
  void add_triangle(std::uint32_t t) {
    std::array<QuadraticForm::At, 3> at;
    for (std::size_t i = 0; i < 3; ++i) at[i] = form_.at(sample_.points[sample_.triangles[t][i]]);
    double most = -kInfinity, least = -kInfinity;
    for (std::size_t i = 0; i < 3; ++i) {
      most = std::max({most, upper(at[i].value), upper(QuadraticForm::polar(at[i], at[(i + 1) % 3]))});
      least = std::max(least, lower(at[i].value));
    }
    add({most, true, t}, least);
  }

  /// Largest bound first, until no other can exceed the best.
  std::optional<Rational> greatest() {
    std::erase_if(candidates_, [&](const Candidate& c) { return c.bound < certain_; });
    std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& x, const Candidate& y) {
      return std::tuple(-x.bound, x.triangle, x.index) < std::tuple(-y.bound, y.triangle, y.index);
    });
    std::optional<Rational> best;
    int exact = 0;
    for (const Candidate& c : candidates_) {
      if (best && c.bound < kInfinity && Rational(c.bound) <= *best) break;
      if (exact++ >= kMostExact && c.bound < kInfinity) return Rational(c.bound);
      const Rational value = c.triangle ? triangle_value(c.index) : point_value(c.index);
      if (!best || value > *best) best = value;
    }
    return best;
  }

 private:
  void add(const Candidate& c, double least) {
    certain_ = std::max(certain_, least);
    if (c.bound >= certain_) candidates_.push_back(c);
  }

  Rational point_value(std::uint32_t i) const {
    const auto p = form_.exact_polars<1>({sample_.points[i]});
    return form_.number(p.form[0][0], p.exponent);
  }

  Rational triangle_value(std::uint32_t t) const {
    const auto& [a, b, c] = sample_.triangles[t];
    const auto p = form_.exact_polars<3>({sample_.points[a], sample_.points[b], sample_.points[c]});
    exact::RationalMatrix<3> m;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) m[i][j] = form_.number(p.form[i][j], p.exponent);
    return fitting::greatest_value(m);
  }

  const QuadraticForm& form_;
  const Sample& sample_;
  std::vector<Candidate> candidates_;
  double certain_ = -kInfinity;  // some value is at least this
};

}  // namespace

std::optional<Rational> greatest_value(const QuadraticForm& form, const Sample& sample,
                                       const Contents& contents, double radius) {
  Search search(form, sample);
  double balls = -kInfinity;
  if (radius > 0) {
    const BallBound bound(form);
    for (const std::uint32_t i : contents.points)
      balls = std::max(balls, bound.greatest_value(form.at(sample.points[i]), radius));
    if (balls == kInfinity)
      throw InputError("margin", to_text(radius), "of the order of the points' extent (metres)");
  } else {
    for (const std::uint32_t i : contents.points) search.add_point(i);
  }
  for (const std::uint32_t t : contents.triangles) {
    if (!form.convex()) {
      search.add_triangle(t);
      continue;
    }
    for (const std::uint32_t i : sample.triangles[t]) search.add_point(i);
  }
  std::optional<Rational> best = search.greatest();
  if (std::isfinite(balls) && (!best || *best < Rational(balls))) best = Rational(balls);
  return best;
}

}  // namespace vericone::fitting
