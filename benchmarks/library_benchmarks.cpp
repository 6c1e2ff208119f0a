// SPDX-License-Identifier: BSD-3-Clause
//
// Times per call over one set of engagements. Absolute numbers depend on the machine; for ratios within one
// run see vericone_ratios.
#include <benchmark/benchmark.h>

#include <vericone/cones/clearance.h>
#include <vericone/cones/exact_cone.h>
#include <vericone/cones/plane_sector.h>
#include <vericone/cones/sector.h>
#include <vericone/cones/slice_cone.h>

#include "fcl_peer.h"
#include "pairs.h"

namespace vericone::benchmarks {
namespace {

constexpr int kPairs = 256;

const std::vector<Engagement>& pairs() {
  static const auto all = engagements(kPairs);
  return all;
}

const std::vector<ConeOracle>& oracles() {
  static const auto all = [] {
    std::vector<ConeOracle> list;
    list.reserve(kPairs);
    for (const Engagement& e : pairs()) list.emplace_back(e.a, e.b);
    return list;
  }();
  return all;
}

/// The engagements seen along z: planar pairs at comparable distances.
const std::vector<std::pair<Ellipse, Ellipse>>& planar_pairs() {
  static const auto all = [] {
    std::vector<std::pair<Ellipse, Ellipse>> list;
    for (const Engagement& e : pairs()) {
      const auto section = [](const Placed& body) {
        return Ellipse::from_axes(body.center.head<2>(), body.semi_axes.head<2>(),
                                  rotation_2d(body.center.z()));
      };
      const auto pair = std::pair(section(e.placed_a), section(e.placed_b));
      if (relation<2>(pair.first, pair.second) == Relation::disjoint) list.push_back(pair);
    }
    return list;
  }();
  return all;
}

template <typename Work>
void each_pair(benchmark::State& state, Work&& work) {
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(work(i));
    i = (i + 1) % kPairs;
  }
}

template <typename Work>
void each_planar(benchmark::State& state, Work&& work) {
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(work(planar_pairs()[i].first, planar_pairs()[i].second));
    i = (i + 1) % planar_pairs().size();
  }
}

const PlanarMotion kMotion{{1, 2}, {-2, 1}, 0.3, -0.2, {}, {}};

void BM_SectorBySupport(benchmark::State& state) {
  each_planar(state, [](const Ellipse& a, const Ellipse& b) { return sector_by_support(a, b).psi; });
}
void BM_SectorBySupportWithRates(benchmark::State& state) {
  each_planar(state, [](const Ellipse& a, const Ellipse& b) {
    return sector_rates(sector_by_support(a, b), a, b, kMotion).psi;
  });
}
void BM_SectorByDegenerateConics(benchmark::State& state) {
  each_planar(state,
              [](const Ellipse& a, const Ellipse& b) { return sector_by_degenerate_conics(a, b)->psi; });
}
void BM_SectorByDegenerateConicsWithRates(benchmark::State& state) {
  each_planar(state, [](const Ellipse& a, const Ellipse& b) {
    return sector_rates(*sector_by_degenerate_conics(a, b), a, b, kMotion).psi;
  });
}
void BM_SliceCone(benchmark::State& state) {
  const int planes = static_cast<int>(state.range(0));
  each_pair(state,
            [&](std::size_t i) { return slice_cone(pairs()[i].a, pairs()[i].b, planes).slices.size(); });
}
void BM_ExactCone(benchmark::State& state) {
  const int samples = static_cast<int>(state.range(0));
  each_pair(state,
            [&](std::size_t i) { return exact_cone(pairs()[i].a, pairs()[i].b, samples).solid_angle; });
}
void BM_ExactConeWithBounds(benchmark::State& state) {
  const int samples = static_cast<int>(state.range(0));
  each_pair(state, [&](std::size_t i) {
    const Engagement& e = pairs()[i];
    return cone_bounds(exact_cone(e.a, e.b, samples), e.a, e.b).solid_angle_error;
  });
}
void BM_MembershipNaive(benchmark::State& state) {
  each_pair(state, [](std::size_t i) { return oracles()[i].naive_membership(pairs()[i].w); });
}
void BM_MembershipTriage(benchmark::State& state) {
  each_pair(state, [](std::size_t i) { return oracles()[i].triage_membership(pairs()[i].w); });
}
void BM_MembershipLadder(benchmark::State& state) {
  each_pair(state, [](std::size_t i) { return oracles()[i].membership(pairs()[i].w); });
}
void BM_MembershipExactRung(benchmark::State& state) {
  each_pair(state, [](std::size_t i) {
    return oracles()[i].exact_membership(pairs()[i].w, Eigen::Vector3d::Zero());
  });
}
void BM_MembershipOneShot(benchmark::State& state) {
  each_pair(state,
            [](std::size_t i) { return ConeOracle(pairs()[i].a, pairs()[i].b).membership(pairs()[i].w); });
}
void BM_Clearance(benchmark::State& state) {
  each_pair(state,
            [](std::size_t i) { return clearance(pairs()[i].a, pairs()[i].b, pairs()[i].w).distance; });
}
void BM_Separation(benchmark::State& state) {
  each_pair(state, [](std::size_t i) { return separation(pairs()[i].a, pairs()[i].b).distance; });
}
void BM_TimeToContact(benchmark::State& state) {
  each_pair(state, [](std::size_t i) { return time_to_contact(pairs()[i].a, pairs()[i].b, pairs()[i].w); });
}
void BM_ExactSectorWithRates(benchmark::State& state) {
  SpatialMotion motion;
  motion.v_a = {1, 2, 3};
  each_pair(state, [&](std::size_t i) {
    const Engagement& e = pairs()[i];
    return exact_sector_rates(exact_sector(e.a, e.b, e.across), e.a, e.b, motion).psi();
  });
}

BENCHMARK(BM_SectorBySupport);
BENCHMARK(BM_SectorBySupportWithRates);
BENCHMARK(BM_SectorByDegenerateConics);
BENCHMARK(BM_SectorByDegenerateConicsWithRates);
BENCHMARK(BM_SliceCone)->Arg(12)->Arg(36)->Arg(360);
BENCHMARK(BM_ExactCone)->Arg(8)->Arg(16)->Arg(24)->Arg(48)->Arg(96);
BENCHMARK(BM_ExactConeWithBounds)->Arg(48);
BENCHMARK(BM_MembershipNaive);
BENCHMARK(BM_MembershipTriage);
BENCHMARK(BM_MembershipLadder);
BENCHMARK(BM_MembershipExactRung);
BENCHMARK(BM_MembershipOneShot);
BENCHMARK(BM_Clearance);
BENCHMARK(BM_Separation);
BENCHMARK(BM_TimeToContact);
BENCHMARK(BM_ExactSectorWithRates);

void BM_Fcl(benchmark::State& state) {
  static const auto fcl = [] {
    std::vector<FclPair> list;
    for (const Engagement& e : pairs()) list.emplace_back(e);
    return list;
  }();
  const auto call = static_cast<std::size_t>(state.range(0));
  state.SetLabel(fcl_calls()[call].name);
  each_pair(state, [&](std::size_t i) { return fcl[i].run(call); });
}
BENCHMARK(BM_Fcl)->DenseRange(0, 4);

}  // namespace
}  // namespace vericone::benchmarks

BENCHMARK_MAIN();
