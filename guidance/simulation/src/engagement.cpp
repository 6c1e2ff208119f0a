// SPDX-License-Identifier: BSD-3-Clause
#include "engagement.h"

#include <vericone/cones/cone_geometry.h>
#include <vericone/internal/guidance/laws.h>
#include <cmath>
#include <limits>

namespace vericone::simulation {
namespace {

using guidance::Law;
using guidance::LawStatus;

bool avoids(Law law) {
  return law == Law::avoidance || law == Law::cooperative_avoidance || law == Law::clearance;
}

bool nothing_to_say(const std::optional<guidance::GuideStep>& step) {
  return step && guidance::commands_nothing(step->status);
}

}  // namespace

Engagement::Engagement(std::size_t agent, std::size_t obstacle, const Pilot& pilot)
    : agent_(agent), obstacle_(obstacle), pilot_(&pilot) {}

void Engagement::observe(const guidance::BodyState& a, const guidance::BodyState& b, double t, bool gone,
                         const guidance::Sight& sight) {
  const Eigen::Vector3d c = b.position - a.position, v = b.velocity - a.velocity;
  const double closing = -c.dot(v);  // times r
  if (passed_ && gone) return;
  passed_ = false;
  if (c.isZero(0)) {  // no line of sight, and nothing left to avoid
    step_.reset();
    time_to_go_ = 0;
    return;
  }
  step_ = guidance::guide(a, b, pilot_->guide, memory_, t, sight);
  time_to_go_ = closing > 0 ? c.squaredNorm() / closing : std::numeric_limits<double>::infinity();
  if (gone && avoids(pilot_->guide.law) && nothing_to_say(step_)) {
    passed_ = true;
    memory_ = {};
  }
}

bool Engagement::demands() const { return step_ && !nothing_to_say(step_); }

bool Engagement::inside() const {
  if (!step_ || passed_) return false;
  if (avoids(pilot_->guide.law)) return demands();
  return step_->y < pilot_->guide.inversion.cease && step_->v_r_hat < 0;
}

/// Where the law had nothing to say, the log still tells y and psi on the plane that it would have chosen.
/// False where there is no cone.
bool Engagement::look(const guidance::BodyState& a, const guidance::BodyState& b, EncounterSample& sample) {
  const guidance::GuideOptions& guide = pilot_->guide;
  const auto across = guidance::choose_plane(a, b, guide.sector, guide.plane, looked_ ? &*looked_ : nullptr);
  looked_ = across;
  if (!across) return false;
  const auto view = guidance::plane_view(a, b, *across, guide.sector, guidance::RateMethod::none);
  if (!view) return false;
  const guidance::ConeRates rates = guidance::cone_rates(view->state, view->cone);
  sample.step.across = view->across;
  sample.step.y = rates.y;
  sample.step.v_r_hat = rates.v_r_hat;
  sample.step.psi = view->cone.psi;
  sample.step.theta_b = view->cone.theta_b;
  return true;
}

EncounterSample Engagement::sample(const guidance::BodyState& a, const guidance::BodyState& b, double t,
                                   bool attended) {
  EncounterSample sample;
  sample.t = t;
  sample.agent = agent_;
  sample.obstacle = obstacle_;
  if (a.position != b.position)
    last_state_ = guidance::spatial_state({a.position, a.velocity, b.position, b.velocity},
                                          last_state_ ? &*last_state_ : nullptr);
  if (last_state_) sample.state = *last_state_;
  sample.attended = attended;
  sample.cone = step_.has_value() && !passed_ && pilot_->guide.law != Law::clearance;
  if (step_) sample.step = *step_;
  if (passed_) sample.step.status = LawStatus::receding;
  // Of an agent with a sensor the log tells the truth; what it measured stands beside it.
  if (sample.cone && (!demands() || pilot_->sensor) && !look(a, b, sample) && pilot_->sensor)
    sample.cone = false;
  if (!sample.cone)
    sample.step.y = sample.step.psi = sample.step.theta_b = std::numeric_limits<double>::quiet_NaN();
  if (sample.step.across.any()) {
    const AxisFrame frame(b.position - a.position);
    sample.plane_azimuth = std::atan2(sample.step.across.dot(frame.e2), sample.step.across.dot(frame.e1));
  }
  return sample;
}

SightSample Engagement::sight_sample(const guidance::BodyState& a, const guidance::BodyState& b, double t,
                                     const Observed& observed) {
  SightSample sample;
  sample.t = t;
  sample.agent = agent_;
  sample.obstacle = obstacle_;
  sample.measurement = observed.measurement;
  sample.believed_position = observed.believed.position;
  sample.believed_velocity = observed.believed.velocity;
  const Measurement& m = observed.measurement;
  if (m.position != a.position)
    last_measured_ = guidance::spatial_state({a.position, a.velocity, m.position, m.velocity},
                                             last_measured_ ? &*last_measured_ : nullptr);
  if (last_measured_) sample.measured = *last_measured_;
  const guidance::EngagementParts& errors = observed.sight.errors;  // (7.2): made where the law looks
  sample.measured.r *= 1 + errors.r;
  sample.measured.theta += errors.theta;
  sample.measured.v_r *= 1 + errors.v_r;
  sample.measured.v_theta *= 1 + errors.v_theta;
  if (!step_ || !step_->reading || b.position == a.position) return sample;
  const auto truth =
      guidance::plane_view(a, b, step_->across, pilot_->guide.sector, guidance::RateMethod::analytic);
  if (!truth) return sample;
  sample.on_plane = true;
  sample.reading = *step_->reading;
  sample.state = truth->state;
  sample.cone = truth->cone;
  // What the agent commands turns its own body, and so the cone.
  sample.cone.psi_rate += sample.cone.psi_rate_by_a * sample.reading.inner;
  sample.cone.theta_b_rate += sample.cone.theta_b_rate_by_a * sample.reading.inner;
  sample.cone.psi_rate_by_a = sample.cone.theta_b_rate_by_a = 0;
  sample.y = guidance::cone_rates(sample.state, sample.cone).y;
  const guidance::GuideReading& read = sample.reading;
  guidance::Measured wrong;
  wrong.v_r = read.state.v_r - sample.state.v_r;
  wrong.v_theta = read.state.v_theta - sample.state.v_theta;
  wrong.theta = read.state.theta - sample.state.theta;
  wrong.theta_b = read.cone.theta_b - sample.cone.theta_b;
  wrong.psi = read.cone.psi - sample.cone.psi;
  wrong.psi_rate = read.cone.psi_rate - sample.cone.psi_rate;
  wrong.theta_b_rate = read.cone.theta_b_rate - sample.cone.theta_b_rate;
  const double gain = pilot_->guide.inversion.gain;
  sample.terms = guidance::noise_terms(sample.state, sample.cone, wrong, gain);
  const guidance::Measured& sigma = read.deviations;
  const guidance::NoiseGradients gradients = guidance::noise_gradients(sample.state, sample.cone, gain);
  sample.y_deviation = guidance::deviation(gradients.y, sigma);
  sample.a_deviation = guidance::deviation(gradients.a, sigma);
  sample.v_deviation = guidance::deviation(gradients.v, sigma);
  return sample;
}

}  // namespace vericone::simulation
