// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/simulation/montecarlo/campaign.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace vericone::montecarlo {
namespace {

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Counts over the outcomes that `of` takes from the rows.
template <typename Of>
Counts count(const std::vector<Row>& rows, Of of) {
  Counts c;
  std::vector<double> peaks, left;
  c.least_distances.assign(std::size_t(kLastBin / kBin) + 1, 0);
  for (const Row& row : rows) {
    const Outcome& o = of(row);
    c.avoided += o.fate == Fate::avoided;
    c.undecided += o.fate == Fate::undecided;
    c.infeasible += o.fate == Fate::met && !o.called_safe;
    c.called_safe_and_met += o.fate == Fate::met && o.called_safe;
    if (o.fate != Fate::avoided) continue;
    ++c.least_distances[std::size_t(std::clamp(o.least_distance, 0.0, kLastBin) / kBin)];
    if (o.peak > 0) peaks.push_back(o.peak);
    if (!std::isnan(o.left_cone)) left.push_back(o.left_cone);
  }
  c.median_peak = median(peaks);
  c.median_left_cone = median(left);
  return c;
}

/// Laws whose word is a theorem about the straight flight that follows it: they ask the true cone, or m.
bool word_is_proof(const Flown& law) {
  return law.guide.law == guidance::Law::clearance || law.guide.sector == guidance::SectorMethod::true_cone;
}

}  // namespace

Summary summarise(const std::vector<Row>& rows, const std::vector<Flown>& laws) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].outcomes.size() < laws.size())
      throw InputError("rows[" + std::to_string(i) + "].outcomes",
                       std::to_string(rows[i].outcomes.size()) + " outcomes",
                       "one for each law, " + std::to_string(laws.size()));
  const auto number = [&](auto which) {
    return std::uint64_t(std::count_if(rows.begin(), rows.end(), which));
  };
  const auto met = [](const Row& r) { return r.straight.outcome.fate == Fate::met; };
  Summary s;
  s.engagements = rows.size();
  s.straight = count(rows, [](const Row& r) -> const Outcome& { return r.straight.outcome; });
  s.slice_called_safe_and_met = number([&](const Row& r) { return met(r) && r.straight.slice_called_safe; });
  s.exact_called_safe_and_met = number([&](const Row& r) { return met(r) && r.straight.exact_called_safe; });
  s.predicate_called_safe_and_met =
      number([&](const Row& r) { return met(r) && r.straight.outcome.called_safe; });
  s.exact_called_unsafe_and_avoided = number([&](const Row& r) {
    return r.straight.outcome.fate == Fate::avoided && !r.straight.exact_called_safe;
  });
  for (std::size_t i = 0; i < laws.size(); ++i) {
    Summary::OfLaw law{laws[i].name, laws[i].guide.inversion.most, word_is_proof(laws[i]), {}};
    law.counts = count(rows, [i](const Row& r) -> const Outcome& { return r.outcomes[i]; });
    law.made_worse = number([&](const Row& r) {
      return r.straight.outcome.fate == Fate::avoided && r.outcomes[i].fate == Fate::met;
    });
    s.laws.push_back(std::move(law));
  }
  return s;
}

std::uint64_t violations(const Summary& s) {
  auto wrong = s.exact_called_safe_and_met + s.predicate_called_safe_and_met;
  for (const Summary::OfLaw& law : s.laws)
    if (law.word_is_proof) wrong += law.counts.called_safe_and_met;
  return wrong;
}

}  // namespace vericone::montecarlo
