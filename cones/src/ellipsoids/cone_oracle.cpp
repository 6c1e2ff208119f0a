// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/geometry/exact/rational.h>

#include <vericone/cones/ellipsoids/exact_predicates.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/interval.h>
#include <vericone/internal/cones/ellipsoids/contact_frame.h>
#include <vericone/internal/cones/ellipsoids/rungs.h>
#include <vericone/internal/geometry/tracked.h>
#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "answers/elementary.h"
#include "answers/velocity_ladder.h"
#include "ellipsoids/contact_polynomial.h"
#include "ellipsoids/line_meets.h"
#include "ellipsoids/pair_on_grid.h"
#include "ellipsoids/velocity_forms.h"

namespace vericone {
namespace {

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

/// The six entries of a shape, each with the sum of the terms on absolute values, and as intervals.
struct ScaledShape {
  Tracked tracked[6];
  bool usable = true;

  const Tracked& operator()(int row, int column) const { return tracked[kPacked[row][column]]; }

  ScaledShape(const Ellipsoid& body, double scale, Interval (&enclosed)[6]) {
    const Eigen::Matrix3d f = body.factor() * scale, f_abs = f.cwiseAbs();
    for (int row = 0; row < 3; ++row)
      for (int column = row; column < 3; ++column) {
        double value = body.shape()(row, column) * (scale * scale), magnitude = std::abs(value);
        Interval& interval = enclosed[kPacked[row][column]];
        if (body.defined_by_factor()) {
          value = f.row(row).dot(f.row(column));
          magnitude = f_abs.row(row).dot(f_abs.row(column));
          interval = 0;
          for (int k = 0; k < 3; ++k) interval = interval + Interval(f(row, k)) * Interval(f(column, k));
        } else {
          interval = Interval(value, Interval::kTiny);
        }
        tracked[kPacked[row][column]] = Tracked::of(value, magnitude);
        usable = usable && magnitude < 0x1p20 && (row != column || magnitude > 1e-40);
      }
  }
};

}  // namespace

ConeOracle::ConeOracle(const Ellipsoid& a, const Ellipsoid& b) : a_(a), b_(b) {
  const ContactFrame<3> frame(a, b);
  relation_ = vericone::relation<3>(a, b, frame, &relation_rung_);
  reach_ = (frame.center_line.norm() + a.factor().norm() + b.factor().norm()) * (1 + 0x1p-40);
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
    if (const double room = triage_gap<3>(a, b, normal_); room > 0) {
      room_ = room * (1 - 0x1p-50);
      normal_size_ = normal_.cwiseAbs().sum();
    }
  }
  // Every velocity is in the cone of overlapping bodies: the rungs have nothing to prepare.
  if (relation_ == Relation::overlapping) return;
  // Powers of two: scaling is exact.
  const Eigen::Vector3d c = b.center() - a.center();
  const int e = binary_exponent(c.cwiseAbs().maxCoeff());
  if (std::abs(e) > 510) return;
  const double scale = std::ldexp(1.0, -e);
  const ScaledShape scaled_a(a, scale, enclosed_.shape_a), scaled_b(b, scale, enclosed_.shape_b);
  for (int i = 0; i < 3; ++i)
    enclosed_.c[i] = Interval(b.center()(i) * scale) - Interval(a.center()(i) * scale);
  usable_ = scaled_a.usable && scaled_b.usable;
  if (!usable_) return;
  forms_ = bounded_forms(
      scaled_a, scaled_b, [&](int i) { return Tracked::of(c(i) * scale); }, normal_, normal_certified_);
}

std::optional<Membership> ConeOracle::triage_membership(const Eigen::Vector3d& w) const noexcept {
  const auto side = certain_side(forms_, w);
  if (side == 0) return triage_rest(w);
  return membership_of(side);
}

std::optional<Membership> ConeOracle::triage_rest(const Eigen::Vector3d& w) const noexcept {
  const double largest = w.cwiseAbs().maxCoeff();
  if (!w.allFinite()) return std::nullopt;
  if (largest == 0) return Membership::out;
  if (relation_ == Relation::overlapping) return Membership::in;
  const int e = binary_exponent(largest);
  if (std::abs(e) < kMostExponent) return std::nullopt;
  // Far too fast or too slow: by a power of two. What is lost below the normal numbers counts as the forms'
  // own underflow does.
  const auto side = certain_side(forms_, w.unaryExpr([e](double x) { return std::ldexp(x, -e); }));
  return side == 0 ? std::nullopt : std::optional(membership_of(side));
}

