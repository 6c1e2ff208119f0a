// SPDX-License-Identifier: BSD-3-Clause
//
// Printed values that go into a run, read back from the scenario's body.
#pragma once

#include <string>
#include <vector>

#include "claim.h"
#include "paper_run.h"

namespace vericone::dhal2022 {

/// What the source prints of a body; what it does not stays empty.
struct GivenBody {
  std::vector<double> semi_axes;    // m; of (5.5) a_c, b_c
  std::optional<double> k;          // of (5.5)
  std::vector<double> position;     // m
  std::optional<double> speed;      // m/s
  std::vector<double> heading_deg;  // azimuth; in space azimuth, elevation
  std::optional<double> appears;    // s
};

/// One claim for each: PREFIX/BODY-axes, -k, -position, -speed, -heading, -appears.
void given_body(const PaperRun& run, const std::string& section, const std::vector<std::string>& figures,
                const std::string& body, const GivenBody& printed, std::vector<Claim>& claims);

}  // namespace vericone::dhal2022
