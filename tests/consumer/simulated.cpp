// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/simulation/run.h>

using namespace vericone;

const char* simulated(const Ellipsoid& a, const Ellipsoid& b, const Eigen::Vector3d& velocity) {
  simulation::Scenario scenario;
  scenario.duration = 1;
  scenario.bodies.resize(2);
  scenario.bodies[0] = {"A", simulation::RigidShape{CombinedEllipsoid(a)}, {{0, 0, 0}, velocity}};
  scenario.bodies[1] = {
      "B", simulation::RigidShape{CombinedEllipsoid(b.translated(-b.center()))}, {b.center()}};
  scenario.bodies[0].pilot.emplace().guide.inversion.most = 50;
  return to_string(simulation::simulate(scenario).verdict());
}
