// SPDX-License-Identifier: GPL-3.0-or-later
#include <vericone/internal/verify/assembly/truth.h>
#include <vericone/internal/verify/predicates/hull_truth.h>
#include <vericone/internal/verify/predicates/truth.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "assembly/nearness.h"
#include "assembly/program.h"
#include "assembly/sum.h"

namespace vericone::verify {

using Eigen::Vector3d;

TruePieces TruePieces::triangles(const std::vector<Vector3d>& points,
                                 const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  TruePieces r;
  for (const auto& t : triangles) r.hulls.push_back({points[t[0]], points[t[1]], points[t[2]]});
  return r;
}

TruePieces TruePieces::balls(const std::vector<Vector3d>& points, double radius) {
  TruePieces r;
  r.radius = radius;
  for (const Vector3d& x : points) r.hulls.push_back({x});
  return r;
}

TruePieces TruePieces::boxes(const std::vector<Box>& boxes) {
  TruePieces r;
  for (const Box& b : boxes) {
    r.hulls.emplace_back();
    for (int i = 0; i < 8; ++i)
      r.hulls.back().emplace_back((i & 1 ? b.high : b.low).x(), (i & 2 ? b.high : b.low).y(),
                                  (i & 4 ? b.high : b.low).z());
  }
  return r;
}

struct AssemblyTruth::State {
  std::optional<Ellipsoid> ellipsoid;  // otherwise a hull
  std::vector<Vector3d> hull;
  double ball = 0;  // radius where the ellipsoid is a ball
  TruePieces pieces;
  Nearness nearness;
  bool use_doubles = true;
  std::uint64_t exact = 0;
  std::vector<std::unique_ptr<HullSum>> sums;

  Membership decide(std::size_t i, const Motion& motion, double margin);
  Membership two_hulls(std::size_t i, const Motion& motion);
  Membership two_ellipsoids(std::size_t i, const Motion& motion) const;
};

namespace {

Membership of_sign(int sign) {
  return sign > 0 ? Membership::in : sign == 0 ? Membership::on : Membership::out;
}

/// Nothing but the numbers of its matrix can make an ellipsoid a ball.
double radius_of_ball(const Ellipsoid& e) {
  const Eigen::Matrix3d& f = e.factor();
  return e.defined_by_factor() && f == f(0, 0) * Eigen::Matrix3d::Identity() ? std::abs(f(0, 0)) : 0;
}

bool is_line(const Motion& motion) {
  return motion.directions.empty() || (motion.directions.size() == 1 && motion.from == 0 && motion.to == 0);
}

}  // namespace

AssemblyTruth::AssemblyTruth(const Ellipsoid& agent, TruePieces pieces) : state_(std::make_shared<State>()) {
  state_->ellipsoid = agent;
  state_->ball = radius_of_ball(agent);
  state_->pieces = std::move(pieces);
  state_->nearness = Nearness(agent, state_->pieces);
}

AssemblyTruth::AssemblyTruth(const HullBody& agent, TruePieces pieces) : state_(std::make_shared<State>()) {
  state_->hull = agent.points();
  state_->pieces = std::move(pieces);
  state_->nearness = Nearness(agent, state_->pieces);
  state_->sums.resize(state_->pieces.hulls.size());
}

void AssemblyTruth::use_doubles(bool use) { state_->use_doubles = use; }
std::size_t AssemblyTruth::size() const { return state_->pieces.hulls.size(); }
std::uint64_t AssemblyTruth::exact() const { return state_->exact; }
bool AssemblyTruth::euclidean() const { return !state_->ellipsoid || state_->ball > 0; }

Membership AssemblyTruth::State::decide(std::size_t i, const Motion& motion, double margin) {
  ++exact;
  const auto& points = pieces.hulls[i];
  if (ellipsoid && ball > 0) {
    const std::vector<Vector3d> center{ellipsoid->center()};
    return of_sign(compare_reach(center, points, motion, {ball, pieces.radius, margin}));
  }
  if (ellipsoid && margin != 0) throw std::logic_error("a margin in a metric that is not Euclidean");
  if (ellipsoid && pieces.radius == 0) return of_sign(compare_reach(*ellipsoid, points, motion));
  if (ellipsoid) return two_ellipsoids(i, motion);
  if (pieces.radius + margin == 0) return two_hulls(i, motion);
  return of_sign(compare_reach(hull, points, motion, {pieces.radius, margin}));
}

Membership AssemblyTruth::State::two_ellipsoids(std::size_t i, const Motion& motion) const {
  const Ellipsoid piece = Ellipsoid::from_axes(pieces.hulls[i].front(), Vector3d::Constant(pieces.radius));
  const bool still = motion.to == 0;
  if (still && motion.directions.empty()) {
    const Relation r = relation_truth<3>(*ellipsoid, piece);
    return r == Relation::overlapping ? Membership::in
           : r == Relation::touching  ? Membership::on
                                      : Membership::out;
  }
  if (!still || motion.directions.size() != 1)
    throw std::logic_error("an ellipsoid and balls along more than a ray");
  return ConeTruth(*ellipsoid, piece).membership(motion.directions.front());
}

Membership AssemblyTruth::State::two_hulls(std::size_t i, const Motion& motion) {
  const auto& points = pieces.hulls[i];
  if (!is_line(motion)) return of_sign(compare_reach(hull, points, motion, {}));
  if (!sums[i]) sums[i] = std::make_unique<HullSum>(hull, points);
  const bool ray = !motion.directions.empty();
  if (sums[i]->solid())
    return ray ? sums[i]->meets(0, INFINITY, motion.directions.front())
               : sums[i]->meets(motion.from, motion.to, motion.w);
  const HullTruth flat{HullBody(hull), HullBody(points)};
  if (ray) return flat.membership(motion.directions.front());
  if (motion.to != 0) return of_sign(compare_reach(hull, points, motion, {}));
  return flat.relation() == Relation::disjoint   ? Membership::out
         : flat.relation() == Relation::touching ? Membership::on
                                                 : Membership::in;
}

Membership AssemblyTruth::touched(std::size_t i, const Motion& motion, double margin) const {
  State& s = *state_;
  if (s.use_doubles)
    if (const auto known = s.nearness.decide(i, motion, margin)) return *known;
  return s.decide(i, motion, margin);
}

Membership AssemblyTruth::touched(const Motion& motion, double margin) const {
  State& s = *state_;
  Membership worst = Membership::out;
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < size(); ++i) {
    const auto known = s.use_doubles ? s.nearness.decide(i, motion, margin) : std::nullopt;
    if (known == Membership::in) return Membership::in;
    if (!known) open.push_back(i);
  }
  for (std::size_t i : open) {
    const Membership m = s.decide(i, motion, margin);
    if (m == Membership::in) return m;
    if (m == Membership::on) worst = m;
  }
  return worst;
}

Relation AssemblyTruth::relation() const {
  const Membership m = touched(Motion{});
  return m == Membership::in   ? Relation::overlapping
         : m == Membership::on ? Relation::touching
                               : Relation::disjoint;
}

Membership AssemblyTruth::membership(const Vector3d& w) const {
  return w.isZero(0) ? Membership::out : touched(Motion::ray(w));
}

}  // namespace vericone::verify
