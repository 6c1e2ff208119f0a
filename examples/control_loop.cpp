// Verdicts in a control loop: at every step keep the velocity if it is safe, else take the safe heading nearest to it.
// What is not decided counts as a collision.
#include <vericone/vericone.h>
#include <cmath>
#include <iostream>
using namespace vericone;

int main() {
  const Body agent(Ellipsoid::from_axes({0, 0, 0}, {0.4, 0.4, 0.15})), crate(HullBody::box({-1, -1, -1}, {1, 1, 1}));
  const double step = 0.05, keep = 0.3;                      // s, m
  Eigen::Vector3d p(0, 0, 0), v(4, 0, 0);                    // of the agent: m, m/s
  Eigen::Vector3d p_crate(12, -2, 0), v_crate(0, 0.8, 0);    // what a sensor would say
  const auto safe = [&](const Pair& pair, const Eigen::Vector3d& velocity) {
    return !may_collide(pair.verdict(velocity, v_crate)) && pair.miss(velocity, v_crate).least >= keep;
  };
  for (double t = 0; p.x() < 16; t += step) {
    const Pair pair(Placed(agent, {p}), Placed(crate, {p_crate}));  // once a step, then many questions
    if (!safe(pair, v)) {
      const double heading = std::atan2(v.y(), v.x()), speed = v.norm();
      for (int i = 1; i <= 60; ++i) {  // headings from the present one outwards, left and right in turn
        const double turned = heading + 0.05 * (i % 2 ? (i + 1) / 2 : -i / 2);
        const Eigen::Vector3d candidate(speed * std::cos(turned), speed * std::sin(turned), 0);
        if (!safe(pair, candidate)) continue;
        std::cout << "at " << t << " s: " << to_string(pair.verdict(v, v_crate)) << ", turns to " << turned << " rad\n";
        v = candidate;
        break;
      }
    }
    p += step * v;
    p_crate += step * v_crate;
  }
  std::cout << "passed at y = " << p.y() << " m\n";
}
