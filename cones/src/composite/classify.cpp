// SPDX-License-Identifier: BSD-3-Clause
#include "composite/state.h"

namespace vericone {
Frontier CompositePair::start() const { return {}; }
Certified CompositePair::classify(const DirectionCell&, const Frontier&, Frontier&) const {
  return Certified::undecided;
}
}  // namespace vericone
