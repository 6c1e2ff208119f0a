// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>
#include <benchmarks/agreement.h>
#include <benchmarks/suites.h>
#include <string>

namespace vericone::benchmarks {
namespace {

const Prepared& prepared() {
  static const Prepared all(engagements(1000));
  return all;
}

/// One call an iteration; a call that answers the question of membership has its wrong answers counted.
template <typename Call>
void add(const std::string& name, Call call, bool same_question = true, int count = 1000) {
  Wrong wrong;
  if (same_question)
    wrong = wrong_answers(prepared(), count, [&](int i) { return static_cast<bool>(call(i)); });
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    int i = 0;
    for (auto _ : state) {
      auto answer = call(i);
      benchmark::DoNotOptimize(answer);
      i = i + 1 == count ? 0 : i + 1;
    }
    if (same_question) {
      state.counters["wrong_hits"] = wrong.hits;
      state.counters["wrong_misses"] = wrong.misses;
      state.counters["of"] = count;
    }
  });
}

bool touches(Membership m) { return m != Membership::out; }

}  // namespace

void add_membership_benchmarks() {
  static const Prepared& all = prepared();
  static const auto w = [](int i) -> const Eigen::Vector3d& { return all.engagements[i].w; };
  add("membership/naive", [](int i) { return touches(all.oracles[i].naive_membership(w(i))); });
  add("membership/triage", [](int i) {
    const auto answer = all.oracles[i].triage_membership(w(i));
    return answer && touches(*answer);
  });
  add("membership/ladder", [](int i) { return touches(all.oracles[i].membership(w(i))); });
  add("membership/one_shot", [](int i) {
    const Engagement& e = all.engagements[i];
    return touches(ConeOracle(e.a, e.b).membership(e.w));
  });
  add("membership/exact",
      [](int i) { return touches(all.oracles[i].exact_membership(w(i), Eigen::Vector3d::Zero())); });
}

void add_fcl_benchmarks() {
  static const std::vector<FclPair>& pairs = prepared().fcl;
  for (const auto& [name, solver] : {std::pair("libccd", FclSolver::libccd), {"indep", FclSolver::indep}}) {
    const std::string text = name;
    add(
        "fcl/distance/" + text, [solver = solver](int i) { return pairs[i].distance(solver); }, false);
    add(
        "fcl/collide/" + text, [solver = solver](int i) { return pairs[i].collide(solver); }, false);
    add("fcl/advancement/" + text, [solver = solver](int i) { return pairs[i].advancement(solver); });
    add("fcl/polytope_advancement/" + text,
        [solver = solver](int i) { return pairs[i].polytope_advancement(solver); });
  }
  add("fcl/naive/10", [](int i) { return pairs[i].naive(10); });
  add("fcl/naive/100", [](int i) { return pairs[i].naive(100); });
  add(
      "fcl/naive/10000", [](int i) { return pairs[i].naive(10000); }, true, 100);
}

}  // namespace vericone::benchmarks
