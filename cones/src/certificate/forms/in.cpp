// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/forms/forms.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "certificate/forms/inequalities.h"
#include "combined/quadratic_search.h"

namespace vericone::certificates {
namespace {

using Eigen::Vector3d;

/// Where a search for a common point looks: z = change (1, q, tau), q and tau between 0 and 1.
struct Place {
  Matrix5 change = Matrix5::Zero();
  std::vector<std::uint32_t> corners = {};  // of which q has the weights, of all but the first
};

/// Where the largest of the values is least, about: of a common part that is too thin for boxes. By ever
/// smaller steps at random (the same ones each time).
std::optional<Eigen::Vector4d> deepest_point(const std::vector<QuadraticConstraint<4>>& constraints) {
  constexpr int kRounds = 60, kSteps = 300;
  std::mt19937 random(1);
  const auto one = [&] { return static_cast<double>(random()) * 0x1p-31 - 1; };
  const auto value = [&](const Eigen::Vector4d& x) {
    double most = -std::numeric_limits<double>::infinity();
    for (const auto& q : constraints) most = std::max(most, x.dot(q.h * x + 2 * q.g) + q.c);
    return most;
  };
  Eigen::Vector4d best = Eigen::Vector4d::Constant(0.5);
  double least = value(best), width = 0.7;
  for (int round = 0; round < kRounds; ++round, width *= 0.8) {
    const Eigen::Vector4d middle = best;
    for (int i = 0; i < kSteps; ++i) {
      Eigen::Vector4d x = middle;
      for (int k = 0; k < 4; ++k) x(k) = std::clamp(x(k) + width * one() * std::abs(one()), 0.0, 1.0);
      if (const double found = value(x); found < least) least = found, best = x;
    }
  }
  if (!(least < 0)) return std::nullopt;
  return best;
}

/// A point that satisfies all with some room, as a search in doubles finds it.
std::optional<Eigen::Vector4d> find_point(const Inequalities& inequalities, const Place& place) {
  std::vector<QuadraticConstraint<4>> constraints;
  for (const Inequality& of : inequalities.list()) {
    if (of.body == 2) continue;
    const Form<double> form = inequalities.form<double>(of);
    Matrix5 m;
    for (int r = 0; r < 5; ++r)
      for (int c = 0; c < 5; ++c) m(r, c) = form[r][c];
    m = place.change.transpose() * m * place.change;
    m /= std::max(m.norm(), 1e-300);
    QuadraticConstraint<4> q;
    q.c = m(0, 0);
    q.g = m.block<4, 1>(1, 0);
    q.h = m.block<4, 4>(1, 1);
    const double least =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(q.h, Eigen::EigenvaluesOnly).eigenvalues()(0);
    q.concavity = std::max(0.0, -least) + 1e-12;
    constraints.push_back(q);
  }
  if (!place.corners.empty()) {
    QuadraticConstraint<4> sum;  // of the weights, at most one
    sum.g.head<3>().setConstant(0.5);
    sum.c = -1;
    constraints.push_back(sum);
  }
  static thread_local QuadraticSearch<4> search;
  const SearchBox<4> box{Eigen::Vector4d::Constant(0.5), Eigen::Vector4d::Constant(0.5)};
  for (const double room : {1e-2, 1e-4, 1e-7, 1e-10}) {
    for (std::size_t i = 0; i < constraints.size() - (place.corners.empty() ? 0 : 1); ++i)
      constraints[i].slack = room;
    const auto result = search.run(constraints, box, {room / 8, 4000});
    if (result.outcome == SearchOutcome::found) return result.point;
  }
  return deepest_point(constraints);
}

bool all_inside(const Inequalities& inequalities, const std::array<Rational, 5>& z) {
  for (const Inequality& of : inequalities.list()) {
    if (of.body == 2) continue;
    const Form<Rational> m = inequalities.form<Rational>(of);
    Rational sum = 0;
    for (int r = 0; r < 5; ++r)
      for (int c = 0; c < 5; ++c) sum += z[r] * m[r][c] * z[c];
    if (sum.sign() >= 0) return false;
  }
  return true;
}

Rational cut_to(double x, int unit) {
  return Rational(std::ldexp(std::nearbyint(std::ldexp(x, -unit)), unit));
}

/// Rounds what was found, and writes it where it is still right.
bool write_point(const PairOfPieces& pair, const Inequalities& inequalities, const Place& place,
                 const Eigen::Vector4d& q, Text& proof) {
  const Eigen::Matrix<double, 5, 1> at = place.change * (Eigen::Matrix<double, 5, 1>() << 1, q).finished();
  const auto& [from, until] = inequalities.part();
  const bool of_agent = !pair.a.round();
  const Question& question = pair.question;
  const double length = place.change.block<3, 3>(1, 1).norm();
  for (const int bits : {6, 12, 20, 32, 46}) {
    std::array<Rational, 5> z;
    z[0] = 1;
    double t = inequalities.moves() ? at(4) : from;
    if (inequalities.moves()) {
      const int unit = log2_of(place.change(4, 4)) - bits;
      t = std::clamp(std::ldexp(std::nearbyint(std::ldexp(t, -unit)), unit), from, until);
    }
    z[4] = Rational(t);
    std::vector<Rational> weights;
    std::array<Rational, 3> x;  // in the world
    for (int i = 0; i < 3; ++i) x[i] = 0;
    if (place.corners.empty()) {
      for (int i = 0; i < 3; ++i) {
        z[i + 1] = cut_to(at(i + 1), log2_of(length) - bits);
        x[i] = z[i + 1] + z[4] * Rational(question.v_b(i));
      }
    } else {
      const Piece& piece = of_agent ? pair.a : pair.b;
      weights.push_back(1);
      for (std::size_t k = 1; k < place.corners.size(); ++k) {
        weights.push_back(cut_to(std::max(q(static_cast<Eigen::Index>(k) - 1), 0.0), -bits));
        weights[0] -= weights.back();
      }
      if (weights[0].sign() < 0) continue;
      for (int i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < weights.size(); ++k)
          x[i] += weights[k] * Rational(piece.corners[place.corners[k]](i));
        x[i] += Rational((of_agent ? question.agent : question.obstacle).at()(i)) +
                z[4] * Rational((of_agent ? question.v_a : question.v_b)(i));
        z[i + 1] = x[i] - z[4] * Rational(question.v_b(i));
      }
    }
    if (!all_inside(inequalities, z)) continue;
    proof.raw("{\"rule\": \"point\", \"time\": ").number(t).raw(", \"point\": [").number(x[0]).raw(", ");
    proof.number(x[1]).raw(", ").number(x[2]).raw("], \"inside\": ");
    proof.raw(of_agent ? "\"obstacle\"" : "\"agent\"");
    const char* between = of_agent ? ", \"agent_weights\": [[" : ", \"obstacle_weights\": [[";
    bool any = false;
    for (std::size_t k = 0; k < weights.size(); ++k) {
      if (weights[k].is_zero()) continue;
      proof.raw(between).index(place.corners[k]).raw(", ").number(weights[k]).raw("]");
      between = ", [";
      any = true;
    }
    if (any) proof.raw("]");
    if (pair.agent) proof.raw(", \"agent_piece\": ").index(*pair.agent);
    if (pair.obstacle) proof.raw(", \"obstacle_piece\": ").index(*pair.obstacle);
    proof.raw("}");
    return true;
  }
  return false;
}

}  // namespace

