// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/ellipsoids/exact_predicates.h>
#include <vericone/cones/planar/sector.h>
#include <vericone/geometry/exact/rational.h>

#include <vericone/geometry/error.h>
#include <vericone/internal/cones/ellipsoids/contact_frame.h>
#include <vericone/internal/geometry/exact/integer.h>
#include <vericone/internal/geometry/tracked.h>
#include <cmath>

#include "answers/elementary.h"
#include "answers/velocity_ladder.h"
#include "ellipsoids/contact_polynomial.h"
#include "ellipsoids/pair_on_grid.h"

namespace vericone {
namespace {

/// Whether the line along w misses: G and F of the header, over any ring.
template <typename N>
struct LineTest {
  N g, f;

  constexpr LineTest(const Symmetric2<N>& a, const Symmetric2<N>& b, const N& cx, const N& cy, const N& wx,
                     const N& wy) {
    const auto q = [&](const Symmetric2<N>& s) {
      return (s.a * (wy * wy) + s.c * (wx * wx)) - (s.b * (wx * wy)) * 2;
    };
    const N qa = q(a), qb = q(b), offset = cy * wx - cx * wy;
    g = offset * offset - (qa + qb);
    f = g * g - (qa * qb) * 4;
  }
};

/// Roundings of the first rung: S 3 (at most: two products of factors summed), c 1, and each entry of w over
/// the larger one 3 (two differences of velocities, the quotient).
constexpr LineTest<RoundingCount> kLineCount = [] {
  constexpr RoundingCount s{3}, c{1}, w{3};
  return LineTest<RoundingCount>({s, s, s}, {s, s, s}, c, c, w, w);
}();
constexpr RoundingCount kAhead = RoundingCount{0} * RoundingCount{3} + RoundingCount{0} * RoundingCount{3};
constexpr double kUnderflow = 1e-250;

exact::IntegerVector<2> exact_normal(const exact::PairOnGrid<2>& pair) {
  const exact::Dyadic x = exact::between_positive_roots(exact::contact_polynomial<2>(pair), 0);
  exact::IntegerMatrix<2> m;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) m[i][j] = (pair.a[i][j] << x.exponent) + x.numerator * pair.b[i][j];
  return {m[1][1] * pair.c[0] - m[0][1] * pair.c[1], m[0][0] * pair.c[1] - m[1][0] * pair.c[0]};
}

/// `side` as in ConeOracle.
template <typename Side>
Membership decide_exactly(const exact::PairOnGrid<2>& pair, const exact::IntegerVector<2>& w,
                          const Side& side) {
  using exact::Integer;
  const auto shape = [](const exact::IntegerMatrix<2>& s) {
    return Symmetric2<Integer>{s[0][0], s[0][1], s[1][1]};
  };
  const LineTest<Integer> line(shape(pair.a), shape(pair.b), pair.c[0], pair.c[1], w[0], w[1]);
  const bool outside = line.g.sign() > 0;
  if (outside && line.f.sign() > 0) return Membership::out;
  const std::optional<int> ahead = side();
  if (!ahead) return Membership::in;
  if (*ahead < 0) return Membership::out;
  return outside && line.f.sign() == 0 ? Membership::on : Membership::in;
}

}  // namespace

