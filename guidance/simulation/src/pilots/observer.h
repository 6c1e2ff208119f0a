// SPDX-License-Identifier: BSD-3-Clause
//
// One agent's view of one body through a run: what its sensor measures, what its estimator makes of that.
#pragma once

#include <vericone/guidance/estimation/filters.h>
#include <vericone/internal/simulation/flying_pilot.h>
#include <vericone/simulation/scenario.h>
#include <vericone/simulation/track.h>
#include <deque>
#include <optional>

namespace vericone::simulation {

struct Observed {
  Measurement measurement;       // the last that has arrived
  guidance::BodyState believed;  // the body as the law is given it
  guidance::Sight sight;
};

class Observer {
 public:
  Observer(const Sensor& sensor, const Pilot& pilot, const Draw& draw)
      : sensor_(sensor),
        estimator_(pilot.estimator),
        intensity_(pilot.estimator_intensity),
        state_({pilot.estimator_intensity, 30}),
        possible_(pilot.obstacle_most),
        draw_(draw) {}

  /// At a command: what is measured now, and what has arrived of it.
  void look(const Instant& now, std::size_t agent, std::size_t body);
  /// Null: nothing has arrived yet.
  [[nodiscard]] const Observed* last() const { return observed_ ? &*observed_ : nullptr; }
  /// Whether it saw the body when it measured last.
  [[nodiscard]] bool sees() const { return sees_; }

 private:
  /// On its way from the sensor.
  struct Sent {
    double t;  // s, when it was measured
    Measurement measurement;
    guidance::Sight sight;
  };
  void take(const Sent& sent);
  void believe(const Instant& now, std::size_t body);

  Sensor sensor_;
  Estimator estimator_;
  double intensity_;  // m^2/s^3
  guidance::ConstantVelocityFilter state_;
  guidance::SetMembershipFilter possible_;
  Draw draw_;
  std::optional<double> measured_at_;  // s
  bool sees_ = false;
  std::deque<Sent> sent_;
  // What was made of the last that has arrived, as of when it was measured.
  std::optional<Sent> arrived_;
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero(), velocity_ = Eigen::Vector3d::Zero();  // m, m/s
  std::optional<Observed> observed_;
};

}  // namespace vericone::simulation
