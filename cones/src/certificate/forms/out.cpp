// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/forms/forms.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "certificate/forms/combination.h"

namespace vericone::certificates {
namespace {

using Eigen::Vector3d;

double cut(double x, int bits) {
  if (!(x > 0)) return 0;
  const int unit = std::ilogb(x) - bits;
  return std::ldexp(std::nearbyint(std::ldexp(x, -unit)), unit);
}

/// By multipliers for all of a part of the time.
bool prove_part(const PairOfPieces& pair, const Part& part, Text& proof, const std::vector<Cut>& cuts = {}) {
  const Inequalities inequalities(pair, part, cuts);
  const auto& list = inequalities.list();
  const int size = inequalities.size();
  // Coordinates in which the bodies are about one large.
  const auto middle = [](const Piece& piece, const Vector3d& at) {
    if (piece.round()) return Vector3d(piece.round()->center() + at);
    Vector3d sum = Vector3d::Zero();
    for (const Vector3d& x : piece.corners) sum += x / static_cast<double>(piece.corners.size());
    return Vector3d(sum + at);
  };
  const auto extent = [](const Piece& piece) {
    if (piece.round()) return piece.round()->factor().norm();
    double most = 0;
    for (const Vector3d& x : piece.corners) most = std::max(most, (x - piece.corners.front()).norm());
    return most;
  };
  const Vector3d w = pair.question.v_a - pair.question.v_b;
  const double length = std::max(extent(pair.a), extent(pair.b)), speed = w.norm();
  const double beat = !inequalities.moves()    ? 1
                      : std::isinf(part.until) ? length / speed
                                               : std::min(length / speed, part.until - part.from);
  const Vector3d center = middle(pair.b, pair.question.obstacle.at());
  const double near =
      speed > 0 ? (center - middle(pair.a, pair.question.agent.at())).dot(w) / (speed * speed) : 0;
  const double moment =
      std::clamp(near, part.from, std::isinf(part.until) ? std::max(near, part.from) : part.until);
  Matrix5 change = Matrix5::Zero();
  change(0, 0) = 1;
  change.block<3, 1>(1, 0) = center;
  change.block<3, 3>(1, 1) = length * Eigen::Matrix3d::Identity();
  change(4, 0) = moment;
  change(4, 4) = beat;
  std::vector<Matrix5> forms;
  std::vector<double> sizes;
  for (const Inequality& of : list) {
    const Form<double> form = inequalities.form<double>(of);
    Matrix5 m;
    for (int r = 0; r < 5; ++r)
      for (int c = 0; c < 5; ++c) m(r, c) = form[r][c];
    m = change.transpose() * m * change;
    if (size == 4) m.row(4).setZero(), m.col(4).setZero();
    sizes.push_back(std::max(m.norm(), 1e-300));
    forms.push_back(m / sizes.back());
  }
  const std::vector<double> found = positive_combination(forms, size);
  if (found.empty()) return false;
  std::vector<Form<Rational>> exact;
  for (const Inequality& of : list) exact.push_back(inequalities.form<Rational>(of));
  for (const int bits : {4, 10, 20, 50}) {
    std::vector<double> multipliers;
    for (std::size_t i = 0; i < list.size(); ++i)
      multipliers.push_back(found[i] > std::ldexp(0.1, -bits) ? cut(found[i] / sizes[i], bits) : 0);
    Form<Rational> sum;
    for (auto& row : sum) row.fill(Rational(0));
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (multipliers[i] == 0) continue;
      const Rational times(multipliers[i]);
      for (int r = 0; r < size; ++r)
        for (int c = 0; c < size; ++c) sum[r][c] += times * exact[i][r][c];
    }
    if (!is_positive(std::move(sum), size)) continue;
    inequalities.write(proof, multipliers);
    return true;
  }
  return false;
}

/// Parts of space in which a search for multipliers has a chance where it has none in all of it.
class Halves {
 public:
  Halves(const PairOfPieces& pair, const Part& part) : pair_(pair), part_(part) {}

  bool run(Text& proof) {
    // Where both may be, about: the obstacle, and what the agent sweeps.
    const Vector3d w = pair_.question.v_a - pair_.question.v_b;
    const auto [low, high] = bounds(pair_.b, pair_.question.obstacle.at());
    const auto [agent_low, agent_high] = bounds(pair_.a, pair_.question.agent.at());
    Vector3d from = low, until = high;
    for (int i = 0; i < 3; ++i) {
      const double start = part_.from * w(i), end = w(i) == 0 ? 0 : part_.until * w(i);
      from(i) = std::max(low(i), agent_low(i) + std::min(start, end));
      until(i) = std::min(high(i), agent_high(i) + std::max(start, end));
      if (!(from(i) < until(i))) from(i) = low(i), until(i) = high(i);
    }
    return node(from, until, proof);
  }

