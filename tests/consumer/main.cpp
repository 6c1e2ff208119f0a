// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/ellipsoids/true_cone.h>
#include <vericone/guidance/guide.h>
#include <vericone/simulation/run.h>
#include <cstdio>

int main() {
  using namespace vericone;
  const Ellipsoid a = Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1}),
                  b = Ellipsoid::from_axes({5, 0, 0}, {2, 2, 2});
  const ConeOracle oracle(a, b);
  if (oracle.membership({4, 3, 0}) != Membership::on) return 1;
  std::printf("%.15g\n", true_cone(a, b, 48).solid_angle);

  guidance::BodyState agent{CombinedEllipsoid(a)}, obstacle{CombinedEllipsoid(b)};
  agent.velocity = {4, 1, 0};
  obstacle.position = b.center();
  guidance::GuideMemory memory;
  const auto step = guidance::guide(agent, obstacle, {}, memory, 0);
  if (!step || !(step->a.y() > 0)) return 2;

  simulation::Scenario scenario;
  scenario.duration = 1;
  scenario.bodies.resize(2);
  scenario.bodies[0] = {"A", simulation::RigidShape{CombinedEllipsoid(a)}, {{0, 0, 0}, agent.velocity}};
  scenario.bodies[1] = {
      "B", simulation::RigidShape{CombinedEllipsoid(b.translated(-b.center()))}, {b.center()}};
  scenario.bodies[0].pilot.emplace().guide.inversion.most = 50;
  std::printf("%s\n", to_string(simulation::simulate(scenario).verdict()));
}
