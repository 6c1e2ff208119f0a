// SPDX-License-Identifier: GPL-3.0-or-later
#include <vericone/internal/verify/planar/methods.h>
#include <vericone/internal/verify/report.h>
#include <vericone/verify/spatial/campaign.h>

namespace vericone::verify {

std::string planar_report(std::uint64_t cases, std::uint64_t seed) {
  return "sector_by_support\n\n" + to_markdown(run_planar_campaign(answer_by_support, cases, seed)) +
         "\nsector_by_degenerate_conics\n\n" +
         to_markdown(run_planar_campaign(answer_by_degenerate_conics, cases, seed));
}

std::string spatial_report(std::uint64_t cases, std::uint64_t seed) {
  return to_markdown(run_spatial_campaign(cases, seed));
}

}  // namespace vericone::verify
