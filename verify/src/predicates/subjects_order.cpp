// SPDX-License-Identifier: GPL-3.0-or-later
#include <vericone/internal/cones/times/order.h>
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

bool is_zero(int answer) { return answer == code(Sign::zero); }

/// Tangents of two sectors: parallel, the same, a few ulps apart, anywhere.
void run_turn(std::uint64_t seed, std::uint64_t number, Depth depth, Block& block) {
  SeededRandom random(360, seed, number);
  const Kind kind = kind_of(number);
  // The exact rung takes half a millisecond: one block in sixteen is hard, three more have a degenerate case.
  const std::uint64_t round = number / cases::kKinds;
  const bool hard = round % 16 == 0;
  for (;;) {
    auto [p, q] = kind == Kind::exact ? cases::parallel_tangencies(random)
                                      : std::pair(cases::tangency<2>(random, kind, false),
                                                  cases::tangency<2>(random, kind, false));
    if (relation<2>(p.a, p.b) != Relation::disjoint || relation<2>(q.a, q.b) != Relation::disjoint) continue;
    std::vector<std::pair<TangentRef, TangentRef>> pairs;
    bool usable = true;
    for (int i = 0; i < kCasesPerBlock; ++i) {
      PredicateCase& c = block.cases[i];
      TangentRef first{p.a, p.b, random.coin()}, second{q.a, q.b, random.coin()};
      const int what = hard || (i == 0 && round % 4 == 0) ? i : kCasesPerBlock;
      c.random = what > 7 && kind == Kind::regular;
      if (what == 0 && kind != Kind::exact) {
        second = first;
      } else if (what == 1) {
        second = {p.b, p.a, first.left};  // the other way along the same line
      } else if (what < 8 && what > 1) {
        if (kind != Kind::exact) second = first;
        second.b =
            cases::moved_to<2>(second.b, cases::jittered<2>(random, second.b.center(), what < 4 ? 1 : 8));
        usable = usable && relation<2>(second.a, second.b) == Relation::disjoint;
      } else if (what > 7) {
        // Another place for B: every direction is then another one.
        const Eigen::Vector2d line = second.b.center() - second.a.center();
        Eigen::Vector2d turned(line.y(), -line.x());
        if (random.coin()) turned = -turned;
        const double part = random.uniform(0.1, 1);
        second.b = cases::moved_to<2>(second.b, second.b.center() + part * turned);
        if (relation<2>(second.a, second.b) != Relation::disjoint) second.b = q.b;
      }
      pairs.emplace_back(first, second);
    }
    if (!usable) continue;
    climb_all(block, [&](int i, Rung* rung) { return code(turn(pairs[i].first, pairs[i].second, rung)); });
    for (int i = 0; i < kCasesPerBlock; ++i) {
      PredicateCase& c = block.cases[i];
      const auto& [first, second] = pairs[i];
      c.triage = code(triage_turn(first, second));
      c.interval = code(interval_turn(first, second));
      if (depth.exact) c.exact = code(exact_turn(first, second));
      if (depth.truth)
        c.truth = code(turn_truth(first.a, first.b, first.left, second.a, second.b, second.left));
    }
    return;
  }
}

/// A meets B at the time 1, exactly: it stands back by w from where they touch.
Encounter meeting_on_time(SeededRandom& random) {
  const cases::Tangency<3> t = cases::tangency<3>(random, Kind::exact, true);
  Eigen::Vector3d w;
  do {
    for (int i = 0; i < 3; ++i) w(i) = t.size * random.integer(-20, 20);
  } while (w.dot(t.normal) == 0);
  if (w.dot(t.normal) < 0) w = -w;
  return {cases::moved_to<3>(t.a, t.a.center() - w), t.b, w};
}

/// Encounters that are the same in disguise, others at the same time, a few ulps apart, anywhere.
void run_earlier(std::uint64_t seed, std::uint64_t number, Depth depth, Block& block) {
  SeededRandom random(361, seed, number);
  const Kind kind = kind_of(number);
  const std::uint64_t round = number / cases::kKinds;
  const bool hard = round % 16 == 0, on_time = hard && kind == Kind::exact && random.coin();
  const auto encounter = [&] {
    if (on_time) return meeting_on_time(random);
    const cases::Tangency<3> t = cases::tangency<3>(random, kind, false);
    // Between the grazing velocity and the line of centres, which hits; some hardly hit.
    const double part = hard && random.coin() ? cases::log_uniform(random, -16, 0) : random.uniform(0.05, 1);
    const Eigen::Vector3d c = t.b.center() - t.a.center();
    return Encounter{t.a, t.b, part * c + (1 - part) * t.grazing};
  };
  const Encounter p = encounter(), q = encounter();
  std::vector<std::pair<Encounter, Encounter>> pairs;
  for (int i = 0; i < kCasesPerBlock; ++i) {
    PredicateCase& c = block.cases[i];
    const int what = hard || (i == 0 && round % 4 == 0) ? i : kCasesPerBlock;
    c.random = !hard && what > 7 && kind == Kind::regular;
    Encounter other = what < 8 ? p : q;
    if (what == 0) {
      other = {p.b, p.a, -p.w};
    } else if (what == 1) {
      other = {p.a.scaled(2), p.b.scaled(2), 2 * p.w};
    } else if (what < 5) {
      if (on_time) other = q;
      if (what > 2 || !on_time) other.w = cases::jittered<3>(random, other.w, what == 2 ? 1 : 8);
    } else if (what < 8) {
      other.b = cases::moved_to<3>(p.b, cases::jittered<3>(random, p.b.center(), 8));
    } else {
      other.w *= random.uniform(0.1, 5);
    }
    pairs.emplace_back(p, other);
  }
  climb_all(block, [&](int i, Rung* rung) { return code(earlier(pairs[i].first, pairs[i].second, rung)); });
  for (int i = 0; i < kCasesPerBlock; ++i) {
    PredicateCase& c = block.cases[i];
    const auto& [first, second] = pairs[i];
    c.triage = code(triage_earlier(first, second));
    c.interval = code(interval_earlier(first, second));
    if (depth.exact) c.exact = code(exact_earlier(first, second));
    if (depth.truth) c.truth = code(earlier_truth(first.a, first.b, first.w, second.a, second.b, second.w));
  }
}

constexpr Subject kSubjects[] = {{"order of tangents", run_turn, is_zero},
                                 {"order of times to contact", run_earlier, is_zero}};

}  // namespace

std::span<const Subject> order_subjects() { return kSubjects; }

}  // namespace vericone::verify
