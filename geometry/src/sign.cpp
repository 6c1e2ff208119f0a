// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/sign.h>

namespace vericone {

const char* to_string(Sign sign) {
  return sign == Sign::negative ? "negative" : sign == Sign::zero ? "zero" : "positive";
}

const char* to_string(Rung rung) {
  return rung == Rung::triage ? "triage" : rung == Rung::interval ? "interval" : "exact";
}

}  // namespace vericone
