// SPDX-License-Identifier: BSD-3-Clause
#include "times/contact_time_search.h"

#include <vericone/cones/cone_geometry.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/internal/cones/ellipsoids/contact_frame.h>
#include <cmath>
#include <limits>

namespace vericone {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using When = ContactTimeBounds::When;

Interval dot(const std::array<Interval, 3>& x, const Vector3d& y) {
  return x[0] * Interval(y(0)) + x[1] * Interval(y(1)) + x[2] * Interval(y(2));
}

/// A square factor with the shape of a 2x3 one, by Gram-Schmidt on the rows.
Matrix2d square_factor(const Eigen::Matrix<double, 2, 3>& f) {
  const double l11 = f.row(0).norm(), l21 = f.row(1).dot(f.row(0)) / l11;
  Matrix2d l;
  l << l11, 0, l21, (f.row(1) - (l21 / l11) * f.row(0)).norm();
  return l;
}

/// x 2^e, rounded outwards where it is not exact.
double scaled_outwards(double x, int e, double towards) {
  const double y = std::ldexp(x, e);
  return std::abs(y) >= std::numeric_limits<double>::min() || x == 0 ? y : std::nextafter(y, towards);
}

}  // namespace

ContactTimeSearch::ContactTimeSearch(const Ellipsoid& a, const Ellipsoid& b,
                                     const std::array<Interval, 3>& w) noexcept
    : pair_(a, b), w_(w) {
  double largest = 0;
  for (const Interval& x : w) {
    if (!x.finite()) return;
    largest = std::max(largest, std::abs(x.mid()));
  }
  if (!pair_.usable) return;
  if (largest > 0) {
    speed_exponent_ = std::ilogb(largest) + 1;
    for (int i = 0; i < 3; ++i) {
      w_[i] = w[i].rad() == 0 ? scaled_down(w[i].mid(), speed_exponent_) : scaled_down(w[i], speed_exponent_);
      w_mid_(i) = w_[i].mid();
    }
  }
  search(a, b);
}

bool ContactTimeSearch::never_by(const Vector3d& n) const {
  return dot(w_, n).hi() <= 0 && pair_.gap(n).positive();
}

void ContactTimeSearch::search(const Ellipsoid& a, const Ellipsoid& b) {
  const ContactFrame<3> frame(pair_.factor_a, pair_.factor_b, pair_.center_line);
  if (!(frame.contact > 1)) {
    if (triage_relation<3>(a, b, ContactFrame<3>(a, b)) == Relation::overlapping)
      settled_ = ContactTimeBounds{When::now};
    return;
  }
  Vector3d n = frame.separating_normal().normalized();
  if (never_by(n)) {
    settled_ = ContactTimeBounds{When::never};
    return;
  }
  if (w_mid_.isZero(0)) return;

  const AxisFrame axes(w_mid_);
  Eigen::Matrix<double, 2, 3> across;
  across << axes.e1.transpose(), axes.e2.transpose();
  const ContactFrame<2> shadows(square_factor(across * pair_.factor_a),
                                square_factor(across * pair_.factor_b), across * pair_.center_line);
  if (shadows.contact > 1) {
    n = (across.transpose() * shadows.separating_normal()).normalized();
    // Tilted against w by less than the gap allows.
    const double reach = pair_.center_line.norm() + pair_.factor_a.norm() + pair_.factor_b.norm();
    n -= 0.5 * pair_.gap(n).mid() / reach * axes.axis;
    if (never_by(n)) settled_ = ContactTimeBounds{When::never};
    return;
  }

  const double time =
      std::ldexp(contact_time(a, b,
                              {std::ldexp(w_mid_(0), speed_exponent_), std::ldexp(w_mid_(1), speed_exponent_),
                               std::ldexp(w_mid_(2), speed_exponent_)}),
                 speed_exponent_ - pair_.exponent);
  n = ContactFrame<3>(pair_.factor_a, pair_.factor_b, pair_.center_line - time * w_mid_)
          .separating_normal()
          .normalized();
  if (!n.allFinite() || !dot(w_, n).positive()) return;
  least_ = pair_.gap(n) / dot(w_, n);
  const auto at_a = pair_.a.support(n), at_b = pair_.b.support(n);
  for (int i = 0; i < 3; ++i) {
    support_a_[i] = at_a.shape_times_n[i] / at_a.rho;
    support_b_[i] = at_b.shape_times_n[i] / at_b.rho;
  }
  crossing_ =
      std::max(std::abs(least_.mid()), (pair_.factor_a.norm() + pair_.factor_b.norm()) / w_mid_.norm());
  hit_ = least_.positive() && std::isfinite(crossing_);
}

bool ContactTimeSearch::surely_touching(double time) const {
  // c - w t = alpha + beta with alpha in A's shape and beta in B's: one is the supporting point.
  std::array<Interval, 3> for_a, for_b;
  for (int i = 0; i < 3; ++i) {
    const Interval z = pair_.c[i] - Interval(time) * w_[i];
    for_a[i] = z - support_b_[i];
    for_b[i] = z - support_a_[i];
  }
  return pair_.a.surely_contains(for_a) || pair_.b.surely_contains(for_b);
}

std::optional<ContactTimeBounds> ContactTimeSearch::bounds(double spread, double widest) const noexcept {
  if (settled_) return settled_;
  if (!hit_) return std::nullopt;
  const int e = pair_.exponent - speed_exponent_;
  for (; spread <= widest; spread *= 8) {
    const double hi = least_.hi() + spread * crossing_;
    if (!surely_touching(hi)) continue;
    const ContactTimeBounds found{When::later, scaled_outwards(least_.lo(), e, 0),
                                  scaled_outwards(hi, e, std::numeric_limits<double>::infinity())};
    if (found.lo > 0 && std::isfinite(found.hi)) return found;
    break;
  }
  return std::nullopt;
}

}  // namespace vericone
