// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/simulation/pilot.h>
#include <vericone/simulation/reach.h>

#include "pilots/kinds.h"

namespace vericone::simulation {

ReachLimits PilotModel::limits(const Body&, double) const { return {}; }

std::shared_ptr<const PilotModel> model_of(const Pilot& pilot) {
  if (pilot.own) return pilot.own;
  if (pilot.through) return through_pilot(pilot);
  return guarded(pilot) ? guarded_pilot(pilot) : law_pilot(pilot);
}

bool minds_bodies(const Pilot& pilot) { return !pilot.own && !pilot.through; }

bool guarded(const Pilot& pilot) {
  const guidance::Law law = pilot.guide.law;
  return minds_bodies(pilot) && pilot.manner == Manner::guarded &&
         (law == guidance::Law::avoidance || law == guidance::Law::clearance);
}

double most_commanded(const Pilot& pilot) { return model_of(pilot)->most(); }

}  // namespace vericone::simulation