Membership ConeOracle::naive_membership(const Eigen::Vector3d& w) const noexcept {
  const DroppedAxis axis(w);
  const double minus_u = -w(axis.i) / w(axis.k), minus_v = -w(axis.j) / w(axis.k);
  // The entries in the order ii, ij, ik, jj, jk, kk.
  constexpr int kOrder[3][3][3] = {{{3, 4, 1}, {4, 5, 2}, {1, 2, 0}},
                                   {{5, 2, 4}, {2, 0, 1}, {4, 1, 3}},
                                   {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}}};
  const auto& order = kOrder[axis.k];
  const auto a = [&](int r, int col) { return enclosed_.shape_a[order[r][col]].mid(); };
  const auto b = [&](int r, int col) { return enclosed_.shape_b[order[r][col]].mid(); };
  const auto c = [this](int r) { return enclosed_.c[r].mid(); };
  const ContactCubic<double> cubic(affine_shadow<double>(a, minus_u, minus_v, 0, 1, 2),
                                   affine_shadow<double>(b, minus_u, minus_v, 0, 1, 2),
                                   c(axis.i) + minus_u * c(axis.k), c(axis.j) + minus_v * c(axis.k));
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

namespace exact {

Membership line_meets(const PairOnGrid<3>& pair, const IntegerVector<3>& w) {
  const int k = w[0] != 0 ? 0 : w[1] != 0 ? 1 : 2, i = (k + 1) % 3, j = (k + 2) % 3;
  const auto entry = [](const IntegerMatrix<3>& s) {
    return [&s](int r, int col) -> const Integer& { return s[r][col]; };
  };
  const auto ma = shadow<Integer>(entry(pair.a), w[i], w[j], w[k], i, j, k);
  const auto mb = shadow<Integer>(entry(pair.b), w[i], w[j], w[k], i, j, k);
  const ContactCubic<Integer> cubic(ma, mb, w[k] * pair.c[i] - w[i] * pair.c[k],
                                    w[k] * pair.c[j] - w[j] * pair.c[k]);
  const int discriminant = cubic.discriminant().sign();
  if (discriminant < 0 || !(cubic.k1 > 0 || cubic.k2 > 0)) return Membership::in;
  return discriminant > 0 ? Membership::out : Membership::on;
}

}  // namespace exact

namespace {

/// Membership of w != 0. `side`: the sign of n.w for any n that separates disjoint bodies strictly; for
/// others as side_of_contact().
template <typename Side>
Membership decide_exactly(const exact::PairOnGrid<3>& pair, const exact::IntegerVector<3>& w,
                          const Side& side) {
  const Membership line = exact::line_meets(pair, w);
  if (line == Membership::out) return line;
  // The line meets K; on which side of the origin?
  const std::optional<int> ahead = side();
  if (!ahead) return Membership::in;
  return *ahead < 0 ? Membership::out : line;
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

// The forms decide nearly all: they stand here without a call, and what they leave climbs from the start.
Membership ConeOracle::membership(const Eigen::Vector3d& w, Rung* rung) const {
  const auto side = certain_side(forms_, w);
  if (side == 0) [[unlikely]]
    return climb_all(w, Eigen::Vector3d::Zero(), rung);
  decided_by<ConeMembership>(Rung::triage, rung);
  return membership_of(side);
}

Membership ConeOracle::membership(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b, Rung* rung) const {
  const auto side = certain_side(forms_, v_a - v_b);
  if (side == 0) [[unlikely]]
    return climb_all(v_a, v_b, rung);
  decided_by<ConeMembership>(Rung::triage, rung);
  return membership_of(side);
}

[[gnu::noinline]] Membership ConeOracle::climb_all(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                                                   Rung* rung) const {
  return climb_membership<ConeMembership>(*this, v_a, v_b, rung);
}

Passage ConeOracle::passage(const Eigen::Vector3d& w) const { return passage_by_membership(*this, w); }

Verdict ConeOracle::verdict(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b, Rung* rung) const {
  if (rung && relation_ != Relation::disjoint) *rung = relation_rung_;
  return verdict_of(relation_, [&] { return membership(v_a, v_b, rung); });
}

}  // namespace vericone
