// SPDX-License-Identifier: BSD-3-Clause
#include "track/metrics.h"

#include <algorithm>
#include <cmath>

namespace vericone::tracking {

Metrics compare(const std::vector<std::vector<Said>>& said, const Truth& truth) {
  constexpr int kThresholds = 21;  // overlaps 0, 0.05 ... 1, as success plots have them
  constexpr double kPrecise = 20;  // px
  Metrics m;
  std::size_t right = 0, precise = 0, successes = 0;
  for (std::size_t i = 0; i < said.size(); ++i)
    for (std::size_t k = 1; k < said[i].size(); ++k) {
      if (truth.absent[i].contains(said[i][k].frame)) {
        ++m.absent_rows;
        m.absent_claims += said[i][k].sighting.measured;
      }
      const auto row = truth.boxes[i].find(said[i][k].frame);
      if (row == truth.boxes[i].end()) continue;
      ++m.rows;
      const vision::Sighting& s = said[i][k].sighting;
      if (!s.measured) continue;
      ++m.claims;
      const double o = vision::overlap(s.box, row->second);
      right += o > 0;
      precise += (s.box.centre() - row->second.centre()).norm() <= kPrecise;
      for (int t = 0; t < kThresholds; ++t) successes += o > t / double(kThresholds - 1);
    }
  m.false_claims = m.claims - right;
  if (m.claims > 0) m.claims_right = double(right) / double(m.claims);
  if (m.rows > 0) {
    m.success_auc = double(successes) / double(m.rows * kThresholds);
    m.precision_20px = double(precise) / double(m.rows);
  }
  return m;
}

std::size_t longest_loss(const std::vector<std::vector<Said>>& said) {
  std::size_t longest = 0;
  for (const auto& target : said) {
    std::size_t now = 0;
    for (const Said& one : target) {
      now = one.sighting.measured ? 0 : now + 1;
      longest = std::max(longest, now);
    }
  }
  return longest;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto k =
      std::min(values.size() - 1, std::size_t(std::ceil(share * double(values.size()))) - (share > 0));
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(k), values.end());
  return values[k];
}

}  // namespace vericone::tracking
