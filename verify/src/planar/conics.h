// SPDX-License-Identifier: GPL-3.0-or-later
//
// Planar combined quadrics over any number type of CGAL's, with answers that may be "unknown" where the type
// is an interval.
#pragma once

#include <CGAL/CORE_Expr.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Interval_nt.h>
#include <vericone/geometry/combined.h>

#include <stdexcept>
#include <vector>

#include "wide_interval.h"

namespace vericone::verify::planar {

using Interval = CGAL::Interval_nt<false>;  // wants Interval::Protector around its use
using Exact = CORE::Expr;
using Rational = CGAL::Exact_rational;

enum class Answer { no, unknown, yes };
inline Answer both(Answer x, Answer y) { return x < y ? x : y; }
inline Answer either(Answer x, Answer y) { return x > y ? x : y; }

inline Answer positive(const Interval& x) {
  return x.inf() > 0 ? Answer::yes : x.sup() <= 0 ? Answer::no : Answer::unknown;
}
inline Answer not_positive(const Interval& x) {
  return x.sup() <= 0 ? Answer::yes : x.inf() > 0 ? Answer::no : Answer::unknown;
}
inline Answer positive(const WideInterval& x) {
  return x.certain_sign() > 0 ? Answer::yes : x.certainly_not_positive() ? Answer::no : Answer::unknown;
}
inline Answer not_positive(const WideInterval& x) {
  return x.certainly_not_positive() ? Answer::yes : x.certain_sign() > 0 ? Answer::no : Answer::unknown;
}
inline Answer positive(const Exact& x) { return x.sign() > 0 ? Answer::yes : Answer::no; }
inline Answer not_positive(const Exact& x) { return x.sign() <= 0 ? Answer::yes : Answer::no; }

/// For a root of what is not negative where it matters.
inline Interval root(const Interval& x) {
  return CGAL::sqrt(Interval(std::max(x.inf(), 0.0), std::max(x.sup(), 0.0)));
}
inline Exact root(const Exact& x) { return x.sign() <= 0 ? Exact(0) : sqrt(x); }

/// A hint only.
inline bool looks_negative(const Interval& x) { return x.inf() + x.sup() < 0; }
inline bool looks_negative(const WideInterval& x) { return x.middle() < 0; }
inline bool looks_negative(const Exact& x) { return x.sign() < 0; }

template <class N>
struct Point {
  N x, y;
};

/// { xx x^2 + 2 xy x y + yy y^2 <= level }, about the body's centre.
template <class N>
struct Conic {
  N xx, xy, yy, level;

  N form(const Point<N>& p, const Point<N>& q) const {
    return N(xx * p.x * q.x + xy * (p.x * q.y + p.y * q.x) + yy * p.y * q.y);
  }
  N square(const Point<N>& p) const { return N(xx * p.x * p.x + N(2) * xy * p.x * p.y + yy * p.y * p.y); }
  N determinant() const { return xx * yy - xy * xy; }
};

/// With |adj(F) y|^2 <= det(F)^2 for a factor, y^T adj(S) y <= det S for a shape.
template <class N>
std::vector<Conic<N>> conics(const CombinedEllipse& body) {
  std::vector<Conic<N>> all;
  const Ellipse& e = body.ellipsoid();
  if (e.defined_by_factor()) {
    const N a = e.factor()(0, 0), b = e.factor()(0, 1), c = e.factor()(1, 0), d = e.factor()(1, 1);
    const N det = a * d - b * c;
    all.push_back({d * d + c * c, N(0) - d * b - c * a, b * b + a * a, det * det});
  } else {
    const N a = e.shape()(0, 0), b = e.shape()(0, 1), d = e.shape()(1, 1);
    all.push_back({d, N(0) - b, a, a * d - b * b});
  }
  for (const auto& delimiter : body.delimiters())
    all.push_back({N(delimiter.matrix(0, 0)), N(delimiter.matrix(0, 1)), N(delimiter.matrix(1, 1)),
                   N(delimiter.level)});
  return all;
}

/// Coordinates in which two bodies are easy for intervals: any linear map will do, so this one is rounded
/// freely; what is mapped by it is mapped without rounding until it is enclosed.
class Map {
 public:
  explicit Map(const Eigen::Matrix2d& to_space)
      : p_(to_space(0, 0)), q_(to_space(0, 1)), r_(to_space(1, 0)), s_(to_space(1, 1)) {}

  std::vector<Conic<Interval>> conics(const CombinedEllipse& body) const {
    std::vector<Conic<Interval>> all;
    for (const auto& c : planar::conics<Rational>(body))
      all.push_back({enclosed(c.square({p_, r_})), enclosed(c.form({p_, r_}, {q_, s_})),
                     enclosed(c.square({q_, s_})), enclosed(c.level)});
    return all;
  }
  Point<Interval> vector(const Rational& x, const Rational& y) const {
    const Rational det = p_ * s_ - q_ * r_;
    return {enclosed((s_ * x - q_ * y) / det), enclosed((p_ * y - r_ * x) / det)};
  }

 private:
  static Interval enclosed(const Rational& x) { return CGAL::to_interval(x); }
  Rational p_, q_, r_, s_;
};

/// Whether a point is in all regions but those of two conics, on which it is known to be.
template <class N>
Answer in_others(const std::vector<Conic<N>>& conics, const Point<N>& p, int i, int j) {
  Answer answer = Answer::yes;
  for (int k = 0; k < static_cast<int>(conics.size()) && answer != Answer::no; ++k)
    if (k != i && k != j) answer = both(answer, not_positive(conics[k].square(p) - conics[k].level));
  return answer;
}

/// A point that belongs to the body if `on_body` says so.
template <class N>
struct Candidate {
  Point<N> point;
  Answer on_body;
  int first, second;
};

/// Where two of the conics cross: on both level_i C_j - level_j C_i vanishes, which gives the direction.
template <class N>
std::vector<Candidate<N>> crossings(const std::vector<Conic<N>>& conics) {
  std::vector<Candidate<N>> all;
  const int count = static_cast<int>(conics.size());
  for (int i = 0; i < count; ++i)
    for (int j = i + 1; j < count; ++j) {
      const Conic<N>&c = conics[i], &d = conics[j];
      const N hxx = c.level * d.xx - d.level * c.xx, hxy = c.level * d.xy - d.level * c.xy,
              hyy = c.level * d.yy - d.level * c.yy;
      const N discriminant = hxy * hxy - hxx * hyy;
      const Answer crosses = positive(discriminant);
      if (crosses == Answer::no) continue;
      const N s = root(discriminant);
      const N q = looks_negative(hxy) ? s - hxy : N(0) - s - hxy;
      for (const Point<N>& u : {Point<N>{q, hxx}, Point<N>{hyy, q}}) {
        // The level of one of them is positive: two of level 0 cross at the centre only.
        Answer there = crosses;
        const bool by_first = positive(c.level) == Answer::yes;
        const Conic<N>& by = by_first ? c : d;
        if (positive(by.level) != Answer::yes) continue;
        const N value = by.square(u);
        there = both(there, positive(value));
        if (there == Answer::no) continue;
        if (there == Answer::unknown && positive(value) == Answer::unknown)
          throw std::domain_error("a corner that intervals cannot tell");
        const N r = root(N(by.level / value));
        const Point<N> p{r * u.x, r * u.y};
        there = both(there, in_others(conics, p, i, j));
        if (there == Answer::no) continue;
        all.push_back({p, there, i, j});
        all.push_back({{N(0) - p.x, N(0) - p.y}, there, i, j});
      }
    }
  return all;
}

}  // namespace vericone::verify::planar
