// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "certificate/stated.h"

namespace vericone::simulation::certified {

/// Two bodies on their tubes, which are to be proved farther apart than `by` m at all times of [from, to].
struct PairQuestion {
  const Solid& a;
  const Solid& b;
  const StatedTrack& track_a;
  const StatedTrack& track_b;
  double by, from, to;
  bool dents = false;           // one of them has some
  std::vector<double> times{};  // s: where to look first, for what is proved of one time
};

/// The proof, JSON, each of whose planes was checked in integers: one plane for each piece of time, by groups
/// of the bodies' pieces where one does not do for all, boxes for runs of many. Nothing, and the `reason`,
/// where none was found.
[[nodiscard]] std::optional<std::string> proof_of_pair(const PairQuestion& question, std::string& reason);

/// The same, one proof after the other from cut to cut, which ascend within the time.
[[nodiscard]] std::optional<std::string> proof_by_times(const PairQuestion& question,
                                                        const std::vector<double>& cuts, std::string& reason);

/// Of groups of pieces by planes. `stuck`: the time from which there is none.
[[nodiscard]] std::optional<StatedPieces> planes_between(const Side& a, const Side& b, double by, double from,
                                                         double to, double& stuck);

/// The largest n.x of the points x of a side at a time, in doubles.
[[nodiscard]] double reach_at(const Side& side, double t, const Eigen::Vector3d& n);

}  // namespace vericone::simulation::certified
