// SPDX-License-Identifier: BSD-3-Clause
//
// What all oracles of velocities share: the climb, the past told from never, and the whole answer.
#pragma once

#include <vericone/cones/answers.h>
#include <vericone/geometry/error.h>
#include <vericone/geometry/sign.h>
#include <cmath>
#include <optional>
#include <string>

namespace vericone {

template <typename Velocity>
void require_finite_velocity(const Velocity& v, const char* field) {
  for (int i = 0; i < v.size(); ++i)
    if (!std::isfinite(v(i)))
      throw InputError(std::string(field) + "[" + std::to_string(i) + "]", to_text(v(i)),
                       "a finite number (m/s)");
}

/// The lower rungs have no answer for numbers that are not finite, so those are looked for after them. A
/// difference of doubles is zero only where they are equal.
template <typename Predicate, typename Oracle, typename Velocity>
Membership climb_membership(const Oracle& oracle, const Velocity& v_a, const Velocity& v_b, Rung* rung) {
  return climb<Predicate>(
      rung, [&] { return oracle.triage_membership(v_a - v_b); },
      [&] { return oracle.interval_membership(v_a, v_b); },
      [&] {
        require_finite_velocity(v_a, "agent_velocity");
        require_finite_velocity(v_b, "obstacle_velocity");
        return oracle.exact_membership(v_a, v_b);
      });
}

template <typename Oracle, typename Velocity>
Passage passage_by_membership(const Oracle& oracle, const Velocity& w) {
  const Membership ahead = oracle.membership(w);
  if (ahead != Membership::out) return ahead == Membership::in ? Passage::ahead : Passage::ahead_grazing;
  const Membership behind = oracle.membership(Velocity(-w));
  if (behind != Membership::out) return behind == Membership::in ? Passage::behind : Passage::behind_grazing;
  return Passage::never;
}

/// `membership()` is asked for disjoint bodies only.
template <typename Ask>
Verdict verdict_of(Relation relation, const Ask& membership) {
  if (relation == Relation::overlapping) return Verdict::overlapping;
  if (relation == Relation::touching) return Verdict::touching;
  switch (membership()) {
    case Membership::in:
      return Verdict::in;
    case Membership::on:
      return Verdict::on;
    case Membership::out:
      break;
  }
  return Verdict::out;
}

}  // namespace vericone
