// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/guidance/orifice_law.h>

#include <Eigen/Geometry>

namespace vericone::guidance {

OrificeState OrificeState::after(double seconds) const {
  OrificeState later = *this;
  later.opening.center += seconds * velocity;
  // Rodrigues' formula.
  if (const double rate = spin.norm(); rate > 0)
    later.opening.axes = Eigen::AngleAxisd(rate * seconds, spin / rate).toRotationMatrix() * opening.axes;
  return later;
}

}  // namespace vericone::guidance
