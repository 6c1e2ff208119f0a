#include <vericone/vericone.h>
#include <iostream>
using namespace vericone;

int main() {
  guidance::BodyState agent{CombinedEllipsoid(Ellipsoid::from_axes({0, 0, 0}, {1, 1, 0.5}))};
  agent.velocity = {8, 0, 0};  // m/s
  std::vector<guidance::BodyState> others;
  for (double y : {-3.0, 0.0, 3.0})
    others.push_back({CombinedEllipsoid(Ellipsoid::from_axes({30, y, 0}, {1, 1, 1})), {30, y, 0}});
  guidance::Navigator navigator({.most = 5});  // m/s^2
  const auto step = navigator.step(agent, others, guidance::Destination{{60, 0, 0}, 5}, 0.0, 0.02);
  std::cout << to_string(step.status) << ", passes at " << step.least << " m\n";
}
