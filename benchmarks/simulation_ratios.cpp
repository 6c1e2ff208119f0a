// SPDX-License-Identifier: BSD-3-Clause
//
// Prints, in Markdown, how much faster than real time scenarios run: the closed loop alone (guidance,
// integration, events), with proof, and with log and proof. The loop's step is the scenario's, or the one
// given.
//
// Usage: vericone_simulation_ratios STEP SCENARIO.yaml...   (STEP in seconds; 0: the scenario's)
#include <vericone/scenarios/scenario_files.h>
#include <vericone/simulation/run.h>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

using namespace vericone;
using Clock = std::chrono::steady_clock;

struct Time {
  double median, least;  // s
};

Time time_of(const simulation::Scenario& scenario, const simulation::RunOptions& options, double& simulated) {
  std::vector<double> seconds;
  const Clock::time_point start = Clock::now();
  while (seconds.size() < 5 || (Clock::now() - start < std::chrono::seconds(1) && seconds.size() < 500)) {
    const Clock::time_point begin = Clock::now();
    simulated = simulation::simulate(scenario, options).end;
    seconds.push_back(std::chrono::duration<double>(Clock::now() - begin).count());
  }
  std::sort(seconds.begin(), seconds.end());
  return {seconds[seconds.size() / 2], seconds.front()};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: %s STEP SCENARIO.yaml...\n", argv[0]);
    return 2;
  }
  try {
    std::printf(
        "| scenario | simulated | step | loop | times real time | with proof | with log and proof |\n");
    std::printf("| --- | --- | --- | --- | --- | --- | --- |\n");
    for (int i = 2; i < argc; ++i) {
      simulation::Scenario scenario = scenario::read_scenario(argv[i]);
      if (const double step = std::atof(argv[1]); step > 0) scenario.step = step;
      double simulated = 0;
      simulation::RunOptions loop, proof, all;
      loop.log = proof.log = loop.prove = false;
      const Time bare = time_of(scenario, loop, simulated), proved = time_of(scenario, proof, simulated),
                 logged = time_of(scenario, all, simulated);
      std::printf("| %s | %.4g s | %g s | %.3f ms (least %.3f) | %.0f (best %.0f) | %.0f | %.0f |\n",
                  scenario.name.c_str(), simulated, scenario.step, 1e3 * bare.median, 1e3 * bare.least,
                  simulated / bare.median, simulated / bare.least, simulated / proved.median,
                  simulated / logged.median);
    }
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
  }
}
