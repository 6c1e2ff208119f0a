// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>
#include <benchmarks/accuracy.h>
#include <benchmarks/suites.h>
#include <vericone/cones/ellipsoids/clearance.h>
#include <vericone/cones/planar/sector.h>
#include <vericone/cones/slices/slice_cone.h>
#include <vericone/internal/cones/ellipsoids/plane_sector.h>

namespace vericone::benchmarks {
namespace {

/// One call an iteration, on one pair after the other.
template <typename Pairs, typename Call>
benchmark::internal::Benchmark* add(const std::string& name, const Pairs& pairs, Call call,
                                    const std::string& text = "") {
  return benchmark::RegisterBenchmark(name.c_str(), [&pairs, call, text](benchmark::State& state) {
    std::size_t i = 0;
    for (auto _ : state) {
      auto result = call(pairs[i]);
      benchmark::DoNotOptimize(result);
      i = i + 1 == pairs.size() ? 0 : i + 1;
    }
    state.SetLabel(text);
  });
}

}  // namespace

void add_sector_benchmarks() {
  static const std::vector<PlanarEngagement> pairs = planar_engagements(1000);
  add("sector/support", pairs, [](const PlanarEngagement& e) { return sector_by_support(e.a, e.b); });
  add("sector/support+rates", pairs, [](const PlanarEngagement& e) {
    return sector_rates(sector_by_support(e.a, e.b), e.a, e.b, e.motion);
  });
  add("sector/degenerate_conics", pairs,
      [](const PlanarEngagement& e) { return sector_by_degenerate_conics(e.a, e.b); });
  add("sector/degenerate_conics+rates", pairs, [](const PlanarEngagement& e) {
    const auto sector = sector_by_degenerate_conics(e.a, e.b);
    return sector ? sector_rates(*sector, e.a, e.b, e.motion) : SectorRates{};
  });
}

void add_cone_benchmarks() {
  static const std::vector<Engagement> pairs = engagements(1000);
  static const Accuracy accuracy(pairs);
  const auto exact = [](const std::string& name, int samples) {
    add(
        "true_cone/" + name, pairs,
        [samples](const Engagement& e) { return true_cone(e.a, e.b, samples).solid_angle; },
        label("samples", samples, accuracy.exact(samples)));
  };
  for (const int planes : {12, 36, 360})
    add(
        "slice_cone/" + std::to_string(planes), pairs,
        [planes](const Engagement& e) { return slice_cone(e.a, e.b, planes).slices[0].left; },
        label("planes", planes, accuracy.slice(planes)));
  exact("median<1e-3", accuracy.fewest(1e-3, &Spread::median));
  exact("worst<1e-3", accuracy.fewest(1e-3, &Spread::worst));
  exact("median<1e-6", accuracy.fewest(1e-6, &Spread::median));
  exact("worst<1e-6", accuracy.fewest(1e-6, &Spread::worst));
  exact("48", 48);
  static const std::vector<TrueCone> cones = [] {
    std::vector<TrueCone> all;
    for (const Engagement& e : pairs) all.push_back(true_cone(e.a, e.b, 48));
    return all;
  }();
  add("cone_bounds/48", cones, [](const TrueCone& cone) {
    const Engagement& e = pairs[&cone - cones.data()];
    return cone_bounds(cone, e.a, e.b).solid_angle_error;
  });
}

void add_measure_benchmarks() {
  static const std::vector<Engagement> pairs = engagements(1000);
  add("clearance", pairs, [](const Engagement& e) { return clearance(e.a, e.b, e.w); });
  add("separation", pairs, [](const Engagement& e) { return separation(e.a, e.b); });
  add("time_to_contact", pairs, [](const Engagement& e) { return time_to_contact(e.a, e.b, e.w); });
  add("true_sector", pairs, [](const Engagement& e) { return true_sector(e.a, e.b, e.across); });
  add("true_sector+rates", pairs, [](const Engagement& e) {
    return true_sector_rates(true_sector(e.a, e.b, e.across), e.a, e.b, e.motion);
  });
}

}  // namespace vericone::benchmarks
