// SPDX-License-Identifier: BSD-3-Clause
//
// The boundary of a combined quadric where its ellipsoid is the unit ball: r(u) = min_i sqrt(level_i / u.A_i
// u) over the forms with u.A_i u > 0, form 0 being the ball.
#pragma once

#include <vericone/geometry/combined.h>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace vericone::forms {

template <int D>
struct Form {
  Eigen::Matrix<double, D, D> matrix = Eigen::Matrix<double, D, D>::Identity();
  double level = 1;

  double operator()(const Eigen::Matrix<double, D, 1>& u) const { return u.dot(matrix * u); }
};

template <int D>
std::vector<Form<D>> whitened_forms(const BasicCombined<D>& body) {
  std::vector<Form<D>> all(1);
  const auto& f = body.ellipsoid().factor();
  for (const Delimiter<D>& d : body.delimiters()) {
    const Eigen::Matrix<double, D, D> m = f.transpose() * d.matrix * f;
    all.push_back({0.5 * (m + m.transpose()), d.level});
  }
  return all;
}

/// q_m level_l - q_l level_m: positive where form m is nearer to the centre than the form l.
template <int D>
Form<D> difference(const Form<D>& m, const Form<D>& l) {
  return {m.matrix * l.level - l.matrix * m.level, 0};
}

/// The form that bounds the body in the direction u; the first of equals.
template <int D>
int active_form(const std::vector<Form<D>>& all, const Eigen::Matrix<double, D, 1>& u) {
  int best = 0;
  double value = all[0](u), level = all[0].level;
  for (int i = 1; i < static_cast<int>(all.size()); ++i) {
    const double q = all[static_cast<std::size_t>(i)](u), l = all[static_cast<std::size_t>(i)].level;
    if (q > 0 && q * level > value * l) {
      best = i;
      value = q;
      level = l;
    }
  }
  return best;
}

/// Real roots (x : y) of a x^2 + 2 b x y + c y^2 = 0, as directions.
struct Roots {
  int count = 0;
  Eigen::Vector2d direction[2];
};
inline Roots roots(double a, double b, double c) {
  Roots r;
  const double discriminant = b * b - a * c;
  if (!(discriminant > 0)) return r;
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  r.count = 2;
  r.direction[0] = {q, a};
  r.direction[1] = {c, q};
  return r;
}

}  // namespace vericone::forms
