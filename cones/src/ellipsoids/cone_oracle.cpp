// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/geometry/exact/body.h>
#include <vericone/geometry/exact/quadric_side.h>

#include <vericone/cones/ellipsoids/contact_frame.h>
#include <vericone/cones/ellipsoids/exact_predicates.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/interval.h>
#include <vericone/geometry/tracked.h>
#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "answers/elementary.h"
#include "answers/velocity_ladder.h"
#include "ellipsoids/contact_polynomial.h"
#include "ellipsoids/pair_on_grid.h"

namespace vericone {
namespace {

// Roundings of the inputs of the first rung. c: 1 (difference of the centres). S: 3 (three products of
// factors summed). u, v = w_i / w_k, w_j / w_k: 3 (two differences of velocities, the quotient). The normal
// is taken as it is.
constexpr RoundingCount kCenter{1}, kShape{3}, kSlope{3}, kNormal{0};

/// Roundings on the way to the quantities of the first rung, from the formulas themselves.
constexpr auto kCount = [] {
  struct Counts {
    RoundingCount ahead, k1, k2, discriminant;
  };
  const auto s = [](int, int) { return kShape; };
  const ContactCubic<RoundingCount> cubic(affine_shadow<RoundingCount>(s, kSlope, kSlope, 0, 1, 2),
                                          affine_shadow<RoundingCount>(s, kSlope, kSlope, 0, 1, 2),
                                          kCenter + kSlope * kCenter, kCenter + kSlope * kCenter);
  return Counts{kNormal * kSlope + kNormal * kSlope + kNormal, cubic.k1, cubic.k2, cubic.discriminant()};
}();
// Products below the smallest normal number lose more than a relative rounding. Inputs are scaled so that no
// intermediate factor exceeds about 2^150, hence all such losses together stay far below this.
constexpr double kUnderflowBound = 1e-250;

/// Position of entry (r, c) of a symmetric 3x3 matrix among its six.
constexpr int kPacked[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};

/// The coordinate to project along, that of the largest entry of w, and the two after it. No branches: the
/// directions of velocities are hard to predict.
struct DroppedAxis {
  int i, j, k;
  explicit DroppedAxis(const Eigen::Vector3d& w) {
    constexpr int kNext[] = {1, 2, 0, 1};
    const double x = std::abs(w.x()), y = std::abs(w.y()), z = std::abs(w.z());
    k = z > std::max(x, y) ? 2 : static_cast<int>(y > x);
    i = kNext[k];
    j = kNext[k + 1];
  }
};

}  // namespace

ConeOracle::ConeOracle(const Ellipsoid& a, const Ellipsoid& b) : a_(a), b_(b) {
  const ContactFrame<3> frame(a, b);
  relation_ = vericone::relation<3>(a, b, frame, &relation_rung_);
  if (relation_ == Relation::disjoint) {
    normal_ = frame.separating_normal();
    normal_certified_ = separates<3>(a, b, normal_);
    if (!normal_certified_) {
      // The bodies are closer than rounding: the exact maximiser, rounded, may do better.
      const exact::PairOnGrid<3> pair(a, b);
      const auto n =
          exact::contact_normal(pair, exact::between_positive_roots(exact::contact_polynomial<3>(pair), 0));
      const exact::Integer largest =
          std::max({exact::Integer(abs(n[0])), exact::Integer(abs(n[1])), exact::Integer(abs(n[2]))});
      for (int i = 0; i < 3; ++i)
        normal_(i) = static_cast<double>(exact::Integer((n[i] << 64) / largest)) * 0x1p-64;
      normal_certified_ = separates<3>(a, b, normal_);
    }
  }
  // Every velocity is in the cone of overlapping bodies: the rungs have nothing to prepare.
  if (relation_ == Relation::overlapping) return;
  // Powers of two: scaling is exact.
  const Eigen::Vector3d c = b.center() - a.center();
  const int e = binary_exponent(c.cwiseAbs().maxCoeff());
  if (std::abs(e) > 510) return;
  const double scale = std::ldexp(1.0, -e), scale2 = scale * scale;
  usable_ = true;
  const auto fill = [&](const Ellipsoid& body, double(Scaled::*entries)[6][2], Interval(&enclosed)[6]) {
    const Eigen::Matrix3d f = body.factor() * scale, f_abs = f.cwiseAbs();
    for (int row = 0; row < 3; ++row)
      for (int column = row; column < 3; ++column) {
        double value = body.shape()(row, column) * scale2, magnitude = std::abs(value);
        Interval& interval = enclosed[kPacked[row][column]];
        if (body.defined_by_factor()) {
          value = f.row(row).dot(f.row(column));
          magnitude = f_abs.row(row).dot(f_abs.row(column));
          interval = 0;
          for (int k = 0; k < 3; ++k) interval = interval + Interval(f(row, k)) * Interval(f(column, k));
        } else {
          interval = Interval(value, Interval::kTiny);
        }
        for (int k = 0; k < 3; ++k) {
          auto& entry = (scaled_[k].*entries)[kPacked[(row + 2 - k) % 3][(column + 2 - k) % 3]];
          entry[0] = value;
          entry[1] = magnitude;
        }
        usable_ = usable_ && magnitude < 0x1p20 && (row != column || magnitude > 1e-40);
      }
  };
  fill(a, &Scaled::shape_a, enclosed_.shape_a);
  fill(b, &Scaled::shape_b, enclosed_.shape_b);
  for (int i = 0; i < 3; ++i)
    enclosed_.c[i] = Interval(b.center()(i) * scale) - Interval(a.center()(i) * scale);
  for (int k = 0; k < 3; ++k)
    for (int r = 0; r < 3; ++r) {
      const int row = (k + 1 + r) % 3;
      scaled_[k].c[r][0] = c(row) * scale;
      scaled_[k].c[r][1] = std::abs(c(row)) * scale;
      scaled_[k].normal[r][0] = r < 2 ? -normal_(row) : normal_(row);
      scaled_[k].normal[r][1] = std::abs(normal_(row));
    }
}

std::optional<Membership> ConeOracle::triage_membership(const Eigen::Vector3d& w) const noexcept {
  const DroppedAxis axis(w);
  const double wk = w(axis.k);
  if (!(std::abs(wk) > 0 && std::abs(wk) <= std::numeric_limits<double>::max() && usable_)) {
    if (w.x() == 0 && w.y() == 0 && w.z() == 0) return Membership::out;
    if (relation_ == Relation::overlapping && w.allFinite()) return Membership::in;
    return std::nullopt;
  }
  const Scaled& scaled = scaled_[axis.k];
  const Tracked::Pair quotients = Tracked::Pair{w(axis.i), w(axis.j)} / Tracked::Pair{wk, wk};
  const Tracked minus_u = Tracked::minus(quotients[0]), minus_v = Tracked::minus(quotients[1]);
  // The side of a plane that separates the bodies: K lies on the positive one.
  const auto n = [&scaled](int r) { return Tracked::of(scaled.normal[r]); };
  const Tracked height = n(0) * minus_u + n(1) * minus_v + n(2);
  const int ahead = normal_certified_ ? (wk > 0 ? 1 : -1) * height.certain(kCount.ahead, kUnderflowBound) : 0;
  if (ahead < 0) return Membership::out;

  const auto a = [&scaled](int r, int col) { return Tracked::of(scaled.shape_a[kPacked[r][col]]); };
  const auto b = [&scaled](int r, int col) { return Tracked::of(scaled.shape_b[kPacked[r][col]]); };
  const auto c = [&scaled](int r) { return Tracked::of(scaled.c[r]); };
  const ContactCubic<Tracked> cubic(affine_shadow<Tracked>(a, minus_u, minus_v, 0, 1, 2),
                                    affine_shadow<Tracked>(b, minus_u, minus_v, 0, 1, 2),
                                    c(0) + minus_u * c(2), c(1) + minus_v * c(2));
  const int discriminant = cubic.discriminant().certain(kCount.discriminant, kUnderflowBound);
  const int k1 = cubic.k1.certain(kCount.k1, kUnderflowBound),
            k2 = cubic.k2.certain(kCount.k2, kUnderflowBound);
  // No sign change in the coefficients, no positive root, whatever the discriminant: bodies that meet head
  // on.
  const bool apart = (discriminant > 0) & ((k1 > 0) | (k2 > 0));
  const bool meets = (ahead > 0) & ((discriminant < 0) | ((k1 < 0) & (k2 < 0)));
  if (!(apart | meets)) return std::nullopt;
  return apart ? Membership::out : Membership::in;
}

Membership ConeOracle::naive_membership(const Eigen::Vector3d& w) const noexcept {
  const DroppedAxis axis(w);
  const Scaled& scaled = scaled_[axis.k];
  const double minus_u = -w(axis.i) / w(axis.k), minus_v = -w(axis.j) / w(axis.k);
  const auto a = [&scaled](int r, int col) { return scaled.shape_a[kPacked[r][col]][0]; };
  const auto b = [&scaled](int r, int col) { return scaled.shape_b[kPacked[r][col]][0]; };
  const auto c = [&scaled](int r) { return scaled.c[r][0]; };
  const ContactCubic<double> cubic(affine_shadow<double>(a, minus_u, minus_v, 0, 1, 2),
                                   affine_shadow<double>(b, minus_u, minus_v, 0, 1, 2), c(0) + minus_u * c(2),
                                   c(1) + minus_v * c(2));
  const double d = cubic.discriminant();
  if (d > 0 && (cubic.k1 > 0 || cubic.k2 > 0)) return Membership::out;
  if (!(normal_.dot(w) > 0))
    return relation_ == Relation::overlapping && !w.isZero(0) ? Membership::in : Membership::out;
  return d == 0 ? Membership::on : Membership::in;
}

std::optional<Membership> ConeOracle::interval_membership(const Eigen::Vector3d& v_a,
                                                          const Eigen::Vector3d& v_b) const noexcept {
  std::array<Interval, 3> w;
  for (int i = 0; i < 3; ++i) w[i] = Interval(v_a(i)) - Interval(v_b(i));
  return interval_membership(w);
}

std::optional<Membership> ConeOracle::interval_membership(const std::array<Interval, 3>& w) const noexcept {
  const DroppedAxis axis({w[0].mid(), w[1].mid(), w[2].mid()});
  const Interval& wk = w[axis.k];
  if (wk.sign() == FilteredSign::uncertain) return std::nullopt;
  if (!usable_) return relation_ == Relation::overlapping ? std::optional(Membership::in) : std::nullopt;
  const Interval minus_u = -w[axis.i] / wk, minus_v = -w[axis.j] / wk;
  int ahead = 0;
  if (normal_certified_) {
    const Interval height =
        Interval(normal_(axis.k)) - Interval(normal_(axis.i)) * minus_u - Interval(normal_(axis.j)) * minus_v;
    const int side = static_cast<int>(height.positive()) - static_cast<int>(height.negative());
    ahead = wk.positive() ? side : -side;
  }
  if (ahead < 0) return Membership::out;
  const auto a = [this](int r, int col) { return enclosed_.shape_a[kPacked[r][col]]; };
  const auto b = [this](int r, int col) { return enclosed_.shape_b[kPacked[r][col]]; };
  const auto& c = enclosed_.c;
  const ContactCubic<Interval> cubic(affine_shadow<Interval>(a, minus_u, minus_v, axis.i, axis.j, axis.k),
                                     affine_shadow<Interval>(b, minus_u, minus_v, axis.i, axis.j, axis.k),
                                     c[axis.i] + minus_u * c[axis.k], c[axis.j] + minus_v * c[axis.k]);
  const Interval discriminant = cubic.discriminant();
  if (discriminant.positive() && (cubic.k1.positive() || cubic.k2.positive())) return Membership::out;
  const bool meets = discriminant.negative() || (cubic.k1.negative() && cubic.k2.negative());
  if (ahead > 0 && meets) return Membership::in;
  return std::nullopt;
}

namespace {

/// Membership of w != 0 by the signs of theory.md, 2. `side`: the sign of n.w for any n that separates
/// disjoint bodies strictly; for others as side_of_contact().
template <typename Side>
Membership decide_exactly(const exact::PairOnGrid<3>& pair, const exact::IntegerVector<3>& w,
                          const Side& side) {
  using exact::Integer;
  const int k = w[0] != 0 ? 0 : w[1] != 0 ? 1 : 2, i = (k + 1) % 3, j = (k + 2) % 3;
  const auto entry = [](const exact::IntegerMatrix<3>& s) {
    return [&s](int r, int col) -> const Integer& { return s[r][col]; };
  };
  const auto ma = shadow<Integer>(entry(pair.a), w[i], w[j], w[k], i, j, k);
  const auto mb = shadow<Integer>(entry(pair.b), w[i], w[j], w[k], i, j, k);
  const ContactCubic<Integer> cubic(ma, mb, w[k] * pair.c[i] - w[i] * pair.c[k],
                                    w[k] * pair.c[j] - w[j] * pair.c[k]);
  const int discriminant = cubic.discriminant().sign();
  const bool positive_pair = cubic.k1 > 0 || cubic.k2 > 0;
  if (discriminant > 0 && positive_pair) return Membership::out;
  // The line meets K; on which side of the origin?
  const std::optional<int> ahead = side();
  if (!ahead) return Membership::in;
  if (*ahead < 0) return Membership::out;
  return discriminant == 0 && positive_pair ? Membership::on : Membership::in;
}

bool is_zero(const exact::IntegerVector<3>& w) { return w[0] == 0 && w[1] == 0 && w[2] == 0; }

}  // namespace

Membership ConeOracle::exact_membership(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) const {
  require_finite_velocity(v_a, "agent_velocity");
  require_finite_velocity(v_b, "obstacle_velocity");
  const auto w = exact::difference_on_grid<3>(v_a, v_b);
  if (is_zero(w)) return Membership::out;
  if (relation_ == Relation::overlapping) return Membership::in;
  const exact::PairOnGrid<3> pair(a_, b_);
  return decide_exactly(pair, w, [&]() -> std::optional<int> {
    if (!normal_certified_) return exact::side_of_contact<3>(pair, w);
    const auto n = exact::direction_on_grid<3>(normal_);
    return exact::Integer(n[0] * w[0] + n[1] * w[1] + n[2] * w[2]).sign();
  });
}

namespace exact {

Membership membership(const RationalBody<3>& a, const RationalBody<3>& b, const RationalVector<3>& w) {
  const IntegerVector<3> direction = direction_on_grid<3>(w);
  if (is_zero(direction)) return Membership::out;
  const PairOnGrid<3> pair(a, b);
  return decide_exactly(pair, direction, [&] { return side_of_contact<3>(pair, direction); });
}

}  // namespace exact

Membership ConeOracle::membership(const Eigen::Vector3d& w, Rung* rung) const {
  return climb_membership<ConeMembership>(*this, w, Eigen::Vector3d(Eigen::Vector3d::Zero()), rung);
}

Membership ConeOracle::membership(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b, Rung* rung) const {
  return climb_membership<ConeMembership>(*this, v_a, v_b, rung);
}

Passage ConeOracle::passage(const Eigen::Vector3d& w) const { return passage_by_membership(*this, w); }

Verdict ConeOracle::verdict(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b, Rung* rung) const {
  return verdict_of(relation_, [&] { return membership(v_a, v_b, rung); });
}

}  // namespace vericone
