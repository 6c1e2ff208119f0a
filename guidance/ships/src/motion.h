// SPDX-License-Identifier: BSD-3-Clause
//
// How a ship moves through the water, as pieces of time with one command each, and as tracks for proofs.
#pragma once

#include <vericone/ships/ships.h>
#include <vericone/simulation/track.h>
#include <vector>

namespace vericone::ships {

inline constexpr double kStopPiece = 10;  // s, of the pieces that a stop is cut into

/// Through the water.
struct State {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // m
  double heading = 0, speed = 0, curvature = 0;        // rad, m/s, 1/m

  [[nodiscard]] Eigen::Vector2d ahead() const { return {std::cos(heading), std::sin(heading)}; }
  [[nodiscard]] Eigen::Vector2d velocity() const { return speed * ahead(); }
  [[nodiscard]] Sighting sighting() const { return {position, velocity(), ahead()}; }
};

/// Constant over a piece of time: the curvature that the rudder asks for, and the change of speed.
struct Command {
  double curvature = 0, acceleration = 0;  // 1/m, m/s^2
};

struct Piece {
  State start;
  Command command;
  double seconds = 0;
};

/// The exact motion, its position by quadrature to rounding for pieces in which she turns by less than half a
/// radian. The speed is to stay 0 or more.
[[nodiscard]] State after(const Handling& handling, const Piece& piece, double seconds);

/// Rudder amidships, as slow as the engine can, until she rests.
[[nodiscard]] std::vector<Piece> stop_from(const Handling& handling, const State& state);

/// A piece, then the stop.
[[nodiscard]] std::vector<Piece> plan_of(const Handling& handling, const Piece& piece);

[[nodiscard]] double length_of(const std::vector<Piece>& pieces);   // m
[[nodiscard]] double seconds_of(const std::vector<Piece>& pieces);  // s

/// The rudder that turns towards a heading, critically damped, and the engine towards a speed.
[[nodiscard]] Command steer(const Handling& handling, const State& state, double heading, double speed,
                            double step);

/// A ship's hull, and her domain, as they move: over the ground, both about their own middles. The hull is
/// on quintics of time, which are her motion; the middle of the domain, ahead and abeam of hers, is no
/// quintic while she turns, and its track is `error` off at most.
struct Sailed {
  simulation::Track hull, domain;
  double error = 0;  // m
};
/// At rest, on the water, from the end of the pieces to `until`.
[[nodiscard]] Sailed sailed(const Ship& ship, const std::vector<Piece>& pieces,
                            const Eigen::Vector2d& current, double from, double until);

/// Neither hull in the other's domain from `from` to `until`: both proofs, the worse first.
struct DomainProof {
  simulation::ProofVerdict verdict = simulation::ProofVerdict::avoided;
  double least_distance = 0;  // m
};
[[nodiscard]] DomainProof prove_domains(const Sailed& a, const Sailed& b, double from, double until);

[[nodiscard]] Ellipse hull_of(const Handling& handling, const Eigen::Vector2d& position, double heading);

}  // namespace vericone::ships
