// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/vision/tracker.h>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "json/json_forward.h"
#include "track/truth.h"

namespace vericone::tracking {

/// What a tracker said of one target in one frame.
struct Said {
  std::size_t frame = 1;
  vision::Sighting sighting;
};

/// Over the true boxes of all targets but the first one of each, which was given. A frame without a
/// measurement is a miss, wherever the expected box is. Frames from which a target is absent are no rows.
struct Metrics {
  std::size_t rows = 0, claims = 0, false_claims = 0;
  double success_auc = 0, precision_20px = 0;      // shares of `rows`
  std::optional<double> claims_right;              // share of `claims`: the box meets the true one
  std::size_t absent_rows = 0, absent_claims = 0;  // frames from which it is absent; those with a claim
};
[[nodiscard]] Metrics compare(const std::vector<std::vector<Said>>& said, const Truth& truth);

/// Pictures in a row without a measurement, at most, of one target.
[[nodiscard]] std::size_t longest_loss(const std::vector<std::vector<Said>>& said);

/// The value below or at which a share of them lies; 0 of none.
[[nodiscard]] double quantile(std::vector<double> values, double share);

}  // namespace vericone::tracking
