// SPDX-License-Identifier: BSD-3-Clause
//
// Whether two moving bodies met, proved: exact disjointness at the ends of every piece of time, and between
// them a separation with a margin that covers what the bodies can have moved, turned and changed meanwhile.
#pragma once

#include <vericone/simulation/track.h>
#include <cstdint>

namespace vericone::simulation {

enum class ProofVerdict : std::uint8_t {
  avoided,    // proved apart all the time
  touched,    // proved to touch or overlap at a time
  undecided,  // they come closer than the proof resolves
};
[[nodiscard]] const char* to_string(ProofVerdict verdict);

struct ProofOptions {
  /// Metres. The proof holds for all motions whose positions are within this of the track's: rounding and the
  /// integrator's error.
  double padding = 1e-8;
  /// Seconds. A piece of time shorter than this is not divided further: `undecided`.
  double resolution = 1e-7;
  /// m/s. The padding grows by as much since the start of the tracks: the proof holds for every constant
  /// current of at most this speed that carries the bodies, or some of them, off their tracks.
  double drift = 0;
};

struct PairProof {
  ProofVerdict verdict = ProofVerdict::avoided;
  /// touched: apart before `from`, proved; meeting at `to`, proved. undecided: the first piece of time
  /// without proof. avoided: the interval asked about.
  double from = 0, to = 0;  // s
  /// Metres. touched: a point near both bodies at `to`. Otherwise where they come nearest.
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  /// avoided: the distance was never below this, proved, metres; and when they came nearest, about. Within 1
  /// % of the least distance of the convex hulls (1e-6 m) in nearly all runs; a rougher bound where one is in
  /// the other's dent, and by a few % for placed bodies that turn.
  double least_distance = 0, least_time = 0;
  std::uint64_t pieces = 0;  // pieces of time that were proved separately
};

/// Over [from, to], within the life of both tracks. Any two bodies that Pair serves: both planar, or both
/// spatial, otherwise throws InputError naming "bodies". Throws InputError naming "from", "to", "padding",
/// "resolution" or "drift". Method: docs/explanation/proof-of-runs.md. Cost: 0.1 ms for two ellipsoids, 0.3
/// ms with hulls and delimited bodies, milliseconds to tens of them where those meet; a placed body, or a
/// hull and one with dents, a distance and at most two misses of the Pair a piece.
[[nodiscard]] PairProof prove(const Track& a, const Track& b, double from, double to,
                              const ProofOptions& options = {});

}  // namespace vericone::simulation
