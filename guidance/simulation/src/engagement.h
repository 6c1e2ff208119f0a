// SPDX-License-Identifier: BSD-3-Clause
//
// One agent and one of the bodies it minds, through a run.
#pragma once

#include <vericone/simulation/run.h>

#include "observer.h"

namespace vericone::simulation {

class Engagement {
 public:
  Engagement(std::size_t agent, std::size_t obstacle, const Pilot& pilot);

  std::size_t agent() const { return agent_; }
  std::size_t obstacle() const { return obstacle_; }

  /// What the law says at time t. Once B is `gone`, passed, and the law has nothing to say, it is not asked
  /// again until that changes.
  void observe(const guidance::BodyState& a, const guidance::BodyState& b, double t, bool gone,
               const guidance::Sight& sight = {});

  const std::optional<guidance::GuideStep>& step() const { return step_; }
  double time_to_go() const { return time_to_go_; }  // s, r / closing speed
  bool passed() const { return passed_; }

  /// The law wants an acceleration.
  bool demands() const;
  /// On a collision course as the law sees it; of rendezvous, y < cease and closing.
  bool inside() const;

  EncounterSample sample(const guidance::BodyState& a, const guidance::BodyState& b, double t, bool attended);
  /// Of an agent with a sensor: the bodies as they are, and what was made of them.
  SightSample sight_sample(const guidance::BodyState& a, const guidance::BodyState& b, double t,
                           const Observed& observed);

 private:
  [[nodiscard]] bool look(const guidance::BodyState& a, const guidance::BodyState& b,
                          EncounterSample& sample);

  std::size_t agent_, obstacle_;
  const Pilot* pilot_;
  guidance::GuideMemory memory_;
  std::optional<guidance::GuideStep> step_;
  std::optional<guidance::SpatialState> last_state_, last_measured_;
  std::optional<Eigen::Vector3d> looked_;
  double time_to_go_ = 0;
  bool passed_ = false;
};

}  // namespace vericone::simulation
