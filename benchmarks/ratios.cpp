// SPDX-License-Identifier: BSD-3-Clause
//
// Ratios measured in one run, as a Markdown table: the exact cone against slices, membership against FCL.
#include <vericone/cones/exact_cone.h>
#include <vericone/cones/slice_cone.h>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>

#include "fcl_peer.h"
#include "pairs.h"

namespace vericone::benchmarks {
namespace {

constexpr int kPairs = 1000;

/// Median over passes of the time per pair, in nanoseconds. Passes of all contenders are interleaved by the
/// caller's order of calls only; the machine should be quiet.
double time_per_pair(int pairs, const std::function<double(int)>& work) {
  std::array<double, 9> passes{};
  volatile double sink = 0;
  for (double& pass : passes) {
    const auto start = std::chrono::steady_clock::now();
    int rounds = 0;
    do {
      for (int i = 0; i < pairs; ++i) sink = sink + work(i);
      ++rounds;
    } while (std::chrono::steady_clock::now() - start < std::chrono::milliseconds(40));
    pass = std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count() /
           rounds / pairs;
  }
  std::nth_element(passes.begin(), passes.begin() + passes.size() / 2, passes.end());
  return passes[passes.size() / 2];
}

struct Errors {
  double median, worst;
};

Errors area_errors(const std::vector<Engagement>& all, const std::vector<double>& truth, int samples) {
  std::vector<double> errors;
  for (int i = 0; i < kPairs; ++i)
    errors.push_back(std::abs(exact_cone(all[i].a, all[i].b, samples).cross_section_area / truth[i] - 1));
  std::sort(errors.begin(), errors.end());
  return {errors[kPairs / 2], errors.back()};
}

void cones(const std::vector<Engagement>& all) {
  std::vector<double> truth;
  for (const auto& e : all) truth.push_back(exact_cone(e.a, e.b, 512).cross_section_area);
  constexpr std::array kCounts{8, 10, 12, 14, 16, 20, 24, 32, 48, 64, 96, 128};
  std::vector<Errors> errors;
  for (const int m : kCounts) errors.push_back(area_errors(all, truth, m));
  const auto first = [&](double limit, double Errors::*which) {
    for (std::size_t i = 0; i < kCounts.size(); ++i)
      if (errors[i].*which < limit) return kCounts[i];
    return kCounts.back();
  };
  std::vector<std::pair<const char*, int>> rows{{"median error under 1e-3", first(1e-3, &Errors::median)},
                                                {"median error under 1e-6", first(1e-6, &Errors::median)},
                                                {"worst error under 1e-3", first(1e-3, &Errors::worst)},
                                                {"worst error under 1e-6", first(1e-6, &Errors::worst)},
                                                {"48 samples", 48}};
  constexpr int kTimed = 100;
  const double slice =
      time_per_pair(kTimed, [&](int i) { return double(slice_cone(all[i].a, all[i].b, 360).slices.size()); });
  std::printf("slice_cone, n = 360: %.1f us\n\n", slice / 1e3);
  std::printf(
      "| exact cone | samples | median error | worst error | us | times faster than slices, n = 360 |\n"
      "|---|---|---|---|---|---|\n");
  for (const auto& [name, m] : rows) {
    const double exact =
        time_per_pair(kTimed, [&, m = m](int i) { return exact_cone(all[i].a, all[i].b, m).solid_angle; });
    const auto& e = errors[std::find(kCounts.begin(), kCounts.end(), m) - kCounts.begin()];
    std::printf("| %s | %d | %.1e | %.1e | %.2f | %.0f |\n", name, m, e.median, e.worst, exact / 1e3,
                slice / exact);
  }
  const double bounded = time_per_pair(kTimed, [&](int i) {
    return cone_bounds(exact_cone(all[i].a, all[i].b, 48), all[i].a, all[i].b).solid_angle_error;
  });
  std::printf("| 48 samples with certified bounds | 48 | | | %.2f | %.0f |\n", bounded / 1e3,
              slice / bounded);
}

void membership(const std::vector<Engagement>& all) {
  std::vector<ConeOracle> oracles;
  std::vector<FclPair> fcl;
  std::vector<Membership> truth;
  int inside = 0;
  for (const auto& e : all) {
    oracles.emplace_back(e.a, e.b);
    fcl.emplace_back(e);
    truth.push_back(oracles.back().membership(e.w));
    inside += truth.back() != Membership::out;
  }
  std::printf("\n%d velocities, %d of them collide\n\n", kPairs, inside);
  std::printf("| membership | ns | wrong or undecided |\n|---|---|---|\n");
  // A robot asks many velocities of few obstacles: 32 prepared pairs stay in the cache, as they would there.
  constexpr int kPrepared = 32;
  int naive_wrong = 0, undecided = 0;
  for (int i = 0; i < kPairs; ++i) {
    naive_wrong += oracles[i].naive_membership(all[i].w) != truth[i];
    undecided += !oracles[i].triage_membership(all[i].w).has_value();
  }
  const double naive =
      time_per_pair(kPrepared, [&](int i) { return double(oracles[i].naive_membership(all[i].w)); });
  const double triage = time_per_pair(kPrepared, [&](int i) {
    return double(oracles[i].triage_membership(all[i].w).value_or(Membership::on));
  });
  const double ladder =
      time_per_pair(kPrepared, [&](int i) { return double(oracles[i].membership(all[i].w)); });
  const double one_shot = time_per_pair(
      kPrepared, [&](int i) { return double(ConeOracle(all[i].a, all[i].b).membership(all[i].w)); });
  std::printf("| plain double, no bound | %.1f | %d |\n", naive, naive_wrong);
  std::printf("| first rung, proved bound | %.1f | %d |\n", triage, undecided);
  std::printf("| whole ladder, exact | %.1f | 0 |\n", ladder);
  std::printf("| whole ladder, bodies prepared for one question | %.1f | 0 |\n", one_shot);
  std::printf(
      "\n| FCL call | same question | ns | against plain double | against the exact ladder | wrong |\n"
      "|---|---|---|---|---|---|\n");
  for (std::size_t c = 0; c < fcl_calls().size(); ++c) {
    int wrong = 0;
    if (fcl_calls()[c].answers_membership)
      for (int i = 0; i < kPairs; ++i) wrong += (fcl[i].run(c) != 0) != (truth[i] != Membership::out);
    const double ns = time_per_pair(kPrepared, [&](int i) { return fcl[i].run(c); });
    const std::string told = fcl_calls()[c].answers_membership ? std::to_string(wrong) : "";
    std::printf("| %s | %s | %.0f | %.0f x | %.0f x | %s |\n", fcl_calls()[c].name.c_str(),
                fcl_calls()[c].answers_membership ? "yes" : "no", ns, ns / naive, ns / ladder, told.c_str());
  }
}

}  // namespace
}  // namespace vericone::benchmarks

int main() {
  using namespace vericone::benchmarks;
  const auto all = engagements(kPairs);
  cones(all);
  membership(all);
}
