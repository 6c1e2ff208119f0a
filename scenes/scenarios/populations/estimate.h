// SPDX-License-Identifier: BSD-3-Clause
//
// Shares of a population from what was drawn of it, with intervals that hold them.
#pragma once

#include <cstdint>

#include "scenarios/populations/population.h"

namespace vericone::populations {

inline constexpr double kConfidence = 0.95;

struct Bounds {
  double low = 0, high = 1;
};

/// For the mean of `count` independent observations x >= 0 that are mostly 0, by the gamma distributions of
/// Fay and Feuer (Statistics in Medicine 16 (1997) 791-801), (4) and (5): of equal x Garwood's interval of a
/// Poisson count, so never too short then; of others they found none too short. It knows of no x that was not
/// seen: where a few large ones that are rare among what is drawn make up the mean, it may miss it.
/// `largest`: of all x that can be, which decides alone where the sum is 0.
[[nodiscard]] Bounds gamma_bounds(const Moments& moments, std::uint64_t count, double largest,
                                  double confidence = kConfidence);

/// For the mean of `count` independent observations between 0 and `largest`, whatever they are, also where
/// their own means differ: no bet against the mean grows to 2 / (1 - confidence) but with half that risk on
/// either side (Waudby-Smith and Ramdas, J. R. Stat. Soc. B 86 (2024), by Ville's inequality), where bets of
/// c 2^-j have a share 1 / ((j + 1) (j + 2)) of the stake and a factor 1 + y >= exp(y - psi(c) y^2) for
/// y >= -c (Fan, Grama and Liu, Electron. J. Probab. 20 (2015)). Never right less often than said; where
/// nothing was seen `high` is 4.9 largest / count. Cost: 20 us.
[[nodiscard]] Bounds betting_bounds(const Moments& moments, std::uint64_t count, double largest,
                                    double confidence = kConfidence);

/// The share of a population that collides.
struct Estimate {
  double share = 0;
  /// Holds the share in 95 of 100 campaigns or more, whatever was not seen: of encounters without weights and
  /// with one velocity each by Clopper and Pearson (1934), otherwise betting_bounds(). What is undecided
  /// counts as no collision for `low`, as one for `high`.
  double low = 0, high = 1;
  /// gamma_bounds(), within which it is as often if what collides is drawn often enough to be seen: not where
  /// a proposal misses a part of it. The same where `exact`.
  Bounds covered;
  bool exact = true;
  double effective_hits = 0;                      // (sum x)^2 / sum x^2 of what collides
  double effective_encounters = 0;                // (sum w)^2 / sum w^2 of all weights
  double mean_weight = 1, mean_weight_error = 0;  // its standard error: 1 is expected
};
[[nodiscard]] Estimate estimate_of(const Tally& tally, const Population& population);

/// The sum of two tallies; of tallies in the same order always the same bits.
void add(const Tally& more, Tally& to);

}  // namespace vericone::populations
