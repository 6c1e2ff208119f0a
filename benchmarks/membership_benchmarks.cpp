// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>
#include <benchmarks/agreement.h>
#include <benchmarks/suites.h>
#include <vericone/cones/opening/opening.h>
#include <vericone/cones/opening/orifice.h>
#include <vericone/testing/random_bodies.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

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

namespace {

// Openings: verdicts of ordinary velocities and of those next to the boundary; clearances; rims.

using Eigen::Vector2d, Eigen::Vector3d;

struct Passage {
  Ellipsoid agent;
  PlacedOpening opening;
  Vector3d w;
  OrificeOracle oracle;
};

Opening outline(testing::RandomBodies& random, int vertices) {
  if (vertices == 0) return Opening::circle(random.uniform(0.5, 1));
  if (vertices == 1) return Opening::ellipse({random.uniform(0.2, 1), random.uniform(0.2, 1)});
  const double least = random.coin() ? 0.9 : 0.5;
  std::vector<Vector2d> p;
  for (int i = 0; i < vertices; ++i) {
    const double angle = 2 * std::numbers::pi * (i + random.uniform(0, 0.5)) / vertices;
    p.push_back(random.uniform(least, 1) * Vector2d(std::cos(angle), std::sin(angle)));
  }
  return Opening::polygon(std::move(p));
}

/// Aimed at the opening or beside it. `near`: the opening is made as large as it must be to pass, to between
/// 1e-16 and 1e-10 of its size.
std::vector<Passage> passages(int vertices, bool near) {
  testing::RandomBodies random(19);
  std::vector<Passage> all;
  while (all.size() < 400) {
    PlacedOpening opening{outline(random, vertices), random.in_box(5), random.rotation().leftCols<2>()};
    const Ellipsoid agent =
        random.ellipsoid(opening.center + random.uniform(2, 6) * random.direction(), 0.05, 0.4);
    const Vector3d w = opening.center + random.uniform(0, 1) * random.direction() - agent.center();
    const auto of = [&](double size) {
      PlacedOpening sized = opening;
      sized.axes *= size;
      return OrificeOracle(agent, sized);
    };
    if (of(1).side() != WallSide::clear) continue;
    if (near) {
      double low = 1e-3, high = 1e3;
      if (of(high).transit(w) != Transit::passes) continue;
      while (testing::moved_by_ulps(low, 1) < high) {
        const double mid = 0.5 * (low + high);
        (of(mid).transit(w) == Transit::blocked ? low : high) = mid;
      }
      opening.axes *= high * (1 + random.uniform(-1, 1) * random.log_uniform(1e-16, 1e-10));
    }
    all.push_back({agent, opening, w, OrificeOracle(agent, opening)});
  }
  return all;
}

/// Of the times that single calls take, each the middle one of seven.
template <typename Call>
double median_of_calls(const std::vector<Passage>& all, const Call& call) {
  std::vector<double> times;
  for (const Passage& p : all) {
    std::vector<double> one;
    for (int i = 0; i < 7; ++i) {
      const auto start = std::chrono::steady_clock::now();
      benchmark::DoNotOptimize(call(p));
      one.push_back(
          std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count());
    }
    std::nth_element(one.begin(), one.begin() + 3, one.end());
    times.push_back(one[3]);
  }
  std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
  return times[times.size() / 2];
}

template <typename Call>
void add_passages(const std::string& name, int vertices, bool near, Call call) {
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    const std::vector<Passage> all = passages(vertices, near);
    std::size_t i = 0;
    for (auto _ : state) {
      auto result = call(all[i]);
      benchmark::DoNotOptimize(result);
      i = i + 1 == all.size() ? 0 : i + 1;
    }
    state.counters["median_us"] = median_of_calls(all, call);
  });
}

}  // namespace

void add_opening_benchmarks() {
  for (const auto& [name, vertices] :
       {std::pair("circle", 0), {"ellipse", 1}, {"4-gon", 4}, {"64-gon", 64}}) {
    const std::string text = name;
    const auto transit = [](const Passage& p) { return p.oracle.transit(p.w); };
    add_passages("transit/" + text, vertices, false, transit);
    add_passages("transit/" + text + "/near", vertices, true, transit);
    add_passages("opening_clearance/" + text, vertices, false,
                 [](const Passage& p) { return opening_clearance(p.agent, p.opening, p.w).distance; });
    // As the agent is when it passes.
    const auto at_rim = [](const Passage& p) {
      return p.agent.translated(0.9 * (p.opening.center - p.agent.center()));
    };
    add_passages("rim_distance/" + text + "/1e-2", vertices, false, [=](const Passage& p) {
      return rim_distance(at_rim(p), p.opening, {.tolerance = 1e-2}).least;
    });
    add_passages("rim_distance/" + text + "/threshold", vertices, false, [=](const Passage& p) {
      return rim_distance(at_rim(p), p.opening, {.tolerance = 0, .threshold = 0.05}).least;
    });
  }
}

}  // namespace vericone::benchmarks
