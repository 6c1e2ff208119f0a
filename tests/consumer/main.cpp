// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/ellipsoids/true_cone.h>
#include <vericone/guidance/guide.h>
#include <cstdio>

using namespace vericone;

#ifdef WITH_SIMULATION
const char* simulated(const Ellipsoid& a, const Ellipsoid& b, const Eigen::Vector3d& velocity);
#endif

#ifdef WITH_VISION
bool tracked();
#endif

int main() {
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

#ifdef WITH_VISION
  if (!tracked()) return 3;
#endif
#ifdef WITH_SIMULATION
  std::printf("%s\n", simulated(a, b, agent.velocity));
#endif
}
