// SPDX-License-Identifier: BSD-3-Clause
#include "claims.h"

namespace vericone::dhal2022 {

std::vector<Claim> measure_claims(PaperRuns& runs, const RunProgress& progress) {
  std::vector<Claim> claims;
  claims_5_4_1(runs, claims);
  claims_5_4_2(runs, claims);
  claims_6_3_1(progress, claims);
  claims_6_5_noncooperative(runs, claims);
  claims_6_5_cooperative(runs, claims);
  claims_of_equations(runs, claims);
  count_fits(claims);
  return claims;
}

}  // namespace vericone::dhal2022
