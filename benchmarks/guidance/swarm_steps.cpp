// SPDX-License-Identifier: BSD-3-Clause
//
// Prints, in Markdown, what an agent step costs where a hundred others are in sight: vericone_swarm_steps
// [AGENTS]. Two blocks of ellipsoids cross; `orca` flies the balls about them. Both step by turns; processor
// time.
#include <vericone/internal/cones/random_engagement.h>
#include <vericone/swarm/swarm.h>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

namespace vericone::swarm {
namespace {

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

/// Blocks beside each other that cross at a right angle, each body anyhow turned.
std::vector<Agent> crossing(std::size_t count, bool round) {
  Start start = start_of("crossing", count, 1);
  for (std::size_t i = 0; i < count; ++i) {
    engagements::Random random(17, i);
    start.agents[i].body.half = Eigen::Vector3d(1.5, 1, 0.75);
    start.agents[i].body.rotation = random.rotation();
    if (round) start.agents[i].body = Solid::ball(1.5);
  }
  return start.agents;
}

double in_sight(const Swarm& swarm) {
  std::size_t seen = 0;
  for (const Agent& a : swarm.agents()) {
    std::size_t here = 0;
    for (const Agent& b : swarm.agents())
      here += &a != &b && (a.position - b.position).norm() <= swarm.options().sight;
    seen += std::min(here, swarm.options().neighbours);
  }
  return double(seen) / double(swarm.agents().size());
}

struct Side {
  const char* name;
  Swarm swarm;
  std::vector<double> seconds = {};
};

void table(std::size_t count) {
  const auto options = [](SwarmOptions given) {
    given.neighbours = 100;
    given.sight = 30;
    return given;
  };
  std::vector<Side> sides;
  sides.push_back({"ellipsoids, proved", Swarm(crossing(count, false), {}, options({}))});
  sides.push_back({"balls, proved", Swarm(crossing(count, true), {}, options({}))});
  sides.push_back({"balls, orca", Swarm(crossing(count, true), {}, options(SwarmOptions::published()))});
  std::printf(
      "| | s | in sight | us an agent step, median | least | of orca's |\n|---|---|---|---|---|---|\n");
  for (const double until : {30.0, 50.0, 70.0, 90.0}) {
    for (Side& side : sides) side.seconds.clear();
    while (sides[0].swarm.time() < until)
      for (Side& side : sides) {
        const double start = cpu_seconds();
        side.swarm.step();
        side.seconds.push_back((cpu_seconds() - start) / double(count));
      }
    for (Side& side : sides) std::sort(side.seconds.begin(), side.seconds.end());
    const double beside = sides[2].seconds[sides[2].seconds.size() / 2];
    for (const Side& side : sides) {
      const double median = side.seconds[side.seconds.size() / 2];
      std::printf("| %s | %g | %.0f | %.1f | %.1f | %.2f |\n", side.name, until, in_sight(side.swarm),
                  1e6 * median, 1e6 * side.seconds[0], median / beside);
    }
  }
}

}  // namespace
}  // namespace vericone::swarm

int main(int argc, char** argv) {
  vericone::swarm::table(argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 1000);
}
