// SPDX-License-Identifier: GPL-3.0-or-later
#include "verify/corpus/corpus_answers.h"

#include <vericone/cones/ellipsoids/exact_predicates.h>
#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/cones/opening/orifice.h>
#include <vericone/cones/planar/sector.h>
#include <vericone/geometry/combined.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/internal/cones/ellipsoids/contact_frame.h>
#include <vericone/internal/cones/ellipsoids/rungs.h>
#include <vericone/internal/cones/hulls/hull_oracle.h>
#include <vericone/internal/geometry/quadric_side.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
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
  r.interval = text(interval_relation<D>(*a, *b, frame));
  r.exact = to_string(exact_relation<D>(*a, *b));
  Rung rung{};
  r.ladder = to_string(relation<D>(*a, *b, &rung));
  r.rung = rung;
  // The contact function is 1 at touching: what a Perram-Wertheim program compares.
  r.naive = frame.contact > 1 ? "disjoint" : frame.contact == 1 ? "touching" : "overlapping";
  return r;
}

/// The enumerator: the words of the corpus have no spaces.
const char* name(Position position) {
  switch (position) {
    case Position::disjoint:
      return "disjoint";
    case Position::touching:
      return "touching";
    case Position::crossing:
      return "crossing";
    case Position::a_inside_b:
      return "a_inside_b";
    case Position::a_inside_b_touching:
      return "a_inside_b_touching";
    case Position::b_inside_a:
      return "b_inside_a";
    case Position::b_inside_a_touching:
      return "b_inside_a_touching";
    case Position::equal:
      return "equal";
  }
  return "";
}
Text text(const std::optional<Position>& position) { return position ? Text(name(*position)) : std::nullopt; }

template <int D>
RungAnswers position_answers(const CorpusCase& c) {
  RungAnswers r;
  r.what = "position";
  r.truth = c.truth;
  r.rational = name(exact::position<D>(c.rational_body<D>("a"), c.rational_body<D>("b")));
  const auto a = c.body<D>("a"), b = c.body<D>("b");
  if (!a || !b) return r;
  Rung rung{};
  r.ladder = name(position<D>(*a, *b, &rung));
  r.rung = rung;
  r.triage = text(triage_position<D>(*a, *b));
  r.interval = text(interval_position<D>(*a, *b));
  r.exact = name(exact_position<D>(*a, *b));
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

HullBody hull_body(const CorpusCase& c, const std::string& field) {
  const std::vector<double> numbers = c.doubles(field).value();
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) points.emplace_back(&numbers[i]);
  return HullBody(points);
}

/// Shadows along w: K's points projected to the plane normal to w, where the ellipsoid is the unit disc (or
/// absent); the distance of the origin from their hull against 1 (or the widest gap between their directions
/// against pi), in doubles.
const char* naive_hull_membership(const CorpusCase& c, const Eigen::Vector3d& w) {
  const auto body = c.has("a.points") ? std::nullopt : c.body<3>("a");
  std::vector<Eigen::Vector3d> points;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  Eigen::Matrix3d unround = Eigen::Matrix3d::Identity();
  const HullBody obstacle = hull_body(c, "b.points");
  if (body) {
    unround = body->factor().inverse();
    for (const auto& q : obstacle.points()) points.emplace_back(unround * (q - body->center()));
  } else {
    const HullBody agent = hull_body(c, "a.points");
    for (const auto& q : obstacle.points())
      for (const auto& p : agent.points()) points.emplace_back(q - p);
  }
  for (const auto& x : points) middle += x;
  const Eigen::Vector3d direction = (unround * w).normalized(), e1 = direction.unitOrthogonal(),
                        e2 = direction.cross(e1);
  if (!(middle.dot(direction) > 0)) return "out";
  std::vector<Eigen::Vector2d> shadow;
  for (const auto& x : points) shadow.emplace_back(e1.dot(x), e2.dot(x));
  std::vector<double> angles;
  for (const auto& x : shadow) angles.push_back(std::atan2(x.y(), x.x()));
  std::sort(angles.begin(), angles.end());
  double gap = 2 * std::numbers::pi - (angles.back() - angles.front());
  for (std::size_t i = 1; i < angles.size(); ++i) gap = std::max(gap, angles[i] - angles[i - 1]);
  if (gap < std::numbers::pi) return "in";
  if (!body) return gap == std::numbers::pi ? "on" : "out";
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& x : shadow)
    for (const auto& y : shadow) {
      const Eigen::Vector2d d = y - x;
      const double t = d.squaredNorm() > 0 ? std::clamp(-x.dot(d) / d.squaredNorm(), 0.0, 1.0) : 0;
      nearest = std::min(nearest, (x + t * d).norm());
    }
  return nearest < 1 ? "in" : nearest == 1 ? "on" : "out";
}

