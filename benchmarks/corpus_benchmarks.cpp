// SPDX-License-Identifier: GPL-3.0-or-later
//
// Membership on the corpus of exactly tangent cases and their neighbours, where the exact rung earns its
// keep.
#include <benchmark/benchmark.h>
#include <benchmarks/suites.h>
#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/verify/corpus.h>
#include <string>
#include <vector>

namespace vericone::benchmarks {
namespace {

struct Case {
  ConeOracle oracle;
  Eigen::Vector3d w;
  std::string truth;
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all = [] {
    std::vector<Case> read;
    for (const verify::CorpusCase& c : verify::read_corpus(VERICONE_CORPUS "/membership.txt")) {
      const auto a = c.body<3>("a"), b = c.body<3>("b");
      if (a && b && c.doubles("w")) read.push_back({ConeOracle(*a, *b), c.vector<3>("w"), c.truth});
    }
    return read;
  }();
  return all;
}

/// `answer(case)`: an optional membership. Counts what was answered and what was wrong.
template <typename Answer>
void add(const std::string& name, Answer answer) {
  benchmark::RegisterBenchmark(("corpus/membership/" + name).c_str(), [=](benchmark::State& state) {
    const auto& all = cases();
    double answered = 0, wrong = 0;
    for (const Case& c : all)
      if (const std::optional<Membership> m = answer(c)) {
        ++answered;
        wrong += to_string(*m) != c.truth;
      }
    std::size_t i = 0;
    for (auto _ : state) {
      auto m = answer(all[i]);
      benchmark::DoNotOptimize(m);
      i = i + 1 == all.size() ? 0 : i + 1;
    }
    state.counters["answered"] = answered;
    state.counters["wrong"] = wrong;
    state.counters["of"] = static_cast<double>(all.size());
  });
}

}  // namespace

void add_corpus_benchmarks() {
  const Eigen::Vector3d still(0, 0, 0);
  add("naive", [](const Case& c) { return std::optional(c.oracle.naive_membership(c.w)); });
  add("triage", [](const Case& c) { return c.oracle.triage_membership(c.w); });
  add("interval", [still](const Case& c) { return c.oracle.interval_membership(c.w, still); });
  add("ladder", [](const Case& c) { return std::optional(c.oracle.membership(c.w)); });
  add("exact", [still](const Case& c) { return std::optional(c.oracle.exact_membership(c.w, still)); });
}

}  // namespace vericone::benchmarks
