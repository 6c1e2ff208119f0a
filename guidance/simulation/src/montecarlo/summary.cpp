// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/error.h>
#include <vericone/internal/simulation/montecarlo/flight.h>
#include <vericone/simulation/montecarlo/campaign.h>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace vericone::montecarlo {
namespace {

/// The value at the middle of values that are told as often as there are passes: sixteen of its bits come
/// with each pass, and no value is kept.
class Median {
 public:
  static constexpr int kPasses = 4;

  void take(double x) {
    const std::uint64_t bits = ordered(x);
    if (pass_ == 0 || bits >> (shift() + kBits) == known_) ++counts_[(bits >> shift()) & kLast];
  }
  void end_pass() {
    if (pass_ == 0) {
      count_ = std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0});
      before_ = count_ / 2;
    }
    if (count_ == 0) return;
    std::uint64_t digit = 0;
    while (before_ >= counts_[digit]) before_ -= counts_[digit++];
    known_ = known_ << kBits | digit;
    ++pass_;
    std::fill(counts_.begin(), counts_.end(), 0);
  }
  /// NaN of none.
  [[nodiscard]] double value() const {
    if (count_ == 0) return std::numeric_limits<double>::quiet_NaN();
    return std::bit_cast<double>(known_ & kSign ? known_ ^ kSign : ~known_);
  }

 private:
  static constexpr int kBits = 16;
  static constexpr std::uint64_t kLast = 0xffff, kSign = std::uint64_t{1} << 63;

  /// Bits that stand in the order of the numbers.
  static std::uint64_t ordered(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    return bits & kSign ? ~bits : bits | kSign;
  }
  [[nodiscard]] int shift() const { return 64 - kBits * (pass_ + 1); }

  int pass_ = 0;
  std::uint64_t count_ = 0, before_ = 0,
                known_ = 0;  // before_: of those with the known bits, how many are smaller
  std::vector<std::uint64_t> counts_ = std::vector<std::uint64_t>(kLast + 1);
};

/// What is counted of the outcomes of one law, or of straight flight.
struct Tally {
  Counts counts;
  Median peak, left_cone;

  void take(const Outcome& o, bool first_pass) {
    const bool avoided = o.fate == Fate::avoided;
    if (first_pass) {
      counts.avoided += avoided;
      counts.undecided += o.fate == Fate::undecided;
      counts.infeasible += o.fate == Fate::met && !o.called_safe;
      counts.called_safe_and_met += o.fate == Fate::met && o.called_safe;
      if (avoided) ++counts.least_distances[std::size_t(std::clamp(o.least_distance, 0.0, kLastBin) / kBin)];
    }
    if (avoided && o.peak > 0) peak.take(o.peak);
    if (avoided && !std::isnan(o.left_cone)) left_cone.take(o.left_cone);
  }
  void end_pass() {
    peak.end_pass();
    left_cone.end_pass();
    counts.median_peak = peak.value();
    counts.median_left_cone = left_cone.value();
  }
};

/// Laws whose word is a theorem about the straight flight that follows it: they ask the true cone, or m.
bool word_is_proof(const Flown& law) {
  return law.guide.law == guidance::Law::clearance || law.guide.sector == guidance::SectorMethod::true_cone;
}

void take_straight(const Row& row, Summary& s) {
  const StraightOutcome& straight = row.straight;
  const bool met = straight.outcome.fate == Fate::met;
  s.slice_called_safe_and_met += met && straight.slice_called_safe;
  s.exact_called_safe_and_met += met && straight.exact_called_safe;
  s.predicate_called_safe_and_met += met && straight.outcome.called_safe;
  s.exact_called_unsafe_and_avoided += straight.outcome.fate == Fate::avoided && !straight.exact_called_safe;
}

/// Of rows that `each` gives to what it is called with.
template <typename Each>
Summary summary_of(const Each& each, const std::vector<Flown>& laws) {
  Summary s;
  for (const Flown& law : laws)
    s.laws.push_back({law.name, law.guide.inversion.most, word_is_proof(law), {}, 0});
  std::vector<Tally> tallies(1 + laws.size());
  for (Tally& tally : tallies) tally.counts.least_distances.resize(std::size_t(kLastBin / kBin) + 1);
  for (int pass = 0; pass < Median::kPasses; ++pass) {
    each([&](const Row& row) {
      tallies[0].take(row.straight.outcome, pass == 0);
      for (std::size_t i = 0; i < laws.size(); ++i) tallies[1 + i].take(row.outcomes[i], pass == 0);
      if (pass > 0) return;
      ++s.engagements;
      take_straight(row, s);
      for (std::size_t i = 0; i < laws.size(); ++i)
        s.laws[i].made_worse +=
            row.straight.outcome.fate == Fate::avoided && row.outcomes[i].fate == Fate::met;
    });
    for (Tally& tally : tallies) tally.end_pass();
  }
  s.straight = tallies[0].counts;
  for (std::size_t i = 0; i < laws.size(); ++i) s.laws[i].counts = tallies[1 + i].counts;
  return s;
}

}  // namespace

Summary summarise(const std::vector<Row>& rows, const std::vector<Flown>& laws) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].outcomes.size() < laws.size())
      throw InputError("rows[" + std::to_string(i) + "].outcomes",
                       std::to_string(rows[i].outcomes.size()) + " outcomes",
                       "one for each law, " + std::to_string(laws.size()));
  return summary_of([&](const auto& take) { std::for_each(rows.begin(), rows.end(), take); }, laws);
}

Summary summarise_file(const std::filesystem::path& file, const std::vector<Flown>& laws) {
  return summary_of([&](const auto& take) { each_row(file, laws.size(), take); }, laws);
}

std::uint64_t violations(const Summary& s) {
  auto wrong = s.exact_called_safe_and_met + s.predicate_called_safe_and_met;
  for (const Summary::OfLaw& law : s.laws)
    if (law.word_is_proof) wrong += law.counts.called_safe_and_met;
  return wrong;
}

}  // namespace vericone::montecarlo
