#include <vericone/vericone.h>
#include <iostream>
using namespace vericone;

int main() {
  const Placed agent(Ellipsoid::from_axes({0, 0, 0}, {1, 1, 0.5}));
  const Placed obstacle(HullBody::box({-1, -1, -1}, {1, 1, 1}), {{6, 0, 0}});
  const Pair pair(agent, obstacle);  // any two bodies; prepared for many velocities
  for (double climb : {0.0, 2.0, 5.0}) {
    const Eigen::Vector3d velocity(8, 0, climb), still(0, 0, 0);  // m/s
    std::cout << to_string(pair.verdict(velocity, still));        // exact: in, on, out
    if (const auto contact = pair.contact(velocity, still)) std::cout << " after " << contact->time << " s\n";
    else std::cout << ", passes at " << pair.miss(velocity, still).distance << " m\n";
  }
}