bool prove_in_of_forms(const PairOfPieces& pair, Text& proof) {
  const Question& question = pair.question;
  const Vector3d w = question.v_a - question.v_b;
  const Vector3d &at_a = question.agent.at(), &at_b = question.obstacle.at();
  Part part{question.horizon.from, question.horizon.until};
  if (w.isZero(0)) part.until = part.from;
  if (std::isinf(part.until)) {  // until they have passed
    const auto reach = [](const Piece& piece) {
      double most = 0;
      if (const Ellipsoid* body = piece.round()) most = body->center().norm() + body->factor().norm();
      for (const Vector3d& x : piece.corners) most = std::max(most, x.norm());
      return most;
    };
    const double far = (at_b - at_a).norm() + reach(pair.a) + reach(pair.b);
    part.until = part.from + far / w.norm() + part.from;
  }
  const Inequalities inequalities(pair, part);
  Place place;
  place.change(0, 0) = 1;
  place.change(4, 0) = part.from;
  place.change(4, 4) = inequalities.moves() ? part.until - part.from : 0;
  const auto look = [&] {
    const auto found = find_point(inequalities, place);
    return found && write_point(pair, inequalities, place, *found, proof);
  };
  if (pair.a.round() && pair.b.round()) {
    const Ellipsoid& body = *pair.b.round();
    const Vector3d half = body.factor().rowwise().norm();
    place.change.block<3, 1>(1, 0) = body.center() + at_b - half;
    place.change.block<3, 3>(1, 1) = (2 * half).asDiagonal();
    return look();
  }
  // A point of a hull is one of a tetrahedron of corners, the first among them.
  const bool of_agent = !pair.a.round();
  const std::vector<Vector3d>& corners = of_agent ? pair.a.corners : pair.b.corners;
  std::vector<std::uint32_t> distinct;
  for (std::uint32_t i = 0; i < corners.size(); ++i)
    if (std::none_of(distinct.begin(), distinct.end(), [&](auto k) { return corners[k] == corners[i]; }))
      distinct.push_back(i);
  const auto look_among = [&](const std::vector<std::uint32_t>& some) {
    place.corners = some;
    const Vector3d& first = corners[some.front()];
    place.change.block<3, 1>(1, 0) = first + (of_agent ? at_a : at_b);
    if (of_agent) place.change.block<3, 1>(1, 0) += part.from * w;
    if (of_agent) place.change.block<3, 1>(1, 4) = place.change(4, 4) * w;
    place.change.block<3, 3>(1, 1).setZero();
    for (std::size_t k = 1; k < some.size(); ++k)
      place.change.block<3, 1>(1, static_cast<Eigen::Index>(k)) = corners[some[k]] - first;
    return look();
  };
  const std::size_t count = distinct.size();
  if (count <= 4) return look_among(distinct);
  for (std::size_t i = 1; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j)
      for (std::size_t k = j + 1; k < count; ++k)
        if (look_among({distinct[0], distinct[i], distinct[j], distinct[k]})) return true;
  return false;
}

}  // namespace vericone::certificates
