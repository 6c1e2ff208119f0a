// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/verdicts/groups.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "certificate/convex_pair.h"
#include "certificate/forms/forms.h"
#include "certificate/polytopes.h"

namespace vericone::certificates {
namespace {

using Eigen::Vector3d;

constexpr double kRoundings = 32 * 0x1p-53;  // more than any sum below has

/// At most the least n.x over a piece, and at least the greatest. `reach`: of all coordinates of corners.
struct Span {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};
Span span_of(const Piece& piece, const Vector3d& n, const Vector3d& at, const Vector3d& reach) {
  const Vector3d size = n.cwiseAbs();
  const double place = n.dot(at), around = size.dot(at.cwiseAbs());
  const Ellipsoid* body = piece.round();
  if (!body) {
    Span span;
    for (const Vector3d& x : piece.corners) {
      const double value = n.x() * x.x() + n.y() * x.y() + n.z() * x.z();
      span.low = std::min(span.low, value);
      span.high = std::max(span.high, value);
    }
    const double slack = kRoundings * (size.dot(reach) + around);
    return {span.low + place - slack, span.high + place + slack};
  }
  double square = 0;
  if (body->defined_by_factor()) {
    for (int j = 0; j < 3; ++j) {
      const double along =
          std::abs(body->factor().col(j).dot(n)) + kRoundings * body->factor().col(j).cwiseAbs().dot(size);
      square += along * along;
    }
  } else {
    const Eigen::Matrix3d& s = body->shape();
    square = std::max(0.0, n.dot(s * n)) + kRoundings * size.dot(s.cwiseAbs() * size);
  }
  const double radius = std::sqrt(square), value = n.dot(body->center()) + place;
  const double slack = radius + kRoundings * (size.dot(body->center().cwiseAbs()) + around + radius);
  return {value - slack, value + slack};
}

Vector3d rounded(const Vector& n) {
  int most = 0;
  for (const Integer& e : n)
    if (!e.is_zero()) most = std::max(most, exact::log2_floor(e));
  return {to_double(n[0], -most), to_double(n[1], -most), to_double(n[2], -most)};
}

}  // namespace

Groups::Side::Side(const Stated& stated) : body(stated) {
  pieces.reserve(stated.size());
  middles.reserve(stated.size());
  for (std::size_t i = 0; i < stated.size(); ++i) {
    pieces.push_back(stated.piece(i));
    if (const auto* body_of = pieces.back().convex) {
      convex = true;
      middles.push_back(body_of->middle());
      continue;
    }
    Vector3d sum = Vector3d::Zero();
    for (const Vector3d& x : pieces.back().corners) {
      sum += x;
      reach = reach.cwiseMax(x.cwiseAbs());
    }
    middles.push_back(pieces.back().round()
                          ? pieces.back().round()->center()
                          : Vector3d(sum / static_cast<double>(pieces.back().corners.size())));
  }
}

Groups::Groups(const Question& question) : question_(question), a_(question.agent), b_(question.obstacle) {}

PairOfPieces Groups::pair(std::uint32_t i, std::uint32_t j) const {
  PairOfPieces pair{a_.pieces[i], b_.pieces[j], question_, {}, {}};
  if (a_.body.has_pieces()) pair.agent = i;
  if (b_.body.has_pieces()) pair.obstacle = j;
  return pair;
}

/// Whether the plane keeps all pairs apart, by bounds of doubles.
bool Groups::holds(const Plane& plane, const Set& a, const Set& b) const {
  const Vector3d n = rounded(plane.normal);
  double from = std::numeric_limits<double>::infinity(), until = -from;
  for (const std::uint32_t j : b) from = std::min(from, span_of(b_.pieces[j], n, b_.body.at(), b_.reach).low);
  for (const std::uint32_t i : a)
    until = std::max(until, span_of(a_.pieces[i], n, a_.body.at(), a_.reach).high);
  const double gap = from - until - kRoundings * (std::abs(from) + std::abs(until));
  if (!(gap > 0)) return false;
  const Vector3d size = n.cwiseAbs(), w = question_.v_a - question_.v_b;
  if (plane.across || w.isZero(0)) return true;
  const double along = n.dot(w),
               slack = kRoundings * size.dot(question_.v_a.cwiseAbs() + question_.v_b.cwiseAbs());
  for (const double t : {question_.horizon.from, question_.horizon.until}) {
    if (std::isinf(t)) {
      if (along + slack > 0 && !(slack == 0 && along <= 0)) return false;
    } else if (!(gap > t * (along + slack) * (along + slack > 0 ? 1 + kRoundings : 1 - kRoundings))) {
      return false;
    }
  }
  return true;
}

std::optional<Plane> Groups::plane_of_convex(const Set& a, const Set& b) const {
  const auto together = [](const Side& side, const Set& set) {
    RoundedHull all{side.body.at(), {}};
    if (set.size() == side.pieces.size() && !side.body.triangles().empty())
      append(all, Piece{side.body.points()});
    else
      for (const std::uint32_t i : set) append(all, side.pieces[i]);
    return all;
  };
  const RoundedHull agent = together(a_, a), obstacle = together(b_, b);
  return ConvexPair(agent, obstacle, question_.v_a, question_.v_b, question_.horizon).plane();
}

/// One plane for all of them, from the hulls of their corners and centers; nothing where none is found.
std::optional<Plane> Groups::plane_of(const Set& a, const Set& b) const {
  if (a_.convex || b_.convex) return plane_of_convex(a, b);
  const auto together = [](const Side& side, const Set& set) {
    if (set.size() == 1) return side.pieces[set.front()];
    Piece all;
    if (set.size() == side.pieces.size() && !side.body.points().empty()) {
      all.corners = side.body.points();
      return all;
    }
    for (const std::uint32_t i : set) {
      const Piece& piece = side.pieces[i];
      if (const Ellipsoid* body = piece.round())
        all.corners.push_back(body->center());
      else
        all.corners.insert(all.corners.end(), piece.corners.begin(), piece.corners.end());
    }
    return all;
  };
  const Piece of_a = together(a_, a), of_b = together(b_, b);
  if (a.size() == 1 && b.size() == 1) return plane_between({of_a, of_b, question_, {}, {}});
  if (of_a.round() && of_b.round()) return std::nullopt;
  const PolytopePair pair(of_a, a_.body.at(), of_b, b_.body.at(), question_.v_a, question_.v_b,
                          question_.horizon, PolytopePair::kProposals);
  for (const Plane& plane : pair.proposals())
    if (holds(plane, a, b)) return plane;
  return std::nullopt;
}

/// Where the pieces of a set lie, cut across its longest side.
std::pair<Groups::Set, Groups::Set> Groups::halves(const Side& side, const Set& set) {
  Vector3d low = side.middles[set.front()], high = low;
  for (const std::uint32_t i : set)
    low = low.cwiseMin(side.middles[i]), high = high.cwiseMax(side.middles[i]);
  int axis = 0;
  (high - low).maxCoeff(&axis);
  Set sorted = set;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end(), [&](std::uint32_t i, std::uint32_t j) {
    return std::pair(side.middles[i](axis), i) < std::pair(side.middles[j](axis), j);
  });
  std::pair<Set, Set> parts{{sorted.begin(), middle}, {middle, sorted.end()}};
  std::sort(parts.first.begin(), parts.first.end());
  std::sort(parts.second.begin(), parts.second.end());
  return parts;
}

