// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>

#include "pairs/family.h"

namespace vericone::pairs {

FamilyPointer composite_family(const CombinedEllipsoid&, const Assembly&, const Pose&, double) {
  throw InputError("obstacle", "a body of pieces", "not yet");
}
FamilyPointer composite_family(const Assembly&, const Pose&, const Assembly&, const Pose&) {
  throw InputError("obstacle", "a body of pieces", "not yet");
}

}  // namespace vericone::pairs
