// SPDX-License-Identifier: GPL-3.0-or-later
#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/cones/planar/sector.h>
#include <vericone/internal/cones/ellipsoids/contact_frame.h>
#include <vericone/internal/cones/ellipsoids/rungs.h>
#include <vericone/internal/verify/predicates/truth.h>

#include <cmath>
#include <utility>
#include <vector>

#include "predicates/cases.h"
#include "predicates/subjects.h"

namespace vericone::verify {
namespace {

using cases::Kind;
using cases::kind_of;
using cases::Tangency;

/// Velocity i of a block: on the boundary of the cone, a few ulps from it, near it, anywhere.
template <int D>
Eigen::Matrix<double, D, 1> velocity(SeededRandom& random, const Tangency<D>& t, Kind kind, int i,
                                     bool& is_random) {
  using Vector = Eigen::Matrix<double, D, 1>;
  const Vector& w = t.grazing;
  const Vector c = t.b.center() - t.a.center();
  is_random = false;
  switch (i) {
    case 0:
      return w;
    case 1:
      return -w;
    case 2: {
      // Exact multiples: the length of a velocity is of no importance.
      const double factor = std::ldexp(random.integer(1, 7), random.integer(-60, 60));
      return factor * w;
    }
    case 3:
    case 4:
    case 5:
      return cases::jittered<D>(random, w, i == 3 ? 1 : 8);
    case 6:
    case 7: {
      const double off = cases::log_uniform(random, -16, -3) * w.norm();
      const Vector e = random.direction<D>();
      return w + off * e;
    }
    case 8:
      return c;
    case 9: {
      Vector axis = Vector::Zero();
      axis(random.integer(0, D - 1)) = random.coin() ? 1 : -1;
      return axis;
    }
    default: {
      is_random = kind == Kind::regular;
      const Vector e = random.direction<D>();
      if (i < 13) return e;
      return c / c.norm() + random.uniform(0, 1.5) * e;
    }
  }
}

/// ConeOracle with ConeTruth, SectorOracle with SectorTruth.
template <int D, typename Oracle, typename Truth>
void run_membership(std::uint32_t stream, std::uint64_t seed, std::uint64_t number, Depth depth,
                    Block& block) {
  using Vector = Eigen::Matrix<double, D, 1>;
  SeededRandom random(stream, seed, number);
  const Kind kind = kind_of(number);
  // Rounding may let bodies overlap that were to be a hair apart: the next pair then.
  for (;;) {
    const Tangency<D> t = cases::tangency<D>(random, kind, false);
    const Oracle oracle(t.a, t.b);
    std::array<Vector, kCasesPerBlock> w;
    for (int i = 0; i < kCasesPerBlock; ++i) w[i] = velocity<D>(random, t, kind, i, block.cases[i].random);
    if (oracle.relation() != Relation::disjoint) continue;
    climb_all(block, [&](int i, Rung* rung) { return code(oracle.membership(w[i], rung)); });
    for (int i = 0; i < kCasesPerBlock; ++i) {
      PredicateCase& c = block.cases[i];
      c.naive = code(oracle.naive_membership(w[i]));
      c.triage = code(oracle.triage_membership(w[i]));
      c.interval = code(oracle.interval_membership(w[i], Vector::Zero()));
      if (depth.exact) c.exact = code(oracle.exact_membership(w[i], Vector::Zero()));
    }
    if (depth.truth) {
      const Truth truth(t.a, t.b);
      if (truth.relation() != Relation::disjoint) {
        for (PredicateCase& c : block.cases) c.truth = code(Membership::out) + 1;  // none of the answers
        return;
      }
      for (int i = 0; i < kCasesPerBlock; ++i) block.cases[i].truth = code(truth.membership(w[i]));
    }
    return;
  }
}

void run_cone(std::uint64_t seed, std::uint64_t number, Depth depth, Block& block) {
  run_membership<3, ConeOracle, ConeTruth>(300, seed, number, depth, block);
}
void run_sector(std::uint64_t seed, std::uint64_t number, Depth depth, Block& block) {
  run_membership<2, SectorOracle, SectorTruth>(301, seed, number, depth, block);
}
bool on_boundary(int answer) { return answer == code(Membership::on); }

/// Body B of case i of a block: at the contact, a few ulps from it, near it, anywhere from `hard` on.
template <int D>
BasicEllipsoid<D> other_body(SeededRandom& random, const Tangency<D>& t, Kind kind, int i, int hard,
                             bool& is_random) {
  using Vector = Eigen::Matrix<double, D, 1>;
  const Vector c = t.b.center() - t.a.center();
  is_random = false;
  if (i >= hard) i = kCasesPerBlock - 1;
  if (i == 0) return t.b;
  if (i < 5) return cases::moved_to<D>(t.b, cases::jittered<D>(random, t.b.center(), i == 1 ? 1 : 8));
  if (i < 9) {
    const double off = cases::log_uniform(random, -16, -3);
    return cases::moved_to<D>(t.b, t.a.center() + (random.coin() ? 1 + off : 1 - off) * c);
  }
  is_random = kind == Kind::regular;
  const double factor = random.uniform(0, 2.5);
  return cases::moved_to<D>(t.b, t.a.center() + factor * c);
}

template <int D>
void run_relation(std::uint64_t seed, std::uint64_t number, Depth depth, Block& block) {
  SeededRandom random(302 + D, seed, number);
  const Kind kind = kind_of(number);
  const Tangency<D> t = cases::tangency<D>(random, kind, true);
  // The exact rung takes 0.1 ms: one block in sixteen is hard, three more have one case at the contact.
  const std::uint64_t round = number / cases::kKinds;
  const int hard = round % 16 == 0 ? 9 : round % 4 == 0 ? 1 : 0;
  std::vector<BasicEllipsoid<D>> b;
  for (int i = 0; i < kCasesPerBlock; ++i)
    b.push_back(other_body<D>(random, t, kind, i, hard, block.cases[i].random));
  climb_all(block, [&](int i, Rung* rung) { return code(relation<D>(t.a, b[i], rung)); });
  for (int i = 0; i < kCasesPerBlock; ++i) {
    PredicateCase& c = block.cases[i];
    const ContactFrame<D> frame(t.a, b[i]);
    c.naive = code(frame.contact > 1    ? Relation::disjoint
                   : frame.contact == 1 ? Relation::touching
                                        : Relation::overlapping);
    c.triage = code(triage_relation<D>(t.a, b[i], frame));
    c.interval = code(interval_relation<D>(t.a, b[i], frame));
    if (depth.exact) c.exact = code(exact_relation<D>(t.a, b[i]));
    if (depth.truth) c.truth = code(relation_truth<D>(t.a, b[i]));
  }
}
bool touches(int answer) { return answer == code(Relation::touching); }

/// TruePosition has the order of Position.
static_assert(code(TruePosition::equal) == code(Position::equal) &&
              code(TruePosition::a_inside_b_touching) == code(Position::a_inside_b_touching) &&
              code(TruePosition::crossing) == code(Position::crossing));

/// Nested bodies, from the inside and from the outside of each other, and equal ones.
template <int D>
void run_position(std::uint64_t seed, std::uint64_t number, Depth depth, Block& block) {
  using Vector = Eigen::Matrix<double, D, 1>;
  using Body = BasicEllipsoid<D>;
  SeededRandom random(306 + D, seed, number);
  const Kind kind = kind_of(number);
  const Tangency<D> t = cases::nesting<D>(random, kind);
  // The exact rung takes up to a millisecond: one block in 32 is hard, one more has a case at the contact.
  const std::uint64_t round = number / cases::kKinds;
  const int hard = round % 32 == 0 ? 9 : round % 32 == 16 ? 1 : 0;
  std::vector<std::pair<Body, Body>> pairs;
  for (int i = 0; i < kCasesPerBlock; ++i) {
    bool& is_random = block.cases[i].random;
    is_random = false;
    Body b = t.b;
    const int what = i < hard ? i : kCasesPerBlock;
    if (what == 0) {
      b = random.integer(0, 3) ? t.b : t.a;
    } else if (what < 5) {
      b = cases::moved_to<D>(t.b, cases::jittered<D>(random, t.b.center(), what == 1 ? 1 : 8));
    } else if (what < 9) {
      const double off = cases::log_uniform(random, -16, -3);
      const double factor = random.coin() ? 1 + off : 1 - off;
      b = cases::moved_to<D>(cases::moved_to<D>(t.b, Vector::Zero()).scaled(factor), t.b.center());
    } else {
      is_random = kind == Kind::regular;
      const double factor = cases::log_uniform(random, -1, 1), shift = random.uniform(0, 3);
      b = cases::moved_to<D>(cases::moved_to<D>(t.b, Vector::Zero()).scaled(factor),
                             t.a.center() + shift * t.a.factor() * random.direction<D>());
    }
    if (i % 2)
      pairs.emplace_back(t.a, b);
    else
      pairs.emplace_back(b, t.a);
  }
  climb_all(block,
            [&](int i, Rung* rung) { return code(position<D>(pairs[i].first, pairs[i].second, rung)); });
  for (int i = 0; i < kCasesPerBlock; ++i) {
    PredicateCase& c = block.cases[i];
    const auto& [a, b] = pairs[i];
    c.triage = code(triage_position<D>(a, b));
    c.interval = code(interval_position<D>(a, b));
    if (depth.exact) c.exact = code(exact_position<D>(a, b));
    if (depth.truth) c.truth = code(position_truth<D>(a, b));
  }
}
bool positions_touch(int answer) {
  return answer == code(Position::touching) || answer == code(Position::a_inside_b_touching) ||
         answer == code(Position::b_inside_a_touching) || answer == code(Position::equal);
}

constexpr Subject kSubjects[] = {
    {"relation of ellipsoids", run_relation<3>, touches},
    {"relation of ellipses", run_relation<2>, touches},
    {"position of ellipsoids", run_position<3>, positions_touch},
    {"position of ellipses", run_position<2>, positions_touch},
    {"velocity, cone of ellipsoids", run_cone, on_boundary},
    {"velocity, sector of ellipses", run_sector, on_boundary},
};

}  // namespace

std::span<const Subject> pair_subjects() { return kSubjects; }

}  // namespace vericone::verify