/// Leaves that cover the body that is divided; the other one is divided where a leaf has one piece left.
bool Groups::cover(const Set& a, const Set& b, bool divide_agent, std::vector<Leaf>& leaves) {
  const Set& divided = divide_agent ? a : b;
  if (const auto plane = plane_of(a, b)) {
    Text text;
    write(text, *plane);
    leaves.push_back({divided, text.take()});
    return true;
  }
  if (divided.size() > 1) {
    const auto [first, second] = halves(divide_agent ? a_ : b_, divided);
    return divide_agent ? cover(first, b, true, leaves) && cover(second, b, true, leaves)
                        : cover(a, first, false, leaves) && cover(a, second, false, leaves);
  }
  Text text;
  if ((divide_agent ? b : a).size() > 1) {
    if (!prove_all(a, b, text)) return false;
  } else {
    const PairOfPieces one = pair(a.front(), b.front());
    const bool proved = one.has_dents() && !one.has_convex() ? prove_out_by_forms(one, text)
                                                             : touching_ && certificates::prove_on(one, text);
    if (!proved) return false;
  }
  leaves.push_back({divided, text.take()});
  return true;
}

bool Groups::prove_all(const Set& a, const Set& b, Text& proof) {
  const bool divide_agent = a.size() > b.size();
  std::vector<Leaf> leaves;
  if (!cover(a, b, divide_agent, leaves)) return false;
  if (leaves.size() == 1) {
    proof.raw(leaves.front().proof);
    return true;
  }
  const Set& divided = divide_agent ? a : b;
  std::vector<std::uint32_t> leaf_of(divided.back() + 1);
  for (std::uint32_t k = 0; k < leaves.size(); ++k)
    for (const std::uint32_t i : leaves[k].set) leaf_of[i] = k;
  proof.raw("{\"rule\": \"groups\", \"of\": ").raw(divide_agent ? "\"agent\"" : "\"obstacle\"");
  const char* between = ", \"proofs\": [";
  for (const Leaf& leaf : leaves) {
    proof.raw(between).raw(leaf.proof);
    between = ", ";
  }
  between = "], \"runs\": [[";
  for (std::size_t i = 0, next = 0; i < divided.size(); i = next) {
    const std::uint32_t k = leaf_of[divided[i]];
    while (next < divided.size() && leaf_of[divided[next]] == k) ++next;
    proof.raw(between).index(k).raw(", ").index(next - i).raw("]");
    between = ", [";
  }
  proof.raw("]}");
  return true;
}

namespace {

std::vector<std::uint32_t> all_of(std::size_t count) {
  std::vector<std::uint32_t> all(count);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

}  // namespace

bool Groups::prove_out(Text& proof, bool touching) {
  touching_ = touching;
  // Of two bodies that touch no plane need be looked for.
  if (touching && a_.pieces.size() == 1 && b_.pieces.size() == 1) {
    const PairOfPieces one = pair(0, 0);
    if (!one.has_dents() && certificates::prove_on(one, proof)) return true;
  }
  return prove_all(all_of(a_.pieces.size()), all_of(b_.pieces.size()), proof);
}

bool Groups::find_in(const Set& a, const Set& b, Text& proof) {
  if (a.size() == 1 && b.size() == 1) {
    const PairOfPieces one = pair(a.front(), b.front());
    return one.has_dents() && !one.has_convex() ? prove_in_of_forms(one, proof)
                                                : certificates::prove_in(one, proof);
  }
  if (plane_of(a, b)) return false;
  if (a.size() > b.size()) {
    const auto [first, second] = halves(a_, a);
    return find_in(first, b, proof) || find_in(second, b, proof);
  }
  const auto [first, second] = halves(b_, b);
  return find_in(a, first, proof) || find_in(a, second, proof);
}

bool Groups::prove_in(Text& proof) {
  return find_in(all_of(a_.pieces.size()), all_of(b_.pieces.size()), proof);
}

}  // namespace vericone::certificates
