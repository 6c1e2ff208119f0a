// SPDX-License-Identifier: BSD-3-Clause
//
// Openings as certificates state them: a flat ring about a hole, on a track of its own.
#pragma once

#include <vericone/simulation/proof.h>
#include <optional>
#include <string>
#include <vector>

#include "certificate/planes.h"

namespace vericone::simulation::certified {

/// An outline that is star-shaped about `center`, in the plane of the opening.
struct StarShaped {
  std::vector<Eigen::Vector2d> outline;  // m, about the center; counterclockwise, of few digits
  Eigen::Vector2d center;                // m
  double inner;                          // m: no line through two neighbours is nearer to the center
};

/// Within the opening by some millionths of it: polygons as they are, ellipses by a polygon of 64 corners.
/// Nothing of a polygon that is not star-shaped about the origin of its plane, nor about its deepest point.
[[nodiscard]] std::optional<StarShaped> star_shaped_within(const Opening& opening);

/// How much larger than the hole a ring is that holds the rim, and no more.
constexpr double kRim = 1 + 0x1p-9;

/// The ring from the outline to `extent`, a power of two or kRim, times it.
[[nodiscard]] Solid ring(const StarShaped& hole, double extent);

/// How the hole's center moves, and its frame turns, until `to`. Nothing where the center goes round in
/// circles.
[[nodiscard]] std::optional<Track> hole_track(const MovingOrifice& orifice, const StarShaped& hole,
                                              double to);

/// A time about `t` from which, going back (forth), the agent, question.a, is first wholly on the side of the
/// ring's plane, question.b's, that is `side`, 1 or -1, for all motions within the tubes. Nothing where it
/// never is.
[[nodiscard]] std::optional<double> wholly_beside(const PairQuestion& question, double t, bool back,
                                                  int side);

/// The proof, JSON, that the agent, question.a, goes through the hole of the ring, question.b, to the side
/// `along`, 1 or -1: `apart` is the proof that they do not touch. Nothing, and the `reason`, where it is not
/// wholly beside the ring at both ends of the time, or may come as far as its edge.
[[nodiscard]] std::optional<std::string> proof_of_passing(const PairQuestion& question, int along,
                                                          const std::string& apart, std::string& reason);

}  // namespace vericone::simulation::certified
