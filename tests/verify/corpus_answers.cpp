// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/corpus_answers.h"

#include <vericone/cones/contact_frame.h>
#include <vericone/cones/exact_predicates.h>
#include <vericone/cones/predicates.h>
#include <vericone/cones/sector_oracle.h>
#include <vericone/geometry/quadric_side.h>
#include <Eigen/LU>
#include <stdexcept>

namespace vericone::verify {
namespace {

using Text = std::optional<std::string>;

template <typename Answer>
Text text(const std::optional<Answer>& answer) {
  return answer ? Text(to_string(*answer)) : std::nullopt;
}
Text text(FilteredSign sign) {
  if (sign == FilteredSign::uncertain) return std::nullopt;
  return to_string(static_cast<Sign>(sign));
}

template <int D>
RungAnswers relation_answers(const CorpusCase& c) {
  RungAnswers r;
  r.what = "relation";
  const std::string& t = c.truth;
  r.truth = t == "disjoint" || t == "touching" ? t : "overlapping";
  r.rational = to_string(exact::relation<D>(c.rational_body<D>("a"), c.rational_body<D>("b")));
  const auto a = c.body<D>("a"), b = c.body<D>("b");
  if (!a || !b) return r;
  const ContactFrame<D> frame(*a, *b);
  r.triage = text(triage_relation<D>(*a, *b, frame));
  r.exact = to_string(exact_relation<D>(*a, *b));
  r.ladder = to_string(relation<D>(*a, *b));
  // The contact function is 1 at touching: what a Perram-Wertheim program compares.
  r.naive = frame.contact > 1 ? "disjoint" : frame.contact == 1 ? "touching" : "overlapping";
  return r;
}

template <int D, typename Oracle>
RungAnswers cone_answers(const CorpusCase& c) {
  RungAnswers r;
  r.what = c.predicate;
  r.truth = c.truth;
  exact::RationalVector<D> rational_w;
  for (int i = 0; i < D; ++i) rational_w[i] = c.values("w")[i];
  r.rational = to_string(exact::membership(c.rational_body<D>("a"), c.rational_body<D>("b"), rational_w));
  const auto a = c.body<D>("a"), b = c.body<D>("b");
  if (!a || !b || !c.doubles("w")) return r;
  using Vector = Eigen::Matrix<double, D, 1>;
  const Vector w = c.vector<D>("w"), zero = Vector::Zero();
  const Oracle oracle(*a, *b);
  if (oracle.relation() != Relation::disjoint) throw std::runtime_error(c.label() + ": not disjoint");
  Rung rung{};
  r.ladder = to_string(oracle.membership(w, &rung));
  r.rung = rung;
  r.triage = text(oracle.triage_membership(w));
  r.interval = text(oracle.interval_membership(w, zero));
  r.exact = to_string(oracle.exact_membership(w, zero));
  r.naive = to_string(oracle.naive_membership(w));
  return r;
}

const char* sign_of(double x) { return x < 0 ? "negative" : x > 0 ? "positive" : "zero"; }

template <int D>
RungAnswers body_side_answers(const CorpusCase& c) {
  RungAnswers r;
  r.what = "side";
  r.truth = c.truth;
  exact::RationalVector<D> rational_x;
  for (int i = 0; i < D; ++i) rational_x[i] = c.values("point")[i];
  r.rational = to_string(exact::side<D>(c.rational_body<D>("a"), rational_x));
  const auto body = c.body<D>("a");
  if (!body || !c.doubles("point")) return r;
  const auto x = c.vector<D>("point");
  Rung rung{};
  r.ladder = to_string(side<D>(*body, x, &rung));
  r.rung = rung;
  r.triage = text(triage_side<D>(*body, x));
  r.interval = text(interval_side<D>(*body, x));
  r.exact = to_string(exact_side<D>(*body, x));
  const Eigen::Matrix<double, D, 1> d = x - body->center();
  r.naive = sign_of(d.dot(body->shape().inverse() * d) - 1);
  return r;
}

RungAnswers quadric_side_answers(const CorpusCase& c) {
  RungAnswers r;
  r.what = "side";
  r.truth = c.truth;
  const auto entries = c.doubles("quadric");
  if (!entries || !c.doubles("point")) return r;
  Eigen::Matrix4d q;
  for (int i = 0, at = 0; i < 4; ++i)
    for (int j = i; j < 4; ++j) q(i, j) = q(j, i) = entries->at(at++);
  const Quadric quadric(q);
  const Eigen::Vector3d x = c.vector<3>("point");
  Rung rung{};
  r.ladder = to_string(side<3>(quadric, x, &rung));
  r.rung = rung;
  r.triage = text(triage_side<3>(quadric, x));
  r.interval = text(interval_side<3>(quadric, x));
  r.exact = to_string(exact_side<3>(quadric, x));
  r.naive = sign_of(x.homogeneous().dot(q * x.homogeneous()));
  return r;
}

}  // namespace

std::vector<RungAnswers> answers(const CorpusCase& c) {
  const bool planar = c.dimension() == 2;
  if (c.predicate == "position" || c.predicate == "relation")
    return {planar ? relation_answers<2>(c) : relation_answers<3>(c)};
  if (c.predicate == "membership") return {cone_answers<3, ConeOracle>(c)};
  if (c.predicate == "sector") return {cone_answers<2, SectorOracle>(c)};
  if (c.predicate == "side")
    return {c.has("quadric") ? quadric_side_answers(c)
            : planar         ? body_side_answers<2>(c)
                             : body_side_answers<3>(c)};
  return {};
}

}  // namespace vericone::verify
