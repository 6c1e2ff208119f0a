#include <vericone/vericone.h>
#include <iostream>
using namespace vericone;

int main() {
  const Placed agent(Ellipsoid::from_axes({0, 0, 0}, {3, 1, 1}));
  const Placed box(HullBody::box({-1, -4, -2}, {1, 4, 2}), {{20, 6, 0}});
  const Eigen::Vector3d v_agent(8, 1.6, 0), v_box(-3, -1, 0);  // m/s
  const Pair pair(agent, box);                                 // any two bodies; prepared for many velocities
  std::cout << to_string(pair.verdict(v_agent, v_box));        // exact: in (they will collide), on (graze), out
  if (const auto contact = pair.contact(v_agent, v_box)) std::cout << " after " << contact->time << " s\n";
}
