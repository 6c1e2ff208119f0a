// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace vericone::benchmarks {

// Each registers its benchmarks with Google Benchmark.
void add_sector_benchmarks();
void add_cone_benchmarks();
void add_measure_benchmarks();
void add_membership_benchmarks();
void add_opening_benchmarks();
void add_fcl_benchmarks();
void add_corpus_benchmarks();  // where verify/, which reads the corpus, is built

}  // namespace vericone::benchmarks
