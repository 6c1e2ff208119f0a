// SPDX-License-Identifier: BSD-3-Clause
//
// Prints, in Markdown, what pairs of capsules, cylinders, boxes and cones cost: verdicts, and first contacts
// where they meet. Bodies of 1 to 8 m, 10 to 20 m apart, in any attitude; a third of the velocities goes
// anywhere, the others near the other body.
//
// Usage: vericone_convex_ratios [PAIRS]
#include <vericone/cones/pair.h>
#include <vericone/testing/random_bodies.h>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <benchmarks/items.h>

namespace {

using namespace vericone;
using namespace vericone::benchmarks;
using Eigen::Vector3d;
using testing::RandomBodies;

const char* const kNames[] = {"capsule", "cylinder", "box", "cone", "ellipsoid"};

Body body(RandomBodies& random, int kind) {
  const auto half = [&] { return random.uniform(0.5, 2); };
  switch (kind) {
    case 0:
      return Convex::capsule(half(), 2 * half());
    case 1:
      return Convex::cylinder(half(), 2 * half());
    case 2:
      return Convex::box({half(), half(), half()});
    case 3:
      return Convex::cone(half(), 2 * half());
    default:
      return Ellipsoid::from_axes(Vector3d::Zero(), {half(), half(), half()});
  }
}

template <typename Ask>
double time_of(const std::vector<Vector3d>& velocities, const Ask& ask) {
  double least = 1e300;
  for (int round = 0; round < 5; ++round)
    least = std::min(
        least, item("", velocities.size(), 1, [&](std::size_t i) { return ask(velocities[i]); }).round());
  return least;
}

void row(int a, int b, int pairs) {
  RandomBodies random(1);
  std::vector<double> verdicts, contacts;
  for (int i = 0; i < pairs; ++i) {
    const Placed here(body(random, a), testing::any_pose(random, 0));
    const Placed there(body(random, b), testing::any_pose(random, random.uniform(10, 20)));
    const Pair pair(here, there);
    const Vector3d still = Vector3d::Zero();
    std::vector<Vector3d> all, meet;
    for (int k = 0; k < 60; ++k) {
      const Vector3d aside = random.uniform(0, 6) * random.direction();
      all.push_back(k % 3 == 0 ? random.direction() : Vector3d(there.pose.position + aside));
      if (pair.verdict(all.back(), still) == Verdict::in) meet.push_back(all.back());
    }
    verdicts.push_back(time_of(all, [&](const Vector3d& w) { return pair.verdict(w, still); }));
    if (meet.empty()) continue;
    contacts.push_back(time_of(meet, [&](const Vector3d& w) { return pair.contact(w, still)->time; }));
  }
  std::printf("| %s and %s | %.0f ns | %.2f us |\n", kNames[a], kNames[b], median(verdicts),
              median(contacts) / 1000);
}

}  // namespace

int main(int argc, char** argv) {
  const int pairs = argc > 1 ? std::max(std::atoi(argv[1]), 1) : 200;
  std::printf("| two bodies | verdict | first contact |\n| --- | --- | --- |\n");
  for (int a = 0; a < 5; ++a)
    for (int b = a; b < 5; ++b) row(a, b, pairs);
}
