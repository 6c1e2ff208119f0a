// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/ellipsoids/exact_predicates.h>
#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/geometry/combined.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/internal/cones/ellipsoids/contact_frame.h>
#include <vericone/internal/cones/ellipsoids/rungs.h>
#include <vericone/internal/geometry/exact/integer.h>
#include <vericone/internal/geometry/quadric_side.h>
#include <cmath>
#include <limits>

#include "answers/elementary.h"
#include "ellipsoids/contact_polynomial.h"
#include "ellipsoids/enclosed_pair.h"
#include "ellipsoids/pair_on_grid.h"

namespace vericone {
namespace {

/// An upper bound of rho(n), from the matrix that defines the body; the other one is rounded.
template <int D>
double radius_above(const BasicEllipsoid<D>& body, const Eigen::Matrix<double, D, 1>& n,
                    const Eigen::Matrix<double, D, 1>& n_abs) {
  if (body.defined_by_factor()) {
    // Sums of at most three products, a norm: fewer than 8 roundings.
    return body.radius(n) + 8 * kUnitRoundoff * (body.factor().cwiseAbs().transpose() * n_abs).norm();
  }
  const double q = n.dot(body.shape() * n), magnitude = n_abs.dot(body.shape().cwiseAbs() * n_abs);
  return std::sqrt(std::max(q, 0.0) + 16 * kUnitRoundoff * magnitude) * (1 + 4 * kUnitRoundoff);
}

}  // namespace

template <int D>
double triage_gap(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b,
                  const Eigen::Matrix<double, D, 1>& n) {
  // The difference of the centres and their product with n, 4 roundings, and two sums.
  const Eigen::Matrix<double, D, 1> c = b.center() - a.center(), n_abs = n.cwiseAbs();
  const double along = n.dot(c), radii = radius_above<D>(a, n, n_abs) + radius_above<D>(b, n, n_abs);
  const double magnitude = n_abs.dot(c.cwiseAbs()) + radii;
  // Below 1e-140 a square could leave the normal numbers.
  if (!(magnitude > 1e-140 && magnitude < 1e150)) return -std::numeric_limits<double>::infinity();
  return along - radii - 16 * kUnitRoundoff * magnitude;
}

template <int D>
bool triage_separates(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b,
                      const Eigen::Matrix<double, D, 1>& n) {
  return triage_gap<D>(a, b, n) > 0;
}

template <int D>
bool interval_separates(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b,
                        const Eigen::Matrix<double, D, 1>& n) {
  return EnclosedPair<D>(a, b).gap(n).positive();
}

template <int D>
bool separates(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b, const Eigen::Matrix<double, D, 1>& n) {
  if (!n.allFinite()) return false;
  if (triage_separates<D>(a, b, n) || interval_separates<D>(a, b, n)) return true;
  // n.c > sqrt(q_A) + sqrt(q_B), sign first, then squared twice.
  using exact::Integer;
  const exact::PairOnGrid<D> pair(a, b);
  const auto m = exact::direction_on_grid<D>(n);
  Integer along = 0, qa = 0, qb = 0;
  for (int i = 0; i < D; ++i) {
    along += pair.c[i] * m[i];
    for (int j = 0; j < D; ++j) {
      const Integer mm = m[i] * m[j];
      qa += pair.a[i][j] * mm;
      qb += pair.b[i][j] * mm;
    }
  }
  if (along.sign() <= 0) return false;
  const Integer rest = along * along - qa - qb;
  return rest.sign() > 0 && rest * rest > 4 * qa * qb;
}

namespace {

/// The certificates of both lower rungs: a plane that separates the bodies, or a point inside of both.
template <int D, typename Separates, typename Inside>
std::optional<Relation> relation_by_certificate(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b,
                                                const ContactFrame<D>& frame, const Separates& separates,
                                                const Inside& inside) {
  if (!(frame.contact < std::numeric_limits<double>::max()) || !frame.center.allFinite()) return std::nullopt;
  if (frame.contact > 1) {
    Eigen::Matrix<double, D, 1> n = frame.separating_normal();
    const double largest = n.cwiseAbs().maxCoeff();
    if (!(largest > 0 && largest <= std::numeric_limits<double>::max())) return std::nullopt;
    // Its length is free; a power of two keeps it exact.
    n *= std::ldexp(1.0, std::clamp(-std::ilogb(largest), -1000, 1000));
    if (separates(n)) return Relation::disjoint;
    return std::nullopt;
  }
  // At the maximiser both bodies contain y = c / (1 + x sigma^2). Any point near it is a witness.
  Eigen::Matrix<double, D, 1> y;
  for (int i = 0; i < D; ++i) y(i) = frame.center(i) / (1 + frame.ratio * frame.sigma(i) * frame.sigma(i));
  const Eigen::Matrix<double, D, 1> witness = a.center() + frame.to_space * y;
  if (inside(a, witness) && inside(b, witness)) return Relation::overlapping;
  return std::nullopt;
}

}  // namespace

template <int D>
std::optional<Relation> triage_relation(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b,
                                        const ContactFrame<D>& frame) {
  return relation_by_certificate<D>(
      a, b, frame, [&](const auto& n) { return triage_separates<D>(a, b, n); },
      [](const auto& body, const auto& x) { return triage_side<D>(body, x) == FilteredSign::negative; });
}

template <int D>
std::optional<Relation> interval_relation(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b,
                                          const ContactFrame<D>& frame) {
  return relation_by_certificate<D>(
      a, b, frame, [&](const auto& n) { return interval_separates<D>(a, b, n); },
      [](const auto& body, const auto& x) { return interval_side<D>(body, x) == FilteredSign::negative; });
}

namespace {
Relation relation_by_roots(int distinct_positive) {
  return distinct_positive == 0   ? Relation::overlapping
         : distinct_positive == 1 ? Relation::touching
                                  : Relation::disjoint;
}
}  // namespace

template <int D>
Relation exact_relation(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b) {
  return relation_by_roots(
      exact::distinct_positive_roots(exact::contact_polynomial<D>(exact::PairOnGrid<D>(a, b))));
}

template <int D>
Relation relation(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b, Rung* rung) {
  return relation<D>(a, b, ContactFrame<D>(a, b), rung);
}

template <int D>
Relation relation(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b, const ContactFrame<D>& frame,
                  Rung* rung) {
  return climb<EllipsoidRelation>(
      rung, [&] { return triage_relation<D>(a, b, frame); },
      [&] { return interval_relation<D>(a, b, frame); }, [&] { return exact_relation<D>(a, b); });
}

template bool separates<2>(const Ellipse&, const Ellipse&, const Eigen::Vector2d&);
template bool separates<3>(const Ellipsoid&, const Ellipsoid&, const Eigen::Vector3d&);
template double triage_gap<3>(const Ellipsoid&, const Ellipsoid&, const Eigen::Vector3d&);
template bool triage_separates<2>(const Ellipse&, const Ellipse&, const Eigen::Vector2d&);
template bool triage_separates<3>(const Ellipsoid&, const Ellipsoid&, const Eigen::Vector3d&);
template std::optional<Relation> triage_relation<2>(const Ellipse&, const Ellipse&, const ContactFrame<2>&);
template std::optional<Relation> triage_relation<3>(const Ellipsoid&, const Ellipsoid&,
                                                    const ContactFrame<3>&);
template Relation relation<2>(const Ellipse&, const Ellipse&, const ContactFrame<2>&, Rung*);
template Relation relation<3>(const Ellipsoid&, const Ellipsoid&, const ContactFrame<3>&, Rung*);
template std::optional<Relation> interval_relation<2>(const Ellipse&, const Ellipse&, const ContactFrame<2>&);
template std::optional<Relation> interval_relation<3>(const Ellipsoid&, const Ellipsoid&,
                                                      const ContactFrame<3>&);
template Relation exact_relation<2>(const Ellipse&, const Ellipse&);
template Relation exact_relation<3>(const Ellipsoid&, const Ellipsoid&);
template Relation relation<2>(const Ellipse&, const Ellipse&, Rung*);
template Relation relation<3>(const Ellipsoid&, const Ellipsoid&, Rung*);

namespace exact {

template <int D>
Relation relation(const RationalBody<D>& a, const RationalBody<D>& b) {
  return relation_by_roots(distinct_positive_roots(contact_polynomial<D>(PairOnGrid<D>(a, b))));
}
template Relation relation<2>(const RationalBody<2>&, const RationalBody<2>&);
template Relation relation<3>(const RationalBody<3>&, const RationalBody<3>&);

}  // namespace exact

}  // namespace vericone