 private:
  static constexpr std::size_t kDeepest = 9;
  static constexpr int kMostNodes = 120;

  static std::pair<Vector3d, Vector3d> bounds(const Piece& piece, const Vector3d& at) {
    if (const Ellipsoid* body = piece.round()) {
      const Vector3d half = body->factor().rowwise().norm(), middle = body->center() + at;
      return {middle - half, middle + half};
    }
    Vector3d low = piece.corners.front(), high = low;
    for (const Vector3d& x : piece.corners) low = low.cwiseMin(x), high = high.cwiseMax(x);
    return {low + at, high + at};
  }

  bool node(const Vector3d& low, const Vector3d& high, Text& proof) {
    if (++nodes_ > kMostNodes) return false;
    if (!cuts_.empty() && prove_part(pair_, part_, proof, cuts_)) return true;
    if (cuts_.size() == kDeepest) return false;
    int axis = 0;
    const double side = (high - low).maxCoeff(&axis);
    const int unit = log2_of(side) - 4;
    const double at = std::ldexp(std::nearbyint(std::ldexp(0.5 * (low(axis) + high(axis)), -unit)), unit);
    proof.raw("{\"rule\": \"halves\", \"normal\": ").number(Vector3d(Vector3d::Unit(axis)));
    proof.raw(", \"at\": ").number(at);
    for (const bool above : {false, true}) {
      Vector3d from = low, until = high;
      (above ? from : until)(axis) = at;
      cuts_.push_back({axis, at, above});
      proof.raw(above ? ", \"above\": " : ", \"below\": ");
      const bool proved = node(from, until, proof);
      cuts_.pop_back();
      if (!proved) return false;
    }
    proof.raw("}");
    return true;
  }

  const PairOfPieces& pair_;
  const Part part_;
  std::vector<Cut> cuts_;
  int nodes_ = 0;
};

bool prove_by_halves(const PairOfPieces& pair, const Part& part, std::vector<std::string>& proofs) {
  Text text;
  if (!Halves(pair, part).run(text)) return false;
  proofs.push_back(text.take());
  return true;
}

constexpr int kDeepest = 5;  // parts of parts

bool prove_parts(const PairOfPieces& pair, const Part& part, int depth, std::vector<double>& cuts,
                 std::vector<std::string>& proofs) {
  Question question = pair.question;
  question.horizon = {part.from, part.until};
  const PairOfPieces now{pair.a, pair.b, question, pair.agent, pair.obstacle};
  Text text;
  if (prove_out(now, text) || prove_part(now, part, text)) {
    proofs.push_back(text.take());
    return true;
  }
  const Vector3d w = question.v_a - question.v_b;
  if (depth == kDeepest || w.isZero(0) || !(part.from < part.until))
    return prove_by_halves(now, part, proofs);
  // A way without end: until they have passed, and after.
  double middle = 0.5 * (part.from + part.until);
  if (std::isinf(part.until)) {
    const Eigen::Vector3d c = question.obstacle.at() - question.agent.at();
    middle = part.from + std::max(c.norm(), 1.0) / w.norm() * (depth == 0 ? 1.0 : 2.0);
  }
  middle = static_cast<double>(static_cast<float>(middle));
  if (!(part.from < middle && middle < part.until)) return prove_by_halves(now, part, proofs);
  if (!prove_parts(pair, {part.from, middle}, depth + 1, cuts, proofs)) return false;
  cuts.push_back(middle);
  return prove_parts(pair, {middle, part.until}, depth + 1, cuts, proofs);
}

}  // namespace

bool prove_out_by_forms(const PairOfPieces& pair, Text& proof) {
  std::vector<double> cuts;
  std::vector<std::string> proofs;
  if (!prove_parts(pair, {pair.question.horizon.from, pair.question.horizon.until}, 0, cuts, proofs))
    return false;
  if (cuts.empty()) {
    proof.raw(proofs.front());
    return true;
  }
  const char* between = "{\"rule\": \"times\", \"cuts\": [";
  for (const double cut_at : cuts) {
    proof.raw(between).number(cut_at);
    between = ", ";
  }
  between = "], \"proofs\": [";
  for (const std::string& one : proofs) {
    proof.raw(between).raw(one);
    between = ", ";
  }
  proof.raw("]}");
  return true;
}

}  // namespace vericone::certificates
