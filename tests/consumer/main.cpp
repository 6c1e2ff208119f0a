// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/exact_cone.h>
#include <cstdio>

int main() {
  using namespace vericone;
  const Ellipsoid a = Ellipsoid::from_axes({0, 0, 0}, {1, 1, 1}),
                  b = Ellipsoid::from_axes({5, 0, 0}, {2, 2, 2});
  const ConeOracle oracle(a, b);
  if (oracle.membership({4, 3, 0}) != Membership::on) return 1;
  std::printf("%.15g\n", exact_cone(a, b, 48).solid_angle);
}
