// SPDX-License-Identifier: BSD-3-Clause
//
// The laws that every family of pairs obeys (velocity_predicate.h), for any test framework: a text says which
// law is broken and how, an empty one that all hold.
//
//   const std::string broken = testing::broken_velocity_law(HullOracle(a, b), HullOracle(b, a), w);
#pragma once

#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/internal/cones/velocity_predicate.h>
#include <cmath>
#include <optional>
#include <string>

namespace vericone::testing {

/// For one velocity w of bodies a, b; `ba` is the pair exchanged.
///   exchanged   verdict(a, b; w) is verdict(b, a; -w)
///   difference  verdicts depend on v_a - v_b only
///   length      and on its direction only
///   rest        w = 0 of disjoint bodies is `out`
///   pointed     no velocity collides both forwards and backwards (convex bodies: `pointed`)
///   ladder      a rung that answers agrees with the last one, and never says `on`
template <typename Velocity, typename Predicate, typename Exchanged>
requires VelocityPredicate<Predicate, Velocity> && VelocityPredicate<Exchanged, Velocity> std::string
broken_velocity_law(const Predicate& ab, const Exchanged& ba, const Velocity& w, bool pointed = false) {
  const Velocity still = Velocity::Zero();
  const auto said = [](const char* law, Verdict first, Verdict second) {
    return std::string(law) + ": " + to_string(first) + " and " + to_string(second);
  };
  const Verdict verdict = ab.verdict(w, still);
  if (const Verdict other = ba.verdict(still, w); other != verdict) return said("exchanged", verdict, other);
  if (const Verdict other = ab.verdict(still, Velocity(-w)); other != verdict)
    return said("difference", verdict, other);
  for (const double scale : {0x1p-40, 0x1p300}) {
    const Velocity scaled = scale * w;
    if (Velocity(scaled / scale) != w) continue;
    if (const Verdict other = ab.verdict(scaled, still); other != verdict)
      return said("length", verdict, other);
  }
  const std::optional<Relation> relation = ab.relation();
  if (!relation || *relation != Relation::disjoint) return "";
  if (const Verdict other = ab.verdict(still, still); other != Verdict::out)
    return said("rest", Verdict::out, other);
  const auto meets = [](Verdict v) { return v == Verdict::in || v == Verdict::on; };
  if (pointed && meets(verdict) && meets(ab.verdict(Velocity(-w), still))) return "pointed: ahead and behind";
  if constexpr (LadderPredicate<Predicate, Velocity>) {
    const Membership exact = ab.exact_membership(w, still);
    const auto triage = ab.triage_membership(w), interval = ab.interval_membership(w, still);
    for (const auto& lower : {triage, interval})
      if (lower && (*lower != exact || *lower == Membership::on))
        return std::string("ladder: ") + to_string(*lower) + " below " + to_string(exact);
    Rung by{};
    if (ab.membership(w, &by) != exact) return "ladder: the climb ends in another answer";
    if (by != (triage ? Rung::triage : interval ? Rung::interval : Rung::exact))
      return std::string("ladder: decided by ") + to_string(by);
  }
  return "";
}

}  // namespace vericone::testing
