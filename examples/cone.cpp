#include <vericone/vericone.h>
#include <iostream>
using namespace vericone;

int main() {
  const Placed agent(Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1}));
  const Placed dented(CombinedEllipsoid(Ellipsoid::from_axes({8, 0, 0}, {2, 3, 3}), {hyperboloid(2, {0.5, 1, 1})}));
  const Cone cone = Pair(agent, dented).cone({.tolerance = 0.02});  // inner <= true cone <= outer, proved
  std::cout << "solid angle between " << cone.solid_angle.lo() << " and " << cone.solid_angle.hi() << " sr\n";
  const Eigen::Vector3d ahead(1, 0, 0), aside(1, 1, 0);
  std::cout << (cone.contains(ahead) == Certified::in) << (cone.contains(aside) == Certified::out) << '\n';
}
