// SPDX-License-Identifier: BSD-3-Clause
//
// A pilot under way, as runs ask it: what whoever writes a law needs.
#pragma once

#include <vericone/simulation/pilot.h>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace vericone::simulation {

struct Run;

/// What a pilot is told at the time of a command. Indices are those of the scenario's bodies.
struct Instant {
  double t = 0, until = 0;                      // s: now, and until when commands are held
  double before = -1;                           // s, when commands were given before; negative: never
  std::uint64_t command = 0;                    // number of the command, from 0
  std::size_t self = 0;                         // the body that is flown
  std::span<const guidance::BodyState> bodies;  // now; of bodies that are there()
  std::span<const Track> tracks;                // until now; after a step until its end
  const Goal* goal = nullptr;        // where it may go, its point and velocity as they are now; null: nowhere
  const Vehicle* vehicle = nullptr;  // that carries out what it commands; null: a point mass

  [[nodiscard]] bool there(std::size_t body) const { return tracks[body].appears() <= t; }
  [[nodiscard]] const guidance::BodyState& own() const { return bodies[self]; }
};

/// One under way. At every command all pilots look(), then report(), then command() one after the other; when
/// the bodies have moved all are asked what has happened.
class FlyingPilot {
 public:
  virtual ~FlyingPilot() = default;
  /// What it sees of the bodies: sensors, estimators, laws.
  virtual void look(const Instant&) {}
  /// Events that it has seen, into the run.
  virtual void report(const Instant&, Run&) {}
  /// `commands`: one a body, all 0. It sets its own and those of its partners.
  virtual void command(const Instant& now, std::span<VehicleCommand> commands, Run& run) = 0;
  /// What it saw and commanded, into the run's samples.
  virtual void log(const Instant&, Run&) {}
  /// The bodies have moved from `now.t` to `now.until`: what has happened on the way, into the run.
  virtual void moved(const Instant&, Run&) {}

  /// All that it minds or is to go through lies behind it.
  [[nodiscard]] virtual bool passed_all() const { return false; }
  /// It may go to its goal: it knows that this body, or else all that comes first, lies behind it.
  [[nodiscard]] virtual bool goal_opens(std::optional<std::size_t>) const { return true; }
};

}  // namespace vericone::simulation
