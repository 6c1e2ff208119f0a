// SPDX-License-Identifier: GPL-3.0-or-later
//
// libFuzzer entry: 21 doubles are two bodies (centre, shape) and a velocity; all rungs must agree.
#include "fuzz/fuzz_membership.h"

#include <vericone/cones/ellipsoids/exact_predicates.h>
#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/internal/cones/ellipsoids/rungs.h>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>

namespace vericone::fuzz {
namespace {

using Eigen::Vector3d;

void require(bool holds, const char* what, const Doubles& input) {
  if (holds) return;
  std::fprintf(stderr, "%s, for", what);
  for (const double x : input) std::fprintf(stderr, " %a", x);
  std::fprintf(stderr, "\n");
  std::abort();
}

std::optional<Ellipsoid> body(const double* x) {
  Eigen::Matrix3d s;
  s << x[3], x[4], x[5], x[4], x[6], x[7], x[5], x[7], x[8];
  try {
    return Ellipsoid::from_shape({x[0], x[1], x[2]}, s);
  } catch (const InputError&) {  // not a body: the answer to most inputs
    return std::nullopt;
  }
}

template <typename Answer>
bool agrees(const std::optional<Answer>& answer, Answer truth) {
  return !answer || *answer == truth;
}

}  // namespace

bool check_membership(const Doubles& input) {
  const auto a = body(input.data()), b = body(input.data() + 9);
  const Vector3d w(input[18], input[19], input[20]), zero = Vector3d::Zero();
  if (!a || !b) return false;
  const Relation relation = exact_relation<3>(*a, *b);
  require(vericone::relation<3>(*a, *b) == relation, "relation by the ladder is not the exact one", input);
  require(vericone::relation<3>(*b, *a) == relation, "relation is not symmetric", input);
  require(exact::relation<3>(exact::RationalBody<3>(*a), exact::RationalBody<3>(*b)) == relation,
          "relation of the rational bodies differs", input);
  const ConeOracle oracle(*a, *b);
  require(oracle.relation() == relation, "the oracle's relation is not the exact one", input);
  if (relation != Relation::disjoint) return true;
  if (!w.allFinite()) {
    require(!oracle.triage_membership(w), "an answer of the first rung for a velocity that is not finite",
            input);
    require(!oracle.interval_membership(w, zero),
            "an answer of the second rung for a velocity that is not finite", input);
    try {
      static_cast<void>(oracle.membership(w));
      require(false, "no error for a velocity that is not finite", input);
    } catch (const InputError&) {
    }
    return true;
  }
  const Membership truth = oracle.exact_membership(w, zero);
  require(agrees(oracle.triage_membership(w), truth), "the first rung is wrong", input);
  require(agrees(oracle.interval_membership(w, zero), truth), "the second rung is wrong", input);
  require(oracle.membership(w) == truth, "the ladder is wrong", input);
  require(ConeOracle(*b, *a).exact_membership(-w, zero) == truth, "swapping the bodies changes the answer",
          input);
  return true;
}

}  // namespace vericone::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  vericone::fuzz::Doubles input{};
  if (size < sizeof(input)) return 0;
  std::memcpy(input.data(), data, sizeof(input));
  vericone::fuzz::check_membership(input);
  return 0;
}
