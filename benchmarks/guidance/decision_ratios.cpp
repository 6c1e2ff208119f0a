// SPDX-License-Identifier: BSD-3-Clause
//
// Prints, in Markdown, what answers within a horizon cost beside those without, in one run; and what bands
// and the nearest safe velocity cost, with how near they come to their bounds. All in processor time.
//
// Usage: vericone_decision_ratios [CASES]
#include <vericone/cones/pair.h>
#include <vericone/guidance/avoid.h>
#include <vericone/guidance/bands.h>
#include <vericone/testing/random_bodies.h>
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <tuple>
#include <vector>

namespace {

using namespace vericone;
using namespace vericone::guidance;
using Eigen::Vector3d;
using vericone::testing::any_body;
using vericone::testing::any_pose;
using vericone::testing::RandomBodies;

/// Processor time of this thread.
template <typename Work>
double seconds(const Work& work) {
  timespec from, to;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &from);
  work();
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &to);
  return double(to.tv_sec - from.tv_sec) + 1e-9 * double(to.tv_nsec - from.tv_nsec);
}

double quantile(std::vector<double> all, double part) {
  if (all.empty()) return 0;
  std::sort(all.begin(), all.end());
  return all[static_cast<std::size_t>(part * static_cast<double>(all.size() - 1))];
}
double mean(const std::vector<double>& all) {
  double sum = 0;
  for (const double x : all) sum += x;
  return sum / static_cast<double>(all.size());
}

int total = 0;  // so that nothing is left out

void horizon_row(BodyKind first, BodyKind second, int pairs) {
  RandomBodies random(5);
  std::vector<double> without, within;
  for (int i = 0; i < pairs; ++i) {
    const Placed a(any_body(random, first), any_pose(random, 0.5)),
        b(any_body(random, second), any_pose(random, random.uniform(4, 15)));
    const Pair pair(a, b);
    if (pair.relation() != Relation::disjoint) continue;
    const Vector3d c = b.pose.position - a.pose.position;
    for (int k = 0; k < 10; ++k) {
      const Vector3d w = k % 2 ? Vector3d(c + random.uniform(0, 5) * random.direction())
                               : Vector3d(c.norm() * random.direction());
      const Vector3d u = random.direction(), v = w + u;
      const Horizon horizon{0, random.log_uniform(0.2, 2)};
      constexpr int kRepeats = 20;
      without.push_back(seconds([&] {
                          for (int r = 0; r < kRepeats; ++r) total += int(pair.verdict(v, u));
                        }) /
                        kRepeats * 1e9);
      within.push_back(seconds([&] {
                         for (int r = 0; r < kRepeats; ++r) total += int(pair.verdict(v, u, horizon));
                       }) /
                       kRepeats * 1e9);
    }
  }
  std::printf("| %s and %s | %.0f ns | %.0f ns | %.2f | %.0f ns | %.0f ns | %.2f |\n", to_string(first),
              to_string(second), quantile(without, 0.5), quantile(within, 0.5),
              quantile(within, 0.5) / quantile(without, 0.5), mean(without), mean(within),
              mean(within) / mean(without));
}

/// `met`: each intruder meets the agent within the horizon.
void bands_row(const char* what, const Body& own, const Body& theirs, bool met, int count, int cases) {
  RandomBodies random(7);
  std::vector<double> each;
  const Vector3d v(0, 100, 0);
  for (int i = 0; i < cases; ++i) {
    std::vector<Intruder> others;
    for (int k = 0; k < count; ++k) {
      const Vector3d at(random.uniform(-3000, 3000), random.uniform(-3000, 3000), random.uniform(-100, 100));
      const Vector3d u(random.uniform(-50, 50), random.uniform(-50, 50), 0);
      others.push_back({Placed(theirs, Pose{at}), met ? Vector3d(v - at / random.uniform(20, 50)) : u});
    }
    const double time = seconds([&] {
      total += int(bands(Placed(own), v, others, {.horizon = {0, 60}}).heading.free.size());
    });
    each.push_back(time / count * 1e6);
  }
  std::printf("| %s | %d | %.1f us | %.1f us | %.1f us |\n", what, count, quantile(each, 0.5),
              quantile(each, 0.9), quantile(each, 0.99));
}

