// SPDX-License-Identifier: BSD-3-Clause
//
// Prints, in Markdown, what a barrier costs beside a verdict within a horizon and beside Pair::miss.
//
// Usage: vericone_barrier_ratios [PAIRS]
#include <vericone/cones/pair.h>
#include <vericone/guidance/barrier.h>
#include <vericone/testing/random_bodies.h>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

using namespace vericone;
using Eigen::Vector3d;
using vericone::testing::any_body;
using vericone::testing::any_pose;
using vericone::testing::RandomBodies;

double total = 0;  // so that nothing is left out

template <typename Work>
double microseconds(const Work& work) {
  constexpr int kRepeats = 5;
  const auto start = std::chrono::steady_clock::now();
  for (int r = 0; r < kRepeats; ++r) total += work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / kRepeats * 1e6;
}

double quantile(std::vector<double> all, double part) {
  if (all.empty()) return 0;
  std::sort(all.begin(), all.end());
  return all[static_cast<std::size_t>(part * static_cast<double>(all.size() - 1))];
}

void row(BodyKind first, BodyKind second, int pairs) {
  RandomBodies random(6);
  std::vector<double> verdict, miss, apart, meet;
  double worst = 0;
  for (int i = 0; i < pairs; ++i) {
    const Placed a(any_body(random, first), any_pose(random, 0.5)),
        b(any_body(random, second), any_pose(random, random.uniform(5, 15)));
    const Pair pair(a, b);
    const Vector3d c = b.pose.position - a.pose.position;
    for (int k = 0; k < 5; ++k) {
      const Vector3d w = c / random.uniform(2, 10) + random.uniform(0, 2) * random.direction(),
                     u = Vector3d::Zero();
      const double until = random.uniform(0, 10);
      const guidance::Barrier found = guidance::barrier(pair, w, u, until);
      worst = std::max(worst, found.h - found.least);
      verdict.push_back(microseconds([&] { return double(pair.verdict(w, u, {0, until})); }));
      miss.push_back(microseconds([&] { return pair.miss(w, u).distance; }));
      (found.least > 0 ? apart : meet).push_back(microseconds([&] {
        return guidance::barrier(pair, w, u, until).h;
      }));
    }
  }
  std::printf("| %s and %s | %.2f us | %.1f us | %.1f us, %.1f us | %.0f us, %.0f us | %.0e m |\n",
              to_string(first), to_string(second), quantile(verdict, 0.5), quantile(miss, 0.5),
              quantile(apart, 0.5), quantile(apart, 0.9), quantile(meet, 0.5), quantile(meet, 0.9), worst);
}

}  // namespace

int main(int argc, char** argv) {
  const int pairs = argc > 1 ? std::atoi(argv[1]) : 200;
  std::printf(
      "| bodies | verdict within a horizon | miss | barrier where they stay apart, median and 90 %% | where "
      "they meet | h less the bound, at most |\n"
      "| --- | --- | --- | --- | --- | --- |\n");
  using enum BodyKind;
  for (const auto& [first, second] : {std::pair(ellipsoid, ellipsoid),
                                      {ellipsoid, hull},
                                      {hull, hull},
                                      {ellipsoid, mesh},
                                      {ellipsoid, cloud},
                                      {mesh, boxes},
                                      {ellipsoid, combined},
                                      {pieces, pieces}})
    row(first, second, pairs);
  return total == 42;
}
