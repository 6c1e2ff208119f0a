// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/simulation/moving_orifice.h>

namespace vericone::simulation {

guidance::OrificeState MovingOrifice::at(double t) const {
  const guidance::OrificeState start{{opening, position, rotation.leftCols<2>()}, velocity, spin};
  return start.after(t - appears);
}

}  // namespace vericone::simulation