void avoid_row(int count, int cases) {
  RandomBodies random(11);
  std::vector<double> wanted_free, changed;
  int close = 0, none = 0;
  for (int i = 0; i < cases; ++i) {
    const Placed agent(Ellipsoid::from_axes({0, 0, 0}, {0.5, 0.5, 0.3}));
    std::vector<Intruder> others;
    while (static_cast<int>(others.size()) < count) {
      const Placed body(any_body(random, i % 2 ? BodyKind::ellipsoid : BodyKind::hull),
                        any_pose(random, random.uniform(7, 60)));
      if (Pair(agent, body).relation() == Relation::disjoint)
        others.push_back({body, random.uniform(0, 3) * random.direction()});
    }
    // Of two, one aims at a body.
    const Intruder& first = others.front();
    const Vector3d v = i % 2 ? Vector3d(random.uniform(1, 5) * random.direction())
                             : Vector3d(first.body.pose.position / random.uniform(5, 12) + first.velocity);
    AvoidOptions options;
    options.until = random.uniform(4, 15);
    options.speed = {0, 9};
    Avoidance found;
    const double time = seconds([&] { found = avoid(agent, v, v, others, options); }) * 1e3;
    none += found.status != AvoidStatus::free;
    (found.distance == 0 ? wanted_free : changed).push_back(time);
    close += found.distance > 0 && found.distance <= found.lower * 1.0101;
  }
  std::printf("| %d | %zu of %d | %.2f ms | %.2f ms, %.2f ms | %d of %zu | %d |\n", count, wanted_free.size(),
              cases, quantile(wanted_free, 0.5), quantile(changed, 0.5), quantile(changed, 0.9), close,
              changed.size(), none);
}

}  // namespace

int main(int argc, char** argv) {
  const int cases = argc > 1 ? std::atoi(argv[1]) : 400;
  std::printf(
      "| verdict of | median, for ever | within a horizon | ratio | mean, for ever | within a horizon | "
      "ratio |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n");
  for (std::size_t i = 0; i < kBodyKinds.size(); ++i)
    for (std::size_t j = i; j < kBodyKinds.size(); ++j) horizon_row(kBodyKinds[i], kBodyKinds[j], cases);
  std::printf(
      "\n| bands of headings, speeds, climb rates | intruders | median an intruder | 90 %% | 99 %% |\n"
      "| --- | --- | --- | --- | --- |\n");
  const Body ball = Ellipsoid::from_axes({0, 0, 0}, {10, 10, 5}),
             flat = Ellipsoid::from_axes({0, 0, 0}, {76.2, 76.2, 15.24}), can = Convex::cylinder(10, 10),
             volume = Convex::cylinder(76.2, 30.48);
  for (const int count : {1, 10, 100}) {
    bands_row("ellipsoids", ball, flat, false, count, cases);
    bands_row("cylinders", can, volume, false, count, cases);
  }
  const std::array<std::tuple<const char*, Body, Body>, 6> met{
      {{"ellipsoids that meet", ball, flat},
       {"cylinders that meet", can, volume},
       {"an ellipsoid and a cylinder that meet", ball, volume},
       {"capsules that meet", Convex::capsule(5, 20), Convex::capsule(50, 80)},
       {"a cylinder and a cone that meet", can, Convex::cone(76.2, 30.48)},
       {"boxes that meet", HullBody::box({-10, -10, -5}, {10, 10, 5}),
        HullBody::box({-70, -70, -15}, {70, 70, 15})}}};
  for (const auto& [what, own, theirs] : met) bands_row(what, own, theirs, true, 1, cases);
  std::printf(
      "\n| bodies | wanted is safe | then | else, median and 90 %% | within 1 %% of the bound | nothing safe "
      "|\n"
      "| --- | --- | --- | --- | --- | --- |\n");
  for (const int count : {10, 100, 1000}) avoid_row(count, count == 1000 ? cases / 20 : cases / 4);
  return total == 42;
}