SectorOracle::SectorOracle(const Ellipse& a, const Ellipse& b) : a_(a), b_(b) {
  const ContactFrame<2> frame(a, b);
  relation_ = vericone::relation<2>(a, b, frame);
  if (relation_ == Relation::disjoint) {
    normal_ = frame.separating_normal();
    normal_certified_ = separates<2>(a, b, normal_);
    if (!normal_certified_) {
      // The bodies are closer than rounding: the exact maximiser, rounded, may do better.
      const auto n = exact_normal(exact::PairOnGrid<2>(a, b));
      const exact::Integer largest = std::max(exact::Integer(abs(n[0])), exact::Integer(abs(n[1])));
      for (int i = 0; i < 2; ++i)
        normal_(i) = static_cast<double>(exact::Integer((n[i] << 64) / largest)) * 0x1p-64;
      normal_certified_ = separates<2>(a, b, normal_);
    }
    normal_ *= std::ldexp(1.0, -binary_exponent(normal_.cwiseAbs().maxCoeff()));
  }
  // Every velocity is in the sector of overlapping bodies: the rungs have nothing to prepare.
  if (relation_ == Relation::overlapping) return;
  const Eigen::Vector2d c = b.center() - a.center();
  const int e = binary_exponent(c.cwiseAbs().maxCoeff());
  if (std::abs(e) > 510) return;
  const double scale = std::ldexp(1.0, -e), scale2 = scale * scale;
  usable_ = true;
  const auto fill = [&](const Ellipse& body, double(&entries)[3][2], Interval(&enclosed)[3]) {
    const Eigen::Matrix2d f = body.factor() * scale;
    for (int i = 0, k = 0; i < 2; ++i)
      for (int j = i; j < 2; ++j, ++k) {
        if (body.defined_by_factor()) {
          entries[k][0] = f(i, 0) * f(j, 0) + f(i, 1) * f(j, 1);
          entries[k][1] = std::abs(f(i, 0) * f(j, 0)) + std::abs(f(i, 1) * f(j, 1));
          enclosed[k] = Interval(f(i, 0)) * Interval(f(j, 0)) + Interval(f(i, 1)) * Interval(f(j, 1));
        } else {
          entries[k][0] = body.shape()(i, j) * scale2;
          entries[k][1] = std::abs(entries[k][0]);
          enclosed[k] = Interval(entries[k][0], Interval::kTiny);
        }
        usable_ = usable_ && entries[k][1] < 0x1p20 && (i != j || entries[k][1] > 1e-40);
      }
  };
  fill(a, shape_a_, enclosed_a_);
  fill(b, shape_b_, enclosed_b_);
  for (int i = 0; i < 2; ++i) {
    c_[i][0] = c(i) * scale;
    c_[i][1] = std::abs(c_[i][0]);
    enclosed_c_[i] = Interval(b.center()(i) * scale) - Interval(a.center()(i) * scale);
  }
}

std::optional<Membership> SectorOracle::triage_membership(const Eigen::Vector2d& w) const noexcept {
  const double largest = w.cwiseAbs().maxCoeff();
  if (!(largest > 0 && largest <= std::numeric_limits<double>::max() && usable_)) {
    if (w.x() == 0 && w.y() == 0) return Membership::out;
    if (relation_ == Relation::overlapping && w.allFinite()) return Membership::in;
    return std::nullopt;
  }
  // Both entries over the larger one: the scale is gone.
  const Tracked wx = Tracked::of(w.x() / largest), wy = Tracked::of(w.y() / largest);
  const auto shape = [](const double(&s)[3][2]) {
    return Symmetric2<Tracked>{Tracked::of(s[0]), Tracked::of(s[1]), Tracked::of(s[2])};
  };
  const int ahead =
      normal_certified_
          ? (Tracked::of(normal_.x()) * wx + Tracked::of(normal_.y()) * wy).certain(kAhead, kUnderflow)
          : 0;
  if (ahead < 0) return Membership::out;
  const LineTest<Tracked> line(shape(shape_a_), shape(shape_b_), Tracked::of(c_[0]), Tracked::of(c_[1]), wx,
                               wy);
  const int g = line.g.certain(kLineCount.g, kUnderflow), f = line.f.certain(kLineCount.f, kUnderflow);
  if (g > 0 && f > 0) return Membership::out;
  if (ahead > 0 && (g < 0 || f < 0)) return Membership::in;
  return std::nullopt;
}

std::optional<Membership> SectorOracle::interval_membership(const Eigen::Vector2d& v_a,
                                                            const Eigen::Vector2d& v_b) const noexcept {
  return interval_membership({Interval(v_a.x()) - Interval(v_b.x()), Interval(v_a.y()) - Interval(v_b.y())});
}

