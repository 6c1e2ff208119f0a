// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>
#include <benchmarks/suites.h>

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  vericone::benchmarks::add_sector_benchmarks();
  vericone::benchmarks::add_cone_benchmarks();
  vericone::benchmarks::add_measure_benchmarks();
  vericone::benchmarks::add_membership_benchmarks();
  vericone::benchmarks::add_opening_benchmarks();
  vericone::benchmarks::add_fcl_benchmarks();
#ifdef VERICONE_CORPUS
  vericone::benchmarks::add_corpus_benchmarks();
#endif
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
