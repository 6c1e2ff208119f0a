// SPDX-License-Identifier: BSD-3-Clause
#include "proof/piece_check.h"

#include <algorithm>
#include <limits>

namespace vericone::fitting {

PieceCheck::PieceCheck(const std::vector<Quadric>& quadrics, const Eigen::Vector3d& near) {
  for (const Quadric& q : quadrics) {
    forms_.emplace_back(q, near);
    balls_.emplace_back(forms_.back());
    convex_ = convex_ && forms_.back().convex();
  }
}

Known PieceCheck::contains(const Eigen::Vector3d& x) const {
  Known all = Known::yes;
  for (const QuadraticForm& form : forms_) {
    Interval value = form.at(x).value;
    if (value.sign() == FilteredSign::uncertain) value = form.narrowly_at(x).value;
    if (value.finite() && value.positive()) return Known::no;
    if (!value.finite() || !(value.mid() <= -value.rad())) all = Known::unsure;
  }
  return all;
}

bool PieceCheck::contains_exactly(const Eigen::Vector3d& x) const {
  return std::all_of(forms_.begin(), forms_.end(),
                     [&](const QuadraticForm& form) { return form.exact_sign(x) <= 0; });
}

Known PieceCheck::contains(const Corners& corners) const {
  Known all = Known::yes;
  for (const QuadraticForm& form : forms_) {
    if (form.convex()) continue;
    const std::array<QuadraticForm::At, 3> at{form.at(corners[0]), form.at(corners[1]), form.at(corners[2])};
    std::array<std::array<Interval, 3>, 3> c;
    for (std::size_t i = 0; i < 3; ++i) {
      c[i][i] = at[i].value;
      for (std::size_t j = 0; j < i; ++j) c[i][j] = c[j][i] = QuadraticForm::polar(at[i], at[j]);
    }
    const Known one = not_positive(c);
    if (one == Known::no) return one;
    if (one == Known::unsure) all = one;
  }
  return all;
}

bool PieceCheck::contains_exactly(const Corners& corners) const {
  return std::all_of(forms_.begin(), forms_.end(), [&](const QuadraticForm& form) {
    return form.convex() || not_positive(form.exact_polars<3>(corners).form) == Known::yes;
  });
}

bool PieceCheck::contains_ball(const Eigen::Vector3d& x, double radius) const {
  for (std::size_t i = 0; i < forms_.size(); ++i)
    if (!(balls_[i].greatest_value(forms_[i].narrowly_at(x), radius) <= 0)) return false;
  return true;
}

double PieceCheck::value(const Eigen::Vector3d& x) const {
  double largest = -std::numeric_limits<double>::infinity();
  for (const QuadraticForm& form : forms_)
    if (form.depth() > 0) largest = std::max(largest, form.approximately(x) / form.depth());
  return largest;
}

}  // namespace vericone::fitting
