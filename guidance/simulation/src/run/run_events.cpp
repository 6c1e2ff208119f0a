// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/simulation/run.h>
#include <cmath>

#include "names.h"

namespace vericone::simulation {

const char* to_string(EventKind kind) {
  switch (kind) {
    case EventKind::appears:
      return "appears";
    case EventKind::enters_cone:
      return "enters-cone";
    case EventKind::leaves_cone:
      return "leaves-cone";
    case EventKind::passes:
      return "passes";
    case EventKind::aligned:
      return "aligned";
    case EventKind::reaches_goal:
      return "reaches-goal";
    case EventKind::contact:
      return "contact";
    case EventKind::cannot_avoid:
      return "cannot-avoid";
    case EventKind::goes_through:
      return "goes-through";
    case EventKind::goes_beside:
      return "goes-beside";
  }
  return "?";
}

std::optional<Event> find_event(const Scenario& scenario, const Run& run, EventKind kind,
                                const std::string& agent, const std::string& obstacle, double after) {
  const std::size_t i = index_of(scenario.bodies, agent), j = index_of(scenario.bodies, obstacle);
  for (const Event& event : run.events)
    if (event.kind == kind && event.agent == i && event.obstacle == j && event.t >= after) return event;
  return std::nullopt;
}

std::optional<EncounterSample> sample_at(const Scenario& scenario, const Run& run, const std::string& agent,
                                         const std::string& obstacle, double t) {
  const std::size_t i = index_of(scenario.bodies, agent), j = index_of(scenario.bodies, obstacle);
  std::optional<EncounterSample> nearest;
  for (const EncounterSample& sample : run.encounters)
    if (sample.agent == i && sample.obstacle == j &&
        (!nearest || std::abs(sample.t - t) < std::abs(nearest->t - t)))
      nearest = sample;
  if (nearest && !(std::abs(nearest->t - t) <= scenario.step * (1 + 1e-9))) nearest.reset();
  return nearest;
}

}  // namespace vericone::simulation
