// SPDX-License-Identifier: BSD-3-Clause
//
// One agent and one of the bodies it minds, through a run.
#pragma once

#include <vericone/internal/simulation/flying_pilot.h>
#include <vericone/simulation/run.h>

#include "pilots/observer.h"

namespace vericone::simulation {

/// Whether one body has passed another, looked at time after time.
class Passage {
 public:
  /// Of a pilot of A. By centres alone: as `passing` says, and of a law that knows no cone.
  Passage(const Track& a, const Track& b, const Pilot& pilot, bool by_centres);

  /// Negative until B is passed: c.V, and once that is not negative V_r_hat of the plane chosen, where there
  /// is one: followed from the time asked before. Where V_r_hat is positive on every plane c.V stands for it.
  /// A placed body may have rooms, and its reference point be anywhere: it is passed when the middle of its
  /// bounds recedes and A is out of them.
  double rate(const Track& a, const Track& b, double t);
  /// From A's reference point to that of B, in place of which a placed B has the middle of its bounds.
  [[nodiscard]] Eigen::Vector3d between(const Track& a, const Track& b, double t) const;

 private:
  /// Metres from A's reference point to the bounds of a placed B, negative within. Requires placed_.
  [[nodiscard]] double outside(const Track& a, const Track& b, double t) const;

  const guidance::GuideOptions* guide_;
  bool by_centres_;
  double reach_;                    // of both bodies, metres
  const Placed* placed_ = nullptr;  // B in its own frame
  guidance::GuideMemory seen_;
};

class Engagement {
 public:
  Engagement(std::size_t agent, std::size_t obstacle, const Pilot& pilot, const Draw& draw);

  std::size_t obstacle() const { return obstacle_; }
  bool there(const Instant& now) const { return now.there(obstacle_); }
  /// It is there, and the agent knows of it.
  bool known(const Instant& now) const { return there(now) && (!observer_ || observer_->last()); }
  /// The obstacle as the agent has it. Requires that it is known.
  const guidance::BodyState& believed(const Instant& now) const;

  /// What sensor, estimator and law make of it.
  void look(const Instant& now);
  /// Whether the cone was entered or left since the command before. Of an agent with a sensor, whose law does
  /// not know, on the tracks, and only where `log`; and whether it is seen now.
  void report(const Instant& now, bool log, Run& run);
  /// Whether it was passed during the step.
  void moved(const Instant& now, Run& run);
  void log(const Instant& now, bool attended, int planes, Run& run);

  const std::optional<guidance::GuideStep>& step() const { return step_; }
  double time_to_go() const { return time_to_go_; }  // s, r / closing speed
  /// The law wants an acceleration.
  bool demands() const;
  bool has_passed() const { return has_passed_; }
  /// As the agent knows it.
  bool known_passed() const { return observer_ ? seen_passed_ : has_passed_; }

 private:
  /// What the law says. Once B is `gone`, passed, and the law has nothing to say, it is not asked again until
  /// that changes.
  void ask(const guidance::BodyState& a, const guidance::BodyState& b, double t, bool gone,
           const guidance::Sight& sight);
  /// On a collision course as the law sees it; of rendezvous, y < cease and closing.
  bool inside() const;
  bool follow(const guidance::BodyState& a, const guidance::BodyState& b, EncounterSample& sample);
  EncounterSample sample(const guidance::BodyState& a, const guidance::BodyState& b, double t, bool attended);
  /// Of an agent with a sensor: the bodies as they are, and what was made of them.
  SightSample sight_sample(const guidance::BodyState& a, const guidance::BodyState& b, double t);
  void report_sight(const Instant& now, Run& run);
  void report_truth(const Instant& now, Run& run);
  /// Negative on a collision course as the law sees it: m - required, or -1 and 1.
  double margin(const Instant& now, double t) const;
  /// What m or y has to reach.
  double edge() const;
  double passing_rate(const Instant& now, double t);
  bool first(const Instant& now) const;

  std::size_t agent_, obstacle_;
  const Pilot* pilot_;
  bool metres_, avoids_;  // the law's function is m; it is to end beyond the cone
  std::optional<Observer> observer_;
  std::optional<Passage> passage_;
  guidance::GuideMemory memory_;
  std::optional<guidance::GuideStep> step_;
  std::optional<guidance::SpatialState> last_state_, last_measured_;
  std::optional<Eigen::Vector3d> looked_;
  double time_to_go_ = 0;
  bool passed_ = false;       // and the law has nothing to say
  bool inside_ = false;       // at the command before
  bool seen_ = false;         // both were there at the command before
  bool in_sight_ = false;     // of its sensor, at the command before
  bool gone_ = false;         // passed, at the time reached
  bool has_passed_ = false;   // at some time
  bool seen_passed_ = false;  // as the agent knows it
};

}  // namespace vericone::simulation
