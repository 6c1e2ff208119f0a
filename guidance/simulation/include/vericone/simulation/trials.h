// SPDX-License-Identifier: BSD-3-Clause
//
// The same flight under many laws and much noise: Monte Carlo trials as the source's 7.5 has them, but every
// outcome proved, and every law on the same noise.
#pragma once

#include <vericone/simulation/run.h>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace vericone::simulation {

/// How the agents of a trial fly: the pilots of the scenario, changed as said. The first four are the
/// source's.
enum class TrialLaw : std::uint8_t {
  di,           // the inversion (6.17) alone, rates from one step to the next
  di_filter,    // with the source's filters of y, psi' and theta_b'
  rdi,          // with the outer loop (7.14)
  rdi_filter,   // with both
  di_rates,     // as di, with filtered rates alone
  di_analytic,  // as di, with the rates in closed form of what is measured
  di_state,     // as di_analytic, of an estimated state
  di_margin,    // as di_state, out of the cone by three deviations of y
  clearance,    // the clearance law on an estimated state, bodies apart by three deviations of the miss more
  robust,       // the clearance law on an estimated state, for all errors within three deviations of it
  own,          // as the scenario has them: any pilots and laws
};
[[nodiscard]] const char* to_string(TrialLaw law);

/// How noisy: parts of position and velocity along each axis (7.27), or the scenario's own sensor times a
/// number.
struct TrialLevel {
  std::string name;  // "7.5:15" in percent, or "x4"
  std::optional<Sensor> sensor;
  double times = 1;
};

/// The scenario that is flown. `own` takes any; the others change every pilot about bodies, and throw
/// InputError naming "bodies" where there is none, "law" where one does not have the law avoidance. Throws
/// InputError naming "--levels" where sensors are to be multiplied and there are none, by 1 excepted.
[[nodiscard]] Scenario trial_scenario(const Scenario& scenario, TrialLaw law, const TrialLevel& level);

struct TrialOutcome {
  /// Of all pairs with an agent (without any, of all pairs) and of all passages, to the end of the run.
  ProofVerdict verdict = ProofVerdict::undecided;
  bool missed = false;        // an opening that an agent was to pass
  double least_distance = 0;  // m, proved; of avoided ones: between bodies, or from a rim
  double effort = 0;          // m/s, the integrals of the agents' |a|
};
/// Trial `trial` of a scenario made by trial_scenario(): its noise depends on the scenario's seed and on this
/// number alone.
[[nodiscard]] TrialOutcome fly_trial(const Scenario& scenario, std::uint64_t trial);

/// A share of trials with the interval that holds it with at least this confidence (Clopper and Pearson,
/// 1934): whatever the share is, at most 1 - confidence of such intervals miss it.
struct Share {
  double share = 0, low = 0, high = 1;
};
[[nodiscard]] Share share_of(std::uint64_t successes, std::uint64_t trials, double confidence = 0.95);

/// Two laws on the same noise: only trials in which they differ tell them apart. `chance`: of a difference at
/// least this uneven if both were as good (McNemar's test in its exact, binomial form, two-sided).
struct Paired {
  std::uint64_t first_alone = 0, second_alone = 0;  // avoided by one of them only
  double chance = 1;
};
[[nodiscard]] Paired paired(std::span<const bool> first, std::span<const bool> second);

}  // namespace vericone::simulation
