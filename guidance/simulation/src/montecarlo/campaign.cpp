// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/simulation/montecarlo/flight.h>
#include <vericone/simulation/montecarlo/campaign.h>
#include <algorithm>
#include <cmath>

namespace vericone::montecarlo {
namespace {

void require_positive(const char* field, double value, const char* unit) {
  if (!(value > 0) || !std::isfinite(value))
    throw InputError(field, to_text(value), std::string("a positive number") + unit);
}

}  // namespace

std::vector<Flown> laws_of(const Campaign& campaign) {
  if (campaign.engagements < 1 || campaign.engagements > 100'000'000)
    throw InputError("engagements", std::to_string(campaign.engagements), "between 1 and 100000000");
  const FlightSettings& flight = campaign.flight;
  require_positive("most", flight.most, " (m/s^2)");
  if (!(flight.most < kUnlimited))
    throw InputError("most", to_text(flight.most),
                     "below " + to_text(kUnlimited) + " m/s^2, which is unlimited here");
  require_positive("gain", flight.gain, " (1/s)");
  if (!std::isfinite(flight.reference))
    throw InputError("reference", to_text(flight.reference), "a finite number");
  require_positive("required", flight.required, " (m)");
  require_positive("step", flight.step, " (s)");
  if (flight.step < 1e-4) throw InputError("step", to_text(flight.step), "0.0001 s or more");
  for (const std::string& law : campaign.laws)
    if (std::count(campaign.laws.begin(), campaign.laws.end(), law) > 1)
      throw InputError("laws", law, "given once");
  return flown_laws(campaign.laws, flight);
}

std::string settings_line(const Campaign& campaign) {
  std::string laws;
  for (const std::string& name : campaign.laws) laws += (laws.empty() ? "" : "+") + name;
  const FlightSettings& flight = campaign.flight;
  return "# vericone campaign, seed " + std::to_string(campaign.seed) + ", " +
         std::to_string(campaign.engagements) + " engagements, laws " + laws + ", most " +
         to_text(flight.most) + ", gain " + to_text(flight.gain) + ", reference " +
         to_text(flight.reference) + ", required " + to_text(flight.required) + ", step " +
         to_text(flight.step);
}

}  // namespace vericone::montecarlo