RungAnswers hull_answers(const CorpusCase& c) {
  RungAnswers r;
  r.what = "hull";
  r.truth = c.truth;
  const Eigen::Vector3d w = c.vector<3>("w"), zero = Eigen::Vector3d::Zero();
  const HullBody obstacle = hull_body(c, "b.points");
  const HullOracle oracle = c.has("a.points") ? HullOracle(hull_body(c, "a.points"), obstacle)
                                              : HullOracle(c.body<3>("a").value(), obstacle);
  if (oracle.relation() != Relation::disjoint) throw std::runtime_error(c.label() + ": not disjoint");
  Rung rung{};
  r.ladder = to_string(oracle.membership(w, &rung));
  r.rung = rung;
  r.triage = text(oracle.triage_membership(w));
  r.interval = text(oracle.interval_membership(w, zero));
  r.exact = to_string(oracle.exact_membership(w, zero));
  r.naive = naive_hull_membership(c, w);
  return r;
}

RungAnswers orifice_answers(const CorpusCase& c) {
  RungAnswers r;
  r.what = "orifice";
  r.truth = c.truth;
  const Ellipsoid ball =
      Ellipsoid::from_axes(c.vector<3>("a.center"), Eigen::Vector3d::Constant(c.doubles("a.radius")->at(0)));
  const OrificeOracle oracle(
      ball, {c.vector<3>("orifice.center"), c.vector<3>("orifice.axis"), c.doubles("orifice.radius")->at(0)});
  if (oracle.side() != WallSide::clear) throw std::runtime_error(c.label() + ": not clear of the wall");
  const Eigen::Vector3d w = c.vector<3>("w");
  Rung rung{};
  r.ladder = to_string(oracle.transit(w, &rung));
  r.rung = rung;
  r.triage = text(oracle.triage_transit(w));
  r.interval = text(oracle.interval_transit(w));
  r.exact = to_string(oracle.exact_transit(w));
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

RungAnswers horizon_answers(const CorpusCase& c) {
  RungAnswers r;
  r.what = "horizon";
  r.truth = c.truth;
  const auto a = c.body<3>("a"), b = c.body<3>("b");
  const auto times = c.doubles("horizon");
  const Eigen::Vector3d v_a = c.vector<3>("v_a"), v_b = c.vector<3>("v_b");
  Horizon horizon{times->at(0)};
  if (times->size() > 1) horizon.until = times->at(1);
  const ConeOracle oracle(*a, *b);
  Rung rung{};
  r.ladder = to_string(oracle.verdict(v_a, v_b, horizon, &rung));
  r.rung = rung;
  if (rung == Rung::triage) r.triage = r.ladder;
  r.interval = text(interval_within(*a, *b, v_a, v_b, horizon));
  r.exact = to_string(exact_within(*a, *b, v_a, v_b, horizon));
  // The relation at the end in doubles, or at the beginning of what has no end.
  const Eigen::Vector3d w = v_a - v_b;
  const auto now = [&](double time) { return ContactFrame<3>(*a, b->translated(-time * w)).contact; };
  const double first = std::isinf(horizon.until) ? now(horizon.from) : now(horizon.until);
  r.naive = first > 1 ? "out" : first == 1 ? "on" : "in";
  return r;
}

}  // namespace

std::vector<RungAnswers> answers(const CorpusCase& c) {
  const bool planar = c.dimension() == 2;
  if (c.predicate == "position")
    return {planar ? relation_answers<2>(c) : relation_answers<3>(c),
            planar ? position_answers<2>(c) : position_answers<3>(c)};
  if (c.predicate == "relation") return {planar ? relation_answers<2>(c) : relation_answers<3>(c)};
  if (c.predicate == "membership") return {cone_answers<3, ConeOracle>(c)};
  if (c.predicate == "sector") return {cone_answers<2, SectorOracle>(c)};
  if (c.predicate == "side")
    return {c.has("quadric") ? quadric_side_answers(c)
            : planar         ? body_side_answers<2>(c)
                             : body_side_answers<3>(c)};
  if (c.predicate == "hull") return {hull_answers(c)};
  if (c.predicate == "horizon") return {horizon_answers(c)};
  if (c.predicate == "orifice") {
    if (c.doubles("a.radius")->at(0) > 1e150) return {};  // beyond what an ellipsoid may be
    return {orifice_answers(c)};
  }
  return {};
}

}  // namespace vericone::verify
