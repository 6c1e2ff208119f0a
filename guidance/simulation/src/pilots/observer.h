// SPDX-License-Identifier: BSD-3-Clause
//
// One agent's view of one body through a run: what its sensor measures, what its estimator makes of that.
#pragma once

#include <vericone/guidance/estimation/filters.h>
#include <vericone/simulation/scenario.h>
#include <vericone/simulation/track.h>
#include <optional>

namespace vericone::simulation {

struct Observed {
  Measurement measurement;
  guidance::BodyState believed;  // the body as the law is given it
  guidance::Sight sight;
};

class Observer {
 public:
  Observer(const Sensor& sensor, const Pilot& pilot, const Draw& draw)
      : sensor_(sensor),
        estimator_(pilot.estimator),
        state_({pilot.estimator_intensity, 30}),
        possible_(pilot.obstacle_most),
        draw_(draw) {}

  /// The truth of both bodies at t, and the number of the command.
  const Observed& look(const guidance::BodyState& a, const guidance::BodyState& b, const Track& of_b,
                       double t, std::uint64_t step);
  [[nodiscard]] const Observed& last() const { return *observed_; }

 private:
  void estimate(const Measurement& measurement, double t, Eigen::Vector3d& position,
                Eigen::Vector3d& velocity);

  Sensor sensor_;
  Estimator estimator_;
  guidance::ConstantVelocityFilter state_;
  guidance::SetMembershipFilter possible_;
  Draw draw_;
  std::optional<Observed> observed_;
};

}  // namespace vericone::simulation
