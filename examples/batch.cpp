// Which of many relative velocities w = v_agent - v_obstacle collide? A grid of a million, in one call.
#include <vericone/cones/ellipsoids/predicates.h>
#include <algorithm>
#include <iostream>
#include <vector>
using namespace vericone;

int main() {
  const Ellipsoid agent = Ellipsoid::from_axes({0, 0, 0}, {1, 1, 0.5});
  const Ellipsoid obstacle = Ellipsoid::from_axes({10, 2, 0}, {2, 3, 1});
  const ConeOracle oracle(agent, obstacle);
  std::vector<Eigen::Vector3d> w;
  for (int i = 0; i < 1000; ++i)
    for (int j = 0; j < 1000; ++j) w.emplace_back(10, 0.02 * (i - 500), 0.02 * (j - 500));  // m/s
  std::vector<Membership> answers(w.size());
  oracle.memberships(w, answers);  // a few nanoseconds each, exact
  std::cout << std::count(answers.begin(), answers.end(), Membership::in) << " of " << w.size() << " collide\n";
}
