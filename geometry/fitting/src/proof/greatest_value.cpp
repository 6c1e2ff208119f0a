// SPDX-License-Identifier: BSD-3-Clause
#include "proof/greatest_value.h"

#include <vericone/geometry/error.h>
#include <vericone/geometry/exact/rational.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "infinity.h"
#include "proof/ball_bound.h"
#include "proof/rational_quadric.h"
#include "proof/triangle_form.h"

namespace vericone::fitting {
namespace {

/// Exact evaluations, tens of microseconds each, before intervals are taken at their word where they are
/// within kClose of the truth, and anywhere.
constexpr int kMostExact = 200, kMostExactAnywhere = 5000;
constexpr double kClose = 0x1p-46;

double upper(const Interval& x) { return x.finite() ? x.hi() : kInfinity; }
double lower(const Interval& x) { return x.finite() ? x.lo() : -kInfinity; }

using Polars = std::array<std::array<Interval, 3>, 3>;

struct Place {
  double bound = 0;  // not below its greatest value
  std::uint32_t index = 0;

  bool operator<(const Place& other) const {
    return std::tuple(-bound, index) < std::tuple(-other.bound, other.index);
  }
};

/// Keeps what may exceed everything else; the largest bound first.
class Candidates {
 public:
  /// `least` is not above some value.
  void add(std::uint32_t index, double bound, double least) {
    certain_ = std::max(certain_, least);
    if (bound >= certain_) all_.push_back({bound, index});
  }

  const std::vector<Place>& sorted() {
    std::erase_if(all_, [&](const Place& c) { return c.bound < certain_; });
    std::sort(all_.begin(), all_.end());
    return all_;
  }

 private:
  std::vector<Place> all_;
  double certain_ = -kInfinity;
};

class Search {
 public:
  Search(const QuadraticForm& form, const Sample& sample) : form_(form), sample_(sample) {}

  void add_point(std::uint32_t i) {
    checkpoint();
    const Interval value = form_.narrowly_at(sample_.points[i]).value;
    points_.add(i, upper(value), lower(value));
  }

  /// A form l^T C l with l >= 0, sum 1, is at most its largest entry, and the corners are values.
  void add_triangle(std::uint32_t t) {
    checkpoint();
    const Polars c = polars(t);
    double most = -kInfinity, least = -kInfinity;
    for (std::size_t i = 0; i < 3; ++i) {
      most = std::max({most, upper(c[i][i]), upper(c[i][(i + 1) % 3])});
      least = std::max(least, lower(c[i][i]));
    }
    triangles_.add(t, most, least);
  }

  double greatest() { return greatest_on_triangles(greatest_at_points()); }

 private:
  /// Whether a bound that is higher than the best value by `above` is good enough.
  bool enough(int exact, double above, double best) const {
    return exact >=
           (above <= kClose * std::max(std::abs(best), form_.depth()) ? kMostExact : kMostExactAnywhere);
  }

  double greatest_at_points() {
    double best = -kInfinity;
    int exact = 0;
    for (const Place& c : points_.sorted()) {
      if (c.bound <= best) break;
      if (enough(exact++, c.bound - best, best) && c.bound < kInfinity) return c.bound;
      best = std::max(best, point_value(c.index));
    }
    return best;
  }

  double greatest_on_triangles(double best) {
    int exact = 0;
    for (const Place& c : triangles_.sorted()) {
      if (c.bound <= best) break;
      const Polars p = polars(c.index);
      if (at_most(p, best)) continue;
      // Above by roundings only, or by the little that the bound is?
      const double close = best + kClose * std::max(std::abs(best), form_.depth());
      if (exact >= kMostExact && at_most(p, close)) {
        best = close;
        continue;
      }
      if (enough(exact++, c.bound - best, best) && c.bound < kInfinity) return c.bound;
      best = std::max(best, triangle_value(c.index));
    }
    return best;
  }

  Polars polars(std::uint32_t t) const {
    std::array<QuadraticForm::At, 3> at;
    for (std::size_t i = 0; i < 3; ++i) at[i] = form_.at(sample_.points[sample_.triangles[t][i]]);
    Polars c;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j <= i; ++j) c[i][j] = c[j][i] = QuadraticForm::polar(at[i], at[j]);
    return c;
  }

  /// Whether intervals prove it of the whole triangle: l^T C l - bound (l_0 + l_1 + l_2)^2.
  static bool at_most(Polars c, double bound) {
    for (auto& row : c)
      for (Interval& x : row) x = x - Interval(bound);
    for (std::size_t i = 0; i < 3; ++i)
      if (!(c[i][i].finite() && c[i][i].mid() <= -c[i][i].rad())) return false;
    return not_positive(c) == Known::yes;
  }

  double point_value(std::uint32_t i) const {
    const auto p = form_.exact_polars<1>({sample_.points[i]});
    return rounded_up(form_.number(p.form[0][0], p.exponent));
  }

  double triangle_value(std::uint32_t t) const {
    const auto& [a, b, c] = sample_.triangles[t];
    const auto p = form_.exact_polars<3>({sample_.points[a], sample_.points[b], sample_.points[c]});
    exact::RationalMatrix<3> m;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) m[i][j] = form_.number(p.form[i][j], p.exponent);
    return rounded_up(fitting::greatest_value(m));
  }

  const QuadraticForm& form_;
  const Sample& sample_;
  Candidates points_, triangles_;
};

}  // namespace

double greatest_value(const QuadraticForm& form, const Sample& sample, const Contents& contents,
                      double radius) {
  Search search(form, sample);
  double balls = -kInfinity;
  if (radius > 0) {
    const BallBound bound(form);
    for (const std::uint32_t i : contents.points)
      balls = std::max(balls, bound.greatest_value(form.narrowly_at(sample.points[i]), radius));
    if (balls == kInfinity)
      throw InputError("margin", to_text(radius), "of the order of the points' extent (metres)");
  } else {
    for (const std::uint32_t i : contents.points) search.add_point(i);
  }
  for (const std::uint32_t i : contents.corners) search.add_point(i);
  if (!form.convex())
    for (const std::uint32_t t : contents.triangles) search.add_triangle(t);
  return std::max(balls, search.greatest());
}

}  // namespace vericone::fitting