std::optional<Membership> SectorOracle::interval_membership(const std::array<Interval, 2>& w) const noexcept {
  const int larger = std::abs(w[1].mid()) > std::abs(w[0].mid()) ? 1 : 0;
  const Interval& over = w[larger];
  if (over.sign() == FilteredSign::uncertain) return std::nullopt;
  if (!usable_) return relation_ == Relation::overlapping ? std::optional(Membership::in) : std::nullopt;
  const Interval length = over.positive() ? over : -over;
  Interval unit[2];
  unit[larger] = over.positive() ? 1.0 : -1.0;
  unit[1 - larger] = w[1 - larger] / length;
  int ahead = 0;
  if (normal_certified_) {
    const Interval along = Interval(normal_.x()) * unit[0] + Interval(normal_.y()) * unit[1];
    ahead = static_cast<int>(along.positive()) - static_cast<int>(along.negative());
  }
  if (ahead < 0) return Membership::out;
  const LineTest<Interval> line({enclosed_a_[0], enclosed_a_[1], enclosed_a_[2]},
                                {enclosed_b_[0], enclosed_b_[1], enclosed_b_[2]}, enclosed_c_[0],
                                enclosed_c_[1], unit[0], unit[1]);
  if (line.g.positive() && line.f.positive()) return Membership::out;
  if (ahead > 0 && (line.g.negative() || line.f.negative())) return Membership::in;
  return std::nullopt;
}

Membership SectorOracle::naive_membership(const Eigen::Vector2d& w) const noexcept {
  const auto shape = [](const double(&s)[3][2]) { return Symmetric2<double>{s[0][0], s[1][0], s[2][0]}; };
  const LineTest<double> line(shape(shape_a_), shape(shape_b_), c_[0][0], c_[1][0], w.x(), w.y());
  if (line.g > 0 && line.f > 0) return Membership::out;
  if (!(normal_.dot(w) > 0))
    return relation_ == Relation::overlapping && !w.isZero(0) ? Membership::in : Membership::out;
  return line.g > 0 && line.f == 0 ? Membership::on : Membership::in;
}

Membership SectorOracle::exact_membership(const Eigen::Vector2d& v_a, const Eigen::Vector2d& v_b) const {
  require_finite_velocity(v_a, "agent_velocity");
  require_finite_velocity(v_b, "obstacle_velocity");
  const auto w = exact::difference_on_grid<2>(v_a, v_b);
  if (w[0] == 0 && w[1] == 0) return Membership::out;
  if (relation_ == Relation::overlapping) return Membership::in;
  const exact::PairOnGrid<2> pair(a_, b_);
  return decide_exactly(pair, w, [&]() -> std::optional<int> {
    if (!normal_certified_) return exact::side_of_contact<2>(pair, w);
    const auto n = exact::direction_on_grid<2>(normal_);
    return exact::Integer(n[0] * w[0] + n[1] * w[1]).sign();
  });
}

Membership SectorOracle::membership(const Eigen::Vector2d& w, Rung* rung) const {
  return climb_membership<SectorMembership>(*this, w, Eigen::Vector2d(Eigen::Vector2d::Zero()), rung);
}

Membership SectorOracle::membership(const Eigen::Vector2d& v_a, const Eigen::Vector2d& v_b,
                                    Rung* rung) const {
  return climb_membership<SectorMembership>(*this, v_a, v_b, rung);
}

Verdict SectorOracle::verdict(const Eigen::Vector2d& v_a, const Eigen::Vector2d& v_b, Rung* rung) const {
  return verdict_of(relation_, [&] { return membership(v_a, v_b, rung); });
}

namespace exact {

Membership membership(const RationalBody<2>& a, const RationalBody<2>& b, const RationalVector<2>& w) {
  const IntegerVector<2> direction = direction_on_grid<2>(w);
  if (direction[0] == 0 && direction[1] == 0) return Membership::out;
  const PairOnGrid<2> pair(a, b);
  return decide_exactly(pair, direction, [&] { return side_of_contact<2>(pair, direction); });
}

}  // namespace exact

}  // namespace vericone
